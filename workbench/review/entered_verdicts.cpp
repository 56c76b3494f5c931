#include "workbench/review/entered_verdicts.h"

namespace vesselbench {

std::vector<EnteredVerdicts> entered_verdicts(const ProjectFile& project,
                                              const std::filesystem::path& signers,
                                              const Progress& progress) {
    std::vector<EnteredVerdicts> entered;
    for (const StoredVerdicts& stored : project.verdicts())
        entered.push_back({verdicts_from_text(stored.text, "the stored verdicts"),
                           signature_of(stored, signers, progress)});
    return entered;
}

std::vector<EnteredVerdicts> without_unsigned_acceptances(std::vector<EnteredVerdicts> entered) {
    for (auto& [verdicts, signature] : entered) {
        if (signature.state == SignatureState::Verified) continue;
        for (EditVerdict& verdict : verdicts.edits)
            if (verdict.verdict == Verdict::Accept) verdict.verdict = Verdict::None;
        if (verdicts.overall == Verdict::Accept) verdicts.overall = Verdict::None;
    }
    return entered;
}

}  // namespace vesselbench
