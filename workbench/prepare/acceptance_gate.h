#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "workbench/prepare/apply_recipe.h"
#include "workbench/review/review.h"

namespace vesselbench {

/// The number of reviewers who have to accept a purpose's model before its products are written; 0:
/// none. A project keeps the largest that a recipe has asked for, so that resuming without that
/// recipe asks for no less.
/// \param asked by the recipe that runs
/// \throw IoError, InvalidInput if the project cannot be read or written
[[nodiscard]] std::size_t kept_reviewers(const std::filesystem::path& project,
                                         const std::string& purpose, std::size_t asked);

/// Returns if as many reviewers as are asked for, or as the project requires if those are more,
/// have accepted every edit of the purpose's model, the record is sound, and the export can be
/// entered into it.
/// \param review of that model
/// \throw DiagnosedFailure `not-accepted` that names what is missing, `export-not-recorded`; as
/// kept_reviewers() and require_sound_record()
void require_acceptance(const Session& session, const std::filesystem::path& project,
                        const std::string& purpose, std::size_t asked, const Review& review);

/// Returns if so many reviewers have accepted every edit of the purpose's model. Else the folder
/// gets review.html, the page for the reviewers.
/// \throw DiagnosedFailure `not-accepted` that names what is missing; as require_sound_record()
void pass_gate(Session& session, const std::string& purpose, std::size_t reviewers,
               const std::filesystem::path& folder, const Teller& tell, const Progress& progress);

}  // namespace vesselbench
