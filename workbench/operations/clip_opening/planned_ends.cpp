#include "workbench/operations/clip_opening/planned_ends.h"

#include <algorithm>
#include <utility>

namespace vesselbench {

std::vector<EndRecord> ends_by_number(const OpeningPlan& plan) {
    std::vector<EndRecord> ends = plan.ends;
    std::ranges::stable_sort(
        ends, {}, [](const EndRecord& end) { return std::pair(end.number == 0, end.number); });
    return ends;
}

std::vector<std::string> planned_names(const OpeningPlan& plan) {
    std::vector<std::string> names(plan.openings.size(), "outlet");
    for (const std::size_t inlet : plan.inlets) names[inlet] = "inlet";
    for (std::size_t i = 0; i < names.size(); ++i)
        if (plan.openings[i].patch) names[i] = plan.openings[i].patch->name;
    return names;
}

}  // namespace vesselbench
