#pragma once

#include <span>

#include "geometry/kernel/catalogue_text.h"

namespace vesselbench {

/// The part of the catalogue about what an operation refuses.
[[nodiscard]] std::span<const CatalogueText> refusal_texts();

}  // namespace vesselbench
