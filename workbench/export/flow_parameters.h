#pragma once

#include <vector>

#include "meshing/products/cfd_parameters.h"
#include "workbench/case/operation.h"

namespace vesselbench {

/// The documented parameters of an exported OpenFOAM case: density, viscosity, flow, profile ...
[[nodiscard]] std::vector<Parameter> flow_parameters();

/// They as a row like those of the operation table, "openfoam", to share its checks, texts, forms.
[[nodiscard]] const Operation& flow_table();

/// \param arguments checked against flow_parameters(); absent ones keep their default
[[nodiscard]] CfdParameters flow_from(const Arguments& arguments);

}  // namespace vesselbench
