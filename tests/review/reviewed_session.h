#pragma once

#include <string>

#include "workbench/review/review.h"
#include "workbench/review/verdict_import.h"

namespace vesselbench::test {

/// A project with a sphere and two bumps, by Ada, in a folder of its own. \return its path
[[nodiscard]] std::string reviewed_project();

/// What the review page would save now: every edit of the session with the same verdict.
/// \param written UTC
[[nodiscard]] VerdictFile verdicts_on(const Session& session, const std::string& reviewer,
                                      Verdict verdict,
                                      const std::string& written = "2020-01-01T00:00:00Z");

/// Writes the verdicts beside the project. \return the file's path
std::string save_verdicts(const std::string& project, const VerdictFile& verdicts);

}  // namespace vesselbench::test
