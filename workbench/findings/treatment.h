#pragma once

#include <string>
#include <vector>

#include "workbench/findings/finding.h"
#include "workbench/session/session.h"

namespace vesselbench {

/// The step in which an operation treats what was found on a variant's newest model: its usual one,
/// else the first allowed one that comes behind the variant's edits, so that these stay as they
/// are; else the last one allowed.
[[nodiscard]] Step treatment_step(const Operation& operation, const std::vector<LogEntry>& log);

/// The note of an edit that treats a finding: what was found.
[[nodiscard]] std::string treatment_note(const Finding& finding);

/// Runs the operation that treats a finding, as an edit whose note says what was found.
/// \throw DiagnosedFailure if none treats it; what Session::apply() throws
LogEntry accept(Session& session, const Finding& finding, const std::string& variant,
                const Progress& progress = {});

}  // namespace vesselbench
