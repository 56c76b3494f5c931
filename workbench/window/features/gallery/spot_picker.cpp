#include "workbench/window/features/gallery/spot_picker.h"

#include <utility>

#include "workbench/window/core/core.h"
#include "workbench/window/drawing/model_drawing.h"
#include "workbench/window/features/gallery/gallery_feature.h"
#include "workbench/window/widgets/ui.h"

namespace vesselbench {

namespace {

constexpr float kMarkReach = 0.8F;  ///< a click so near to a mark chooses its spot [em]

std::vector<NamedPlace> places_of(const SpotList& spots) {
    std::vector<NamedPlace> places;
    for (const Spot& spot : spots.all()) places.push_back({.point = spot.point, .name = spot.name});
    return places;
}

}  // namespace

SpotPicker::SpotPicker(Renderer& renderer, std::function<void()> wake)
    : picker_(renderer), wake_(std::move(wake)) {}

/// A place on a model that has changed since is of no use.
void SpotPicker::take(SuggestionGallery& gallery, const SeenModel& seen) {
    const auto picked = picker_.result();
    if (!picked || !gallery.picks() || version_ != seen.version || picked->layer != kModelLayer ||
        seen.surface == nullptr || picked->element >= seen.surface->triangle_count())
        return;
    const Vec3 normal =
        area_normal(seen.surface->points(), seen.surface->triangles()[picked->element]);
    if (normal.norm() > 0.0) gallery.add_spot(picked->point, normal.normalized());
}

void SpotPicker::update(PanelContext& c, const SeenModel& seen) {
    SuggestionGallery& gallery = c.core.get<GalleryFeature>().gallery();
    if (gallery.mode() != GalleryMode::Spots) return forget();
    take(gallery, seen);
    if (seen.clicked && seen.surface != nullptr && c.core.armed().empty() &&
        !c.core.has_click_tool()) {
        const auto mark = nearest_mark(seen.screen, places_of(gallery.spots), mouse_pixel(),
                                       kMarkReach * c.ui.em);
        if (gallery.picks()) {
            const Eigen::Vector2i pixel = seen.screen.device_pixel(mouse_pixel());
            version_ = seen.version;
            picker_.request(seen.view, seen.layers, pixel.x(), pixel.y());
        } else if (mark) {
            gallery.spots.choose(*mark);
        }
    }
    if (picker_.pending() && wake_) wake_();
}

void SpotPicker::draw(PanelContext& c, const PixelView& screen) const {
    const SuggestionGallery& gallery = c.core.get<GalleryFeature>().gallery();
    if (gallery.mode() != GalleryMode::Spots) return;
    for (const Spot& spot : gallery.spots.all()) {
        const auto at = screen.place(spot.point);
        if (!at) continue;
        const bool chosen = &spot == gallery.spots.chosen();
        draw_mark(c.ui, *at, chosen ? MarkLook::Picked : MarkLook::Offered, spot.name);
    }
    if (gallery.picks())
        draw_hint(c.ui, rect_of(screen), "Click on the place that should be magnified");
}

}  // namespace vesselbench
