#pragma once

#include <memory>
#include <string>
#include <vector>

#include "smoothing/quality/processing_table.h"
#include "smoothing/quality/search.h"
#include "workbench/case/arguments.h"
#include "workbench/case/operation.h"

namespace vesselbench {

/// Operations whose parameters can be searched, by name, in the order of the table.
[[nodiscard]] std::vector<std::string> searched_operations();

/// Those among them whose search has a property.
[[nodiscard]] std::vector<std::string> searched_operations(bool (*has)(const OperationSearch&));

// Such properties.
[[nodiscard]] bool counts_triangles(const OperationSearch& search);
[[nodiscard]] bool searches_filter(const OperationSearch& search);

/// Compact if the operation is meant to change the number of triangles; else default.
/// \throw UsageError that lists the operations that can be searched, if this one cannot
[[nodiscard]] ScoreForm usual_score_of(const Operation& operation);

/// \throw UsageError if a given argument replaces the searched parameters
void check_rivals(const Operation& operation, const Arguments& given);

/// The grid of an operation's parameters on a surface.
/// \param all_parameters for graphs
/// \throw UsageError if a given argument conflicts with a searched one
[[nodiscard]] SearchSpace processing_space(const Operation& operation, const Surface& surface,
                                           const Arguments& given, bool all_parameters);

/// The operation's result on a scene's surface with a set; the other arguments are kept.
/// \throw AlgorithmFailure, InvalidInput as the operation; Cancelled
[[nodiscard]] Surface processed_with(const Operation& operation, const Scene& scene,
                                     const Arguments& arguments, const SearchSpace& space,
                                     const ParameterSet& set, const Progress& progress);

/// The measures of these results. Sets for which the operation fails are left out.
[[nodiscard]] std::shared_ptr<MeasureSource> processing_table(const Operation& operation,
                                                              const Scene& scene,
                                                              const Arguments& arguments,
                                                              const SearchSpace& space);

/// The arguments as a set of that space; absent values are those the operation decides.
[[nodiscard]] ParameterSet processing_set(const Operation& operation, const Scene& scene,
                                          const Arguments& arguments, const SearchSpace& space,
                                          const Progress& progress);

/// Enters a set's values into arguments.
void set_values(Arguments& arguments, const Operation& operation, const SearchSpace& space,
                const ParameterSet& set);

}  // namespace vesselbench
