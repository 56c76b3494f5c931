#pragma once

#include <vector>

#include "workbench/case/history.h"

namespace vesselbench {

/// The first edit of a variant behind a step; null: none.
/// \param line the edits of the variant, in order
[[nodiscard]] const HistoryEntry* edit_behind(const std::vector<HistoryEntry>& line, Step step);

}  // namespace vesselbench
