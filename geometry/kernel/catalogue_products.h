#pragma once

#include <span>

#include "geometry/kernel/catalogue_text.h"

namespace vesselbench {

/// The part of the catalogue about findings, products.
[[nodiscard]] std::span<const CatalogueText> product_texts();

}  // namespace vesselbench
