#pragma once

#include <string>
#include <vector>

#include "workbench/case/history.h"

namespace vesselbench {

/// The last result of a line of edits that is known: the one before its first pending edit. 0: the
/// empty scene.
[[nodiscard]] ResultId known_end(const std::vector<HistoryEntry>& line);

/// For each of some states, the last result of a variant that is known there: the one before its
/// first pending edit. 0: the empty scene.
/// \throw UsageError if there is no such state
[[nodiscard]] std::vector<ResultId> known_results(History history,
                                                  const std::vector<StateId>& states,
                                                  const std::string& variant);

}  // namespace vesselbench
