#pragma once

#include <vector>

#include "workbench/case/history.h"
#include "workbench/session/session_options.h"

namespace vesselbench {

/// The place of a new edit of a step: in the variant if the step's edits belong to one, else in the
/// trunk.
[[nodiscard]] EditPlace place_of_new(Step step, const std::string& variant, const History& history);

/// The place of a new edit of an operation in the current state.
/// \throw UsageError if the step is not allowed, or belongs to a variant and none is given
[[nodiscard]] EditPlace place_of(const Operation& operation, const EditOptions& options,
                                 const History& history);

/// The entries that precede a new edit of this place.
[[nodiscard]] std::vector<HistoryEntry> entries_before(const History& history,
                                                       const EditPlace& place);

/// The entries of the edit's line up to it, without it.
/// \throw UsageError if the current state does not contain it
[[nodiscard]] std::vector<HistoryEntry> entries_before(const History& history, EditId id);

/// The variant that is meant: the one asked for; if that is empty, the only one of the current
/// state, or kDefaultVariant if there is none, or several.
[[nodiscard]] std::string variant_meant(const std::string& asked, const History& history);

}  // namespace vesselbench
