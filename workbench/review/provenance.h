#pragma once

#include <string>

#include "workbench/review/review.h"
#include "workbench/session/session.h"

namespace vesselbench {

/// What a project is called in files that leave it: the name that its input was given (`--name`),
/// so that no file name leaves, else its file's name without suffix, or, as `prepare` calls all of
/// its projects the same, that of the file that the case was made from.
[[nodiscard]] std::string shown_name(const Session& session);

/// One line for the headers of exported files: "project carotid, cfd, accepted by A. Kern, model
/// 1a2b3c4d5e6f". The model's digits are the first of the SHA-256 that its result has in the
/// record. It depends on the edits and verdicts alone, neither on times nor on where the project
/// is: two preparations of the same input write the same bytes, and so do two exports of a project.
/// The record's head does neither, as it binds times, and every export adds an entry.
/// \param review of the variant, with those verdicts that count
[[nodiscard]] std::string provenance(const Session& session, const std::string& variant,
                                     const Review& review);

}  // namespace vesselbench
