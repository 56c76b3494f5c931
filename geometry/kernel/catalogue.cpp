#include "geometry/kernel/catalogue.h"

#include <vector>

#include "geometry/kernel/catalogue_parts.h"
#include "geometry/kernel/diagnostic.h"

namespace vesselbench {

std::span<const CatalogueText> catalogue() {
    static const std::vector<CatalogueText> all = [] {
        std::vector<CatalogueText> texts = {{kPlainText, "{text}"}};
        for (const auto part : {image_texts(), edit_texts(), opening_texts(), refusal_texts(),
                                product_texts(), project_texts()})
            texts.insert(texts.end(), part.begin(), part.end());
        return texts;
    }();
    return all;
}

}  // namespace vesselbench
