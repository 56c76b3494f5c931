#pragma once

#include <string>
#include <vector>

#include "workbench/findings/finding.h"
#include "workbench/session/session.h"

namespace vesselbench {

/// The step in which an operation treats what was found on a variant's newest model: its usual one,
/// else the first allowed one that comes behind the variant's edits, so that these stay as they
/// are; else the last one allowed. What belongs to the vessel is decided in step Branches, whatever
/// comes behind it: the edits there run again.
[[nodiscard]] Step treatment_step(const Operation& operation, const std::vector<LogEntry>& log);

/// The note of an edit that treats a finding: what was found.
[[nodiscard]] std::string treatment_note(const Finding& finding);

/// Tries the operation that treats a finding, and enters nothing.
/// \return why it is refused, in words; empty: it is not, or there is none
/// \throw what Session::preview() throws of a project that cannot be read; Cancelled
[[nodiscard]] std::string refusal_of(Session& session, const Finding& finding,
                                     const std::string& variant, const Progress& progress = {});

/// Runs the operation that treats a finding, as an edit whose note says what was found.
/// \param taken_as key of the reading that a question is answered with; empty: it is no question
/// \throw UsageError as require_answer(); DiagnosedFailure if no operation treats it; what
///        Session::apply() throws
LogEntry treat(Session& session, const Finding& finding, const std::string& taken_as,
               const std::string& variant, const Progress& progress = {});

}  // namespace vesselbench
