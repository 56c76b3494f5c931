#pragma once

#include <span>

#include "geometry/kernel/catalogue.h"

namespace vesselbench {

/// Of a text: CatalogueText::note.
inline constexpr bool kNote = true;

/// The catalogue by topics, each in a file of its own (catalogue_edits.cpp ...).
[[nodiscard]] std::span<const CatalogueText> image_texts();    ///< files, images, extraction
[[nodiscard]] std::span<const CatalogueText> edit_texts();     ///< repairs, local edits, smoothing
[[nodiscard]] std::span<const CatalogueText> opening_texts();  ///< vessel ends, remeshing
[[nodiscard]] std::span<const CatalogueText> refusal_texts();  ///< what an operation refuses
[[nodiscard]] std::span<const CatalogueText> product_texts();  ///< findings, products
[[nodiscard]] std::span<const CatalogueText> project_texts();  ///< recipes, record, verdicts

}  // namespace vesselbench
