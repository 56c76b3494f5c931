#pragma once

#include <optional>
#include <vector>

#include "geometry/kernel/surface_distance.h"
#include "meshing/stamp/tool_body.h"
#include "workbench/case/arguments.h"
#include "workbench/case/parameter.h"

namespace vesselbench {

/// The parameters that make the tool.
[[nodiscard]] std::vector<Parameter> tool_parameters();

/// Sets what is left out: of a box at a contact its plane and its waist, else the outward direction
/// at the place; sizes from the waist, or the vessel's radius.
/// \throw DiagnosedFailure if the place has no contact, and the tool's direction is not given;
///        UsageError if a place is missing
void resolve_tool(const Surface& surface, const SurfaceDistance& places, Arguments& arguments);

/// \param arguments resolved
/// \throw InvalidInput as box_body(), capsule_body() and swept_body()
[[nodiscard]] ToolBody tool_from(const Arguments& arguments);

/// The points of a path: x, y, z one after the other.
/// \throw UsageError if a number is missing
[[nodiscard]] Positions path_from(const std::vector<double>& numbers);

}  // namespace vesselbench
