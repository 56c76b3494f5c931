#pragma once

#include <cstddef>
#include <vector>

#include "workbench/review/entered_verdicts.h"
#include "workbench/session/session.h"

namespace vesselbench {

/// Returns if the project is what its record says (check_record_rows()): a verdict that was
/// deleted, or the number of reviewers that it asks for, is missed there; and if the record is that
/// of which the entered verdicts say their reviewers saw it. A project that asks for no reviewers
/// and of which the record knows no review passes as it is.
/// \param reviewers that are asked for
/// \throw DiagnosedFailure `record-contradicted`, with what contradicts the record
void require_sound_record(const Session& session, std::size_t reviewers);

/// Returns if each signature that does not verify is one of the stored bytes all the same: a key
/// may have been taken out of the allowed ones, but what was entered had the right signature.
/// \param entered all verdicts of the project
/// \throw DiagnosedFailure `record-contradicted`; as signature_of()
void require_signed_bytes(const ProjectFile& project, const std::vector<EnteredVerdicts>& entered,
                          const Progress& progress);

}  // namespace vesselbench
