#pragma once

#include <nlohmann/json_fwd.hpp>

#include "workbench/review/review.h"

namespace vesselbench {

/// What a report on a patient's model states, of the current state, as JSON: program versions,
/// sources with their resolution, segmentation, edits with their figures (accuracy), operators and
/// reviewers. Contains no folders.
/// \param review of the current state
/// \param find of operations; those it does not know are listed without arguments
[[nodiscard]] nlohmann::ordered_json statement_of(const Session& session, const Review& review,
                                                  const OperationLookup& find);

}  // namespace vesselbench
