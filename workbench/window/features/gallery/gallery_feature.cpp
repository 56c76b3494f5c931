#include "workbench/window/features/gallery/gallery_feature.h"

#include "workbench/window/core/panel_context.h"
#include "workbench/window/core/shown.h"
#include "workbench/window/features/live/live_feature.h"

namespace vesselbench {

void GalleryFeature::show(GalleryMode mode) {
    gallery_.toggle(mode);
    if (gallery_.mode() == GalleryMode::Off) return;
    core_.claim_view(*this);
    core_.view.flies = false;
    if (mode != GalleryMode::Models) return;
    core_.disarm();
    core_.view.tool = ClickTool::None;
    core_.document.drop_preview();
}

void GalleryFeature::take(std::size_t suggestion) {
    const auto taken = gallery_.suggestion(suggestion);
    if (!core_.form() || !taken) return;
    core_.fill_form(SuggestionGallery::texts(*core_.form(), *taken));
    gallery_.took(*core_.form());
    gallery_.show(GalleryMode::Off);
    core_.get<LiveFeature>().live().follow(true);
}

bool GalleryFeature::leave() {
    if (gallery_.mode() == GalleryMode::Off) return false;
    if (gallery_.picks() && !gallery_.spots.all().empty())
        gallery_.pick(false);
    else
        gallery_.show(GalleryMode::Off);
    return true;
}

bool GalleryFeature::update() {
    if (core_.view.flies) model_wanted();
    LiveFeature& live = core_.get<LiveFeature>();
    return gallery_.update(live.followed(), live.live());
}

void GalleryFeature::keys(PanelContext& context) {
    if (context.shown.keys.has(KeyCommand::Gallery)) show(GalleryMode::Models);
    if (context.shown.keys.has(KeyCommand::Spots)) show(GalleryMode::Spots);
}

void GalleryFeature::end_spots() {
    const std::string lost = gallery_.spots.close();
    if (!lost.empty())
        core_.document.tell(
            make_message(MessageKind::Error, "the last change of the spots is lost: " + lost));
}

void GalleryFeature::case_opened() {
    end_spots();
    gallery_.spots.open(core_.document.project(), core_.document.snapshot()->read_only_reason);
}

void GalleryFeature::case_closed() {
    gallery_.show(GalleryMode::Off);
    end_spots();
}

void GalleryFeature::model_wanted() {
    if (gallery_.mode() == GalleryMode::Models) gallery_.show(GalleryMode::Off);
}

}  // namespace vesselbench
