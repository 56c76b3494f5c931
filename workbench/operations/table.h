#pragma once

#include <span>
#include <string>

#include "workbench/case/operation.h"

namespace vesselbench {

/// All operations of this build, in the order of their usual steps.
[[nodiscard]] std::span<const Operation> operation_table();

/// Null: this build has none of this name, such as that of a project from another version.
[[nodiscard]] const Operation* known_operation(const std::string& name);

/// \throw UsageError that lists the near names if there is none of this name
[[nodiscard]] const Operation& find_operation(const std::string& name);

/// The operation that loads such an input.
[[nodiscard]] const Operation& loading_operation(InputKind kind);

/// The operation that makes the source's surface of an image.
[[nodiscard]] const Operation& extracting_operation();

/// The registration of the operations, ordered by their usual steps. Each row `name` is a function
/// `Operation name_operation()`, defined in operations/name.cpp (the brushes share brush.cpp).
// clang-format off
#define VESSELBENCH_OPERATIONS(ROW) \
    ROW(load_surface) \
    ROW(load_image) \
    ROW(load_neighbour) \
    ROW(extract_surface) \
    ROW(crop) \
    ROW(keep_component) \
    ROW(repair) \
    ROW(remove_branch) \
    ROW(mark_neck) \
    ROW(brush_smooth) \
    ROW(brush_inflate) \
    ROW(brush_weight) \
    ROW(fill_hole) \
    ROW(widen) \
    ROW(separate) \
    ROW(stamp) \
    ROW(correct_narrowing) \
    ROW(clip_opening) \
    ROW(extrude_opening) \
    ROW(smooth) \
    ROW(deform_branch) \
    ROW(part_branches) \
    ROW(remesh) \
    ROW(decimate) \
    ROW(subdivide) \
    ROW(tetrahedralize) \
    ROW(print_check)
// clang-format on

#define VESSELBENCH_DECLARE(name) [[nodiscard]] Operation name##_operation();
VESSELBENCH_OPERATIONS(VESSELBENCH_DECLARE)
#undef VESSELBENCH_DECLARE

}  // namespace vesselbench
