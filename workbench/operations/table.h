#pragma once

#include <span>
#include <string>

#include "workbench/case/operation.h"

namespace vesselbench {

/// All operations of this build, in the order of their usual steps.
[[nodiscard]] std::span<const Operation> operation_table();

/// \throw UsageError that lists the near names if there is none of this name
[[nodiscard]] const Operation& find_operation(const std::string& name);

/// The operation that loads such an input.
[[nodiscard]] const Operation& loading_operation(InputKind kind);

// One function per operation, defined in the source file of the operation's name (clip_opening.cpp,
// ...; the brushes share brush.cpp). An operation is registered by its line here and its line in
// table.cpp.

[[nodiscard]] Operation brush_inflate_operation();
[[nodiscard]] Operation brush_smooth_operation();
[[nodiscard]] Operation brush_weight_operation();
[[nodiscard]] Operation clip_opening_operation();
[[nodiscard]] Operation crop_operation();
[[nodiscard]] Operation decimate_operation();
[[nodiscard]] Operation extract_surface_operation();
[[nodiscard]] Operation extrude_opening_operation();
[[nodiscard]] Operation fill_hole_operation();
[[nodiscard]] Operation keep_component_operation();
[[nodiscard]] Operation load_image_operation();
[[nodiscard]] Operation load_neighbour_operation();
[[nodiscard]] Operation load_surface_operation();
[[nodiscard]] Operation print_check_operation();
[[nodiscard]] Operation remesh_operation();
[[nodiscard]] Operation remove_branch_operation();
[[nodiscard]] Operation repair_operation();
[[nodiscard]] Operation smooth_operation();
[[nodiscard]] Operation subdivide_operation();
[[nodiscard]] Operation tetrahedralize_operation();

}  // namespace vesselbench
