#pragma once

#include <span>

#include "geometry/kernel/catalogue_text.h"

namespace vesselbench {

/// The part of the catalogue about recipes, record, verdicts.
[[nodiscard]] std::span<const CatalogueText> project_texts();

}  // namespace vesselbench
