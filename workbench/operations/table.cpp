#include "workbench/operations/table.h"

#include <algorithm>
#include <string>
#include <vector>

#include "geometry/kernel/errors.h"
#include "workbench/case/near_names.h"

namespace vesselbench {

std::span<const Operation> operation_table() {
    // One operation a line, ordered by step.
    // clang-format off
    static const std::vector<Operation> table = {
        load_surface_operation(),
        load_image_operation(),
        load_neighbour_operation(),
        extract_surface_operation(),
        crop_operation(),
        keep_component_operation(),
        repair_operation(),
        remove_branch_operation(),
        brush_smooth_operation(),
        brush_inflate_operation(),
        brush_weight_operation(),
        fill_hole_operation(),
        clip_opening_operation(),
        extrude_opening_operation(),
        smooth_operation(),
        remesh_operation(),
        decimate_operation(),
        subdivide_operation(),
        tetrahedralize_operation(),
        print_check_operation(),
    };
    // clang-format on
    return table;
}

const Operation& find_operation(const std::string& name) {
    std::vector<std::string> names;
    for (const Operation& operation : operation_table()) {
        if (operation.name == name) return operation;
        names.push_back(operation.name);
    }
    throw UsageError("there is no operation '" + name + "'" + did_you_mean(name, names) +
                     " ('vesselbench operations' lists them all)");
}

const Operation& loading_operation(InputKind kind) {
    return *std::ranges::find_if(operation_table(), [&](const Operation& operation) {
        return operation.recipe.loads == kind;
    });
}

}  // namespace vesselbench
