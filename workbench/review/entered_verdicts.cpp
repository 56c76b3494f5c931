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

}  // namespace vesselbench
