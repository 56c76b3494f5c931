#pragma once

#include <span>

#include <nlohmann/json_fwd.hpp>

#include "workbench/project/chain.h"
#include "workbench/review/review.h"

namespace vesselbench {

/// What a report on a patient's model states, of the current state, as JSON: program versions,
/// variants, sources with their resolution, segmentation, edits with their figures (accuracy),
/// operators, reviewers, exported files, and reporting_items(). Contains no folders.
/// \param review of the current state
/// \param entries of the project's record, for the files
/// \param find of operations; those it does not know are listed without arguments
[[nodiscard]] nlohmann::ordered_json statement_of(const Session& session, const Review& review,
                                                  std::span<const ChainEntry> entries,
                                                  const OperationLookup& find);

}  // namespace vesselbench
