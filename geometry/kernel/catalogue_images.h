#pragma once

#include <span>

#include "geometry/kernel/catalogue_text.h"

namespace vesselbench {

/// The part of the catalogue about files, images, extraction.
[[nodiscard]] std::span<const CatalogueText> image_texts();

}  // namespace vesselbench
