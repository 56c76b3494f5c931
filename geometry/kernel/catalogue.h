#pragma once

#include <span>

#include "geometry/kernel/catalogue_text.h"
#include "geometry/kernel/diagnostic.h"

namespace vesselbench {

/// All texts of errors and warnings that have a code; each code once.
[[nodiscard]] std::span<const CatalogueText> catalogue();

/// True for what readers may know, but need not look at: a note of the catalogue that leaves
/// nothing to do. Projects store it as a warning.
[[nodiscard]] bool is_note(const Diagnostic& diagnostic);

}  // namespace vesselbench
