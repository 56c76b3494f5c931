#pragma once

#include "smoothing/filters/filter.h"
#include "workbench/case/operation.h"

namespace vesselbench {

/// Parameters of `smooth` that select and configure the filter.
[[nodiscard]] std::vector<Parameter> filter_parameter_table();

/// True if `preset` may have this value.
[[nodiscard]] bool is_preset(const std::string& name);

/// Fills in the arguments decided by the preset, the surface and its neighbours, so that a replay
/// repeats them: those of the filter, beta_min and distance.
/// \throw UsageError if two arguments cannot be combined
void resolve_filter(const Scene& scene, Arguments& arguments);

/// The filter of resolved arguments.
[[nodiscard]] FilterParameters filter_from(const Arguments& resolved);

/// A warning about the filter's arguments; none if they are well chosen.
[[nodiscard]] std::optional<Diagnostic> filter_warning(const FilterParameters& filter);

}  // namespace vesselbench
