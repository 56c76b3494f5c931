#pragma once

#include "workbench/prepare/recipe_entry.h"
#include "workbench/session/session.h"

namespace vesselbench {

/// True if an extraction would take several labels as one vessel that nobody chose.
[[nodiscard]] bool takes_unchosen_labels(const Arguments& given, const Scene& scene);

/// The entry as it runs on the session's newest scene: RecipeEntry::if_drawn drops the method where
/// the mask was a level set, or is bounded by a value. Entries that make no surface of an image
/// stay as they are.
/// \throw DiagnosedUsage (kLabelUnchosen) if it takes_unchosen_labels()
[[nodiscard]] RecipeEntry extraction_entry(const RecipeEntry& entry, Session& session);

}  // namespace vesselbench
