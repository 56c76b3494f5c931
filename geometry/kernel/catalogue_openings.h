#pragma once

#include <span>

#include "geometry/kernel/catalogue_text.h"

namespace vesselbench {

/// The part of the catalogue about vessel ends, remeshing.
[[nodiscard]] std::span<const CatalogueText> opening_texts();

}  // namespace vesselbench
