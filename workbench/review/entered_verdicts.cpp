#include "workbench/review/entered_verdicts.h"

#include "workbench/review/signing_key.h"

namespace vesselbench {

std::vector<EnteredVerdicts> entered_verdicts(const ProjectFile& project,
                                              const std::filesystem::path& signers,
                                              const Progress& progress) {
    std::vector<EnteredVerdicts> entered;
    for (const StoredVerdicts& stored : project.verdicts())
        entered.push_back({verdicts_from_text(stored.text, "the stored verdicts"),
                           signature_of(stored, signers, progress), signing_key(stored.signature)});
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
