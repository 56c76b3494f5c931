#include "workbench/window/workplace/feature_table.h"

#include <memory>

#include "workbench/window/features/brush/brush_feature.h"
#include "workbench/window/features/colours/colours_feature.h"
#include "workbench/window/features/compare/compare_feature.h"
#include "workbench/window/features/extraction/extraction_feature.h"
#include "workbench/window/features/findings/findings_feature.h"
#include "workbench/window/features/gallery/gallery_feature.h"
#include "workbench/window/features/handles/handles_feature.h"
#include "workbench/window/features/history/history_feature.h"
#include "workbench/window/features/live/live_feature.h"
#include "workbench/window/features/measures/measures_feature.h"
#include "workbench/window/features/openings/openings_feature.h"
#include "workbench/window/features/picture/picture_feature.h"
#include "workbench/window/features/quality/quality_feature.h"
#include "workbench/window/features/result/result_feature.h"
#include "workbench/window/features/review/review_feature.h"
#include "workbench/window/features/slices/slices_feature.h"

namespace vesselbench {

void add_features(Core& core, const LiveDevice& device) {
    FeatureList& all = core.features;
    all.add(std::make_unique<HistoryFeature>(core));
    all.add(std::make_unique<CompareFeature>(core));
    all.add(std::make_unique<ColoursFeature>(core));
    all.add(std::make_unique<LiveFeature>(core, device));
    all.add(std::make_unique<GalleryFeature>(core));
    all.add(std::make_unique<QualityFeature>(core));
    all.add(std::make_unique<ExtractionFeature>(core));
    all.add(std::make_unique<OpeningsFeature>(core));
    all.add(std::make_unique<SlicesFeature>(core));
    all.add(std::make_unique<MeasuresFeature>(core));
    all.add(std::make_unique<HandlesFeature>(core));
    all.add(std::make_unique<BrushFeature>(core));
    all.add(std::make_unique<FindingsFeature>(core));
    all.add(std::make_unique<PictureFeature>());
    all.add(std::make_unique<ResultFeature>(core));
    all.add(std::make_unique<ReviewFeature>(core));
}

}  // namespace vesselbench
