#pragma once

#include <functional>
#include <string>

#include "workbench/batch/plan.h"

namespace vesselbench {

/// Receives lines for the user, from any thread but one at a time.
using BatchTeller = std::function<void(const std::string&)>;

/// A small picture of the model, in a case's folder; missing without usable OpenGL.
inline constexpr const char* kThumbnail = "thumbnail.png";

/// Runs a case in processes of its own, and keeps what came of it in the case's folder; a run that
/// is killed from outside is tried again.
/// \param tell receives a remark for the user
/// \return its record, which the folder holds as well
/// \throw IoError if the folder cannot be written; Cancelled: the case is to be run again
[[nodiscard]] CaseRecord run_case(const PlannedCase& one, const BatchOptions& options,
                                  const BatchTeller& tell, const Progress& progress);

/// "done (8.2 s, 240 MiB)", "failed (0.3 s, 90 MiB): bad-input: ..."
[[nodiscard]] std::string outcome_text(const CaseRecord& record);

}  // namespace vesselbench
