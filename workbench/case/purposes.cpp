#include "workbench/case/purposes.h"

#include <algorithm>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/wording.h"
#include "workbench/case/near_names.h"

namespace vesselbench {

std::span<const Purpose> purposes() {
    static const std::vector<Purpose> table = {
        {.name = "cfd",
         .title = "Model for flow simulation",
         .words = {"flow"},
         .help = "flow simulation (cfd, or flow)",
         .summary = "Closed, capped, remeshed, with tetrahedra",
         .products = {"volume.vtu", "volume.msh", "openfoam"},
         .result = "CFD case",
         .result_file = "openfoam",
         .simulates_flow = true,
         .relevance = {'+', '-', '+', '+', '+', '+'}},
        {.name = "rp",
         .title = "Model for printing",
         .words = {"print", "printing"},
         .help = "printing (rp, or print)",
         .summary = "Watertight, checked for thin places",
         .products = {"print.stl", "print.3mf"},
         .result = "print model",
         .result_file = "print.stl",
         .relevance = {'+', '-', '+', 'o', '-', '-'}},
        {.name = "planning",
         .title = "Model for treatment planning",
         .help = "pictures\n(planning: keeps raw triangles)",
         .summary = "Smooth surface with its own triangles",
         .relevance = {'+', '+', '+', 'o', '-', '-'}},
        {.name = "simulation",
         .title = "Model for surgery simulation",
         .help = "surgery simulation (simulation)",
         .summary = "Smooth, remeshed surface",
         .relevance = {'-', 'o', '+', 'o', '+', '+'}}};
    return table;
}

std::vector<std::string> purpose_names() {
    std::vector<std::string> names;
    for (const Purpose& purpose : purposes()) names.push_back(purpose.name);
    return names;
}

std::string purpose_name(const std::string& word) {
    for (const Purpose& purpose : purposes())
        if (std::ranges::count(purpose.words, word) > 0) return purpose.name;
    return word;
}

std::string model_title(const std::string& variant) {
    const auto purpose = std::ranges::find(purposes(), variant, &Purpose::name);
    return purpose == purposes().end() ? variant : purpose->title;
}

const Purpose& find_purpose(const std::string& name) {
    const auto found = std::ranges::find(purposes(), name, &Purpose::name);
    if (found != purposes().end()) return *found;
    const std::vector<std::string> names = purpose_names();
    throw UsageError("--for '" + name + "' is unknown" + did_you_mean(name, names) + " (it is " +
                     joined(names) + ")");
}

}  // namespace vesselbench
