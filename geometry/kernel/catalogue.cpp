#include "geometry/kernel/catalogue.h"

#include <algorithm>
#include <vector>

#include "geometry/kernel/catalogue_edits.h"
#include "geometry/kernel/catalogue_images.h"
#include "geometry/kernel/catalogue_openings.h"
#include "geometry/kernel/catalogue_products.h"
#include "geometry/kernel/catalogue_projects.h"
#include "geometry/kernel/catalogue_refusals.h"
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

bool is_note(const Diagnostic& diagnostic) {
    const auto texts = catalogue();
    const auto entry = std::ranges::find_if(
        texts, [&](const CatalogueText& known) { return diagnostic.code == known.code; });
    return entry != texts.end() && entry->note && diagnostic.remedies.empty() &&
           diagnostic.severity == Severity::Warning;
}

}  // namespace vesselbench
