#include "workbench/window/model/place_search.h"

#include <utility>

namespace vesselbench {

PlaceSearch::PlaceSearch(std::function<void()> wake) : task_(std::move(wake)) {}

void PlaceSearch::begin(const Surface* surface, bool tips) {
    places_ = {};
    task_.forget();
    if (surface == nullptr || surface->empty()) return;
    task_.begin([surface = *surface, tips](const Progress& progress) {
        try {
            return places_of(surface, tips, progress);
        } catch (const Cancelled&) {
            throw;
        } catch (const std::exception& error) {
            return SurfacePlaces{.problem = error.what()};
        }
    });
}

bool PlaceSearch::update() {
    auto places = task_.take();
    if (places) places_ = std::move(*places);
    return places.has_value();
}

}  // namespace vesselbench
