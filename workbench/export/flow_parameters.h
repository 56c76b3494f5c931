#pragma once

#include <string>
#include <vector>

#include "meshing/products/cfd_parameters.h"
#include "workbench/case/operation.h"

namespace vesselbench {

/// The documented parameters of an exported OpenFOAM case: density, viscosity, flow, profile ...
[[nodiscard]] std::vector<Parameter> flow_parameters();

/// They as a row like those of the operation table, "openfoam", to share its checks, texts, forms.
[[nodiscard]] const Operation& flow_table();

/// True for the waveform that is made and not read.
[[nodiscard]] bool is_synthetic(const std::string& waveform);

/// A waveform as a project keeps it: a file's numbers in place of its name, which may be gone
/// later, and says where it was. \throw UsageError as flow_from()
[[nodiscard]] std::string kept_waveform(const std::string& text);

/// \param arguments checked against flow_parameters(); absent ones keep their default
/// \throw UsageError if a text in them, or the file of a waveform, is not as it should be
[[nodiscard]] CfdParameters flow_from(const Arguments& arguments);

}  // namespace vesselbench
