#pragma once

#include "workbench/case/scene.h"
#include "workbench/operations/smoothing_subject.h"

namespace vesselbench {

/// The inputs of `smooth` on a scene, for a search of its parameters.
/// \param given by the user
/// \param arguments the same with defaults; resolved here
/// \throw UsageError, InvalidInput, AlgorithmFailure as `smooth`
[[nodiscard]] SmoothingSubject smoothing_subject(const Scene& scene, const Arguments& given,
                                                 Arguments& arguments);

}  // namespace vesselbench
