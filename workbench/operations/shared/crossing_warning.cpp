#include "workbench/operations/shared/crossing_warning.h"

#include <utility>

namespace vesselbench {

void warn_of_crossings(const TakenBack& taken, const std::string& code,
                       std::vector<Remedy> remedies, Outcome& outcome) {
    if (taken.vertices == 0) return;
    Diagnostic warning{.code = code,
                       .place = taken.place,
                       .figures = {{"vertices", static_cast<double>(taken.vertices)}}};
    if (taken.crossings_left > 0) {
        warning.figures["crossings"] = static_cast<double>(taken.crossings_left);
        warning.remedies = std::move(remedies);
    }
    outcome.warnings.push_back(std::move(warning));
}

}  // namespace vesselbench
