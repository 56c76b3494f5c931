#include "workbench/review/entered_verdicts.h"

#include "workbench/review/retired_keys.h"
#include "workbench/review/signing_key.h"

namespace vesselbench {

namespace {

/// The program enters nothing signed by a retired key: what is there all the same was put there
/// past it, and its signature counts as invalid.
void refuse_retired(const std::vector<RetiredKey>& keys, std::vector<EnteredVerdicts>& entered) {
    for (const RetiredKey& retired : keys)
        for (std::size_t i = retired.files_before; i < entered.size(); ++i)
            if (EnteredVerdicts& one = entered[i];
                !one.key.empty() && key_fingerprint(one.key) == retired.fingerprint)
                one.signature = {.state = SignatureState::Invalid,
                                 .problem = retired_words(retired)};
}

}  // namespace

std::vector<EnteredVerdicts> entered_verdicts(const ProjectFile& project,
                                              const std::filesystem::path& signers,
                                              const Progress& progress) {
    return entered_verdicts(project, project.record_entries(), signers, progress);
}

std::vector<EnteredVerdicts> entered_verdicts(const ProjectFile& project,
                                              std::span<const ChainEntry> record,
                                              const std::filesystem::path& signers,
                                              const Progress& progress) {
    std::vector<EnteredVerdicts> entered;
    for (const StoredVerdicts& stored : project.verdicts())
        entered.push_back({verdicts_from_text(stored.text, "the stored verdicts"),
                           signature_of(stored, signers, progress), signing_key(stored.signature)});
    refuse_retired(retired_keys(record), entered);
    return entered;
}

std::vector<EnteredVerdicts> signed_or_rejecting(std::vector<EnteredVerdicts> entered) {
    const auto keep_rejection = [](Verdict& verdict) {
        if (verdict != Verdict::Reject) verdict = Verdict::None;
    };
    for (auto& [verdicts, signature, key] : entered) {
        if (signature.state == SignatureState::Verified) continue;
        for (EditVerdict& verdict : verdicts.edits) keep_rejection(verdict.verdict);
        keep_rejection(verdicts.overall);
    }
    return entered;
}

}  // namespace vesselbench
