#include "workbench/window/features/picking/clicked_places.h"

#include <utility>

#include "workbench/window/drawing/model_drawing.h"

namespace vesselbench {

ClickedPlaces::ClickedPlaces(Renderer& renderer, std::function<void()> wake)
    : picker_(renderer), wake_(std::move(wake)) {}

void ClickedPlaces::add(const SeenModel& seen) {
    clicks_.push_back({seen.view, seen.layers, seen.screen.device_pixel(mouse_pixel())});
}

/// One after the other: a request would forget the one before.
void ClickedPlaces::search() {
    if (clicks_.empty() || picker_.pending()) return;
    const Click& click = clicks_.front();
    picker_.request(click.view, click.layers, click.pixel.x(), click.pixel.y());
    clicks_.pop_front();
}

std::optional<Vec3> ClickedPlaces::update() {
    const auto picked = picker_.result();
    search();
    if (picker_.pending() && wake_) wake_();
    if (!picked || picked->layer != kModelLayer) return std::nullopt;
    return picked->point;
}

void ClickedPlaces::forget() {
    clicks_.clear();
    picker_.forget();
}

}  // namespace vesselbench
