#pragma once

#include <span>

#include "geometry/kernel/catalogue_text.h"

namespace vesselbench {

/// The part of the catalogue about repairs, local edits, smoothing.
[[nodiscard]] std::span<const CatalogueText> edit_texts();

}  // namespace vesselbench
