#include "workbench/window/features/quality/quality_feature.h"

#include "workbench/window/features/gallery/gallery_feature.h"
#include "workbench/window/features/live/live_feature.h"

namespace vesselbench {

void QualityFeature::begin_setting() {
    LiveFeature& live = core_.get<LiveFeature>();
    if (live.live().has_form()) return live.begin_driving();
    if (quality_.can_analyse()) set_ = core_.begin_drag();
}

bool QualityFeature::is_setting() const {
    return core_.is_dragging(set_) || core_.get<LiveFeature>().is_driving();
}

bool QualityFeature::update() {
    // Three suggestions that are waited for, and whatever runs, come first.
    const bool busy =
        core_.get<GalleryFeature>().gallery().searches() || core_.document.activity().has_value();
    return quality_.update(core_.get<LiveFeature>().followed(), busy ? QualityPace::Paused
                                                                : is_setting()
                                                                    ? QualityPace::Dragged
                                                                    : QualityPace::Full);
}

}  // namespace vesselbench
