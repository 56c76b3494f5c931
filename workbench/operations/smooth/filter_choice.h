#pragma once

#include "smoothing/filters/filter.h"
#include "workbench/case/operation.h"

namespace vesselbench {

/// Parameters of `smooth` that choose the filter and set it.
[[nodiscard]] std::vector<Parameter> filter_parameter_table();

/// Fills in what the preset and the surface decide of the filter's arguments, so that a replay
/// decides nothing.
/// \throw UsageError if two arguments do not go together
void resolve_filter(const Surface& surface, Arguments& arguments);

/// The filter of resolved arguments.
[[nodiscard]] FilterParameters filter_from(const Arguments& resolved);

/// What a user should know of the filter's arguments; empty if nothing.
[[nodiscard]] std::string filter_warning(const FilterParameters& filter);

}  // namespace vesselbench
