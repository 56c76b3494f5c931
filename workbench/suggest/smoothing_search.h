#pragma once

#include "geometry/kernel/progress.h"
#include "geometry/kernel/surface.h"
#include "workbench/operations/smoothing_subject.h"

namespace vesselbench {

/// The engine that measures parameter sets, on the subject's device: auto takes a GPU if there is
/// one. A GPU's engine must be used on this thread only.
/// \param planes also measures the error as printed in Eq. 6.2
[[nodiscard]] ChosenEngine smoothing_engine(const SmoothingSubject& subject, bool planes);

/// \param engine that searches the space
/// \param all_parameters for graphs
[[nodiscard]] SearchSpace smoothing_space_for(const SmoothingSubject& subject,
                                              const SmoothingEngine& engine, bool all_parameters);

/// The given arguments as a set of that space.
[[nodiscard]] ParameterSet smoothing_set(const SmoothingSubject& subject, const SearchSpace& space);

/// The surface smoothed with a set, as by the operation, but without the check for crossing walls.
/// \throw InvalidInput if the space leaves the set out; Cancelled
[[nodiscard]] Surface smoothed_with(const SmoothingSubject& subject, const Surface& surface,
                                    const SearchSpace& space, const ParameterSet& set,
                                    const Progress& progress);

}  // namespace vesselbench
