#pragma once

#include <span>
#include <string>

#include "workbench/review/entered_verdicts.h"
#include "workbench/review/verdicts.h"
#include "workbench/session/session.h"

namespace vesselbench {

/// What verdicts have to be beyond what verdicts_from_text() reads, before they are entered: of
/// this project and its record; with a reviewer's name that hides nothing and is not nearly that of
/// another reviewer; with times that exist and are not more than ten minutes ahead; and, where they
/// reject the whole model, on all edits of a variant that the reviewer's page had.
/// \param name of the verdicts in error texts
/// \param entered what the project has already
/// \throw InvalidInput that names the field
void check_before_entering(const VerdictFile& file, const std::string& name, const Session& session,
                           std::span<const EnteredVerdicts> entered);

}  // namespace vesselbench
