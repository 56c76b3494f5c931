#include "workbench/operations/table.h"

#include <vector>

namespace vesselbench {

std::span<const Operation> operation_table() {
    static const std::vector<Operation> table = {
        fill_hole_operation(),       extrude_opening_operation(), smooth_operation(),
        tetrahedralize_operation(),  print_check_operation(),     load_surface_operation(),
        keep_component_operation(),  repair_operation(),          fill_hole_operation(),
        extrude_opening_operation(), smooth_operation(),          fill_hole_operation(),
        extrude_opening_operation(), smooth_operation(),          remesh_operation(),
        extrude_opening_operation(), smooth_operation(),
        load_image_operation(), extract_surface_operation(), crop_operation(),
        fill_hole_operation(),  extrude_opening_operation(), smooth_operation(),
    };
    return table;
}

}  // namespace vesselbench
