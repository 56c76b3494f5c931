#pragma once

#include <string>
#include <vector>

#include "workbench/session/session_runner.h"

namespace vesselbench {

/// True if lists of edits that show one would show the same of the other.
[[nodiscard]] bool same_edits(const Snapshot& a, const Snapshot& b);

/// The variant of the newest edit that belongs to one.
/// \param otherwise what it is without such an edit; empty: the default
[[nodiscard]] std::string newest_variant(const Snapshot& snapshot, const std::string& otherwise);

/// The newest edit of an operation; null: none.
[[nodiscard]] const LogEntry* newest_edit(const Snapshot& snapshot, const std::string& operation);

/// The edits that were pending in one snapshot and have run in the other.
[[nodiscard]] std::vector<LogEntry> run_since(const Snapshot& before, const Snapshot& now);

/// "edit 7, Smooth", or of several, "edit 7, Smooth, and 2 more": the edits that only one of two
/// states contains, or contains otherwise.
[[nodiscard]] std::string edits_between(const Snapshot& a, const Snapshot& b);

/// "Remesh: volume -0.1 %, ..."
[[nodiscard]] std::string changed_text(const EditRecord& edit, const ResultRecord& result);

}  // namespace vesselbench
