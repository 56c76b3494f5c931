#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "workbench/prepare/input.h"
#include "workbench/prepare/recipe.h"
#include "workbench/session/session.h"

namespace vesselbench {

/// Opens the project of an earlier preparation to go on in it.
/// \throw IoError if it cannot be written
[[nodiscard]] Session resumed(const std::filesystem::path& project, const SessionOptions& options);

/// Large images are not embedded: they are read again from the input, wherever it is.
/// \throw UsageError if the project was made from another file than the input, or was read in
/// another unit than the one given
void refuse_other_input(Session& session, const Input& input);

/// A model without one of its edits is not what was asked for.
/// \throw AlgorithmFailure that names the first edit that no longer applies, and why
void refuse_stale_edits(const std::vector<LogEntry>& log);

/// For each entry the edit that does it, or did until it was removed by hand; 0: none. An edit
/// counts as the entry of its operation and step unless it does a part of it only: opens one end
/// where the recipe opens all. What the recipe made counts with the arguments that it was changed
/// to, too.
[[nodiscard]] std::vector<EditId> edits_of(const Recipe& recipe, const Snapshot& made,
                                           const std::string& variant);

/// The entries that are still to be made, without those that edits_of() finds. Entries that may be
/// left out are not made up for before one that has been made, nor where an edit replaces them.
[[nodiscard]] Recipe rest_of(const Recipe& recipe, const Snapshot& made,
                             const std::string& variant);

/// The operations of entries whose edits were removed by hand; each name once.
[[nodiscard]] std::vector<std::string> removed_entries(const Recipe& recipe, const Snapshot& made,
                                                       const std::string& variant);

/// \throw UsageError if a setting "operation.parameter=value" is of an edit that has been made
void refuse_late_settings(std::span<const std::string> settings, const Recipe& rest,
                          const std::vector<LogEntry>& log);

}  // namespace vesselbench
