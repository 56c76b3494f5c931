#include "workbench/window/features/openings/opening_roles.h"

#include <algorithm>
#include <sstream>

#include "geometry/kernel/wording.h"
#include "geometry/vessel/openings/opening_names.h"
#include "workbench/case/argument_texts.h"

namespace vesselbench {

std::vector<FieldText> role_texts(const PatchMeasures& opening, PatchKind role,
                                  const std::vector<Patch>& patches) {
    const std::string at = to_text(Value(rounded_place(opening.centroid)));
    const bool inlet = role == PatchKind::Inlet;
    const bool renamed = !inlet && opening.kind != PatchKind::Outlet;
    return {{"tip", at},
            {"distance", ""},
            {"radii", ""},
            {"planes", ""},
            {"names", ""},
            {"inlet", inlet ? at : ""},
            {"kind", inlet ? "" : to_string(role)},
            {"name", inlet     ? ""
                     : renamed ? free_patch_name("outlet", 1, patches)
                               : opening.name}};
}

std::string with_name_switched(const std::string& list, const std::string& name) {
    std::vector<std::string> names;
    std::istringstream stream(list);
    for (std::string each; std::getline(stream, each, ',');) names.push_back(each);
    if (std::erase(names, name) == 0) names.push_back(name);
    return joined(names, ",");
}

}  // namespace vesselbench
