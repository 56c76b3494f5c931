#pragma once

#include <cstddef>

#include "workbench/session/session.h"

namespace vesselbench {

/// Returns if the project is what its record says (check_record_rows()): a verdict that was
/// deleted, or the number of reviewers that it asks for, is missed there. A project that asks for
/// no reviewers and of which the record knows no review passes as it is.
/// \param reviewers that are asked for
/// \throw DiagnosedFailure `record-contradicted`, with what contradicts the record
void require_sound_record(const Session& session, std::size_t reviewers);

}  // namespace vesselbench
