#include "workbench/window/workplace/workplace.h"

#include <utility>

#include "workbench/window/features/colours/colours_feature.h"
#include "workbench/window/features/compare/compare_feature.h"
#include "workbench/window/features/extraction/extraction_feature.h"
#include "workbench/window/features/gallery/gallery_feature.h"
#include "workbench/window/features/live/live_feature.h"
#include "workbench/window/features/measures/measures_feature.h"
#include "workbench/window/features/openings/openings_feature.h"
#include "workbench/window/features/quality/quality_feature.h"
#include "workbench/window/features/slices/slices_feature.h"
#include "workbench/window/workplace/feature_table.h"

namespace vesselbench {

Workplace::Workplace(const DocumentOptions& options, Settings remembered, const LiveDevice& device)
    : Core(options, std::move(remembered)) {
    add_features(*this, device);
}

std::optional<Comparison>& Workplace::comparison() const {
    return get<CompareFeature>().comparison();
}

LiveSmoothing& Workplace::live() const {
    return get<LiveFeature>().live();
}

QualityAnalysis& Workplace::quality() const {
    return get<QualityFeature>().quality();
}

SuggestionGallery& Workplace::gallery() const {
    return get<GalleryFeature>().gallery();
}

LiveExtraction& Workplace::extraction() const {
    return get<ExtractionFeature>().extraction();
}

bool Workplace::has_live_form() const {
    return live().has_form() || extraction().has_form() || quality().has_form();
}

OpeningsModel& Workplace::openings() const {
    return get<OpeningsFeature>().openings();
}

ImageSlices& Workplace::slices() const {
    return get<SlicesFeature>().slices();
}

MeasureList& Workplace::measures() const {
    return get<MeasuresFeature>().measures();
}

const ViewData& Workplace::view_data() const {
    return get<ColoursFeature>().view_data();
}

}  // namespace vesselbench
