#pragma once

#include <span>
#include <string>

#include "workbench/prepare/recipe_entry.h"

namespace vesselbench {

/// The entries that make a surface finer around places.
/// \param texts "x,y,z:radius:edge" each [mm]
/// \throw UsageError if one is not of that form, or a number is out of its range
[[nodiscard]] Recipe refinements(std::span<const std::string> texts);

/// Adds entries to a recipe, each behind those of its step.
void add_entries(Recipe& recipe, const Recipe& entries);

}  // namespace vesselbench
