#include "workbench/window/model/place_search.h"

#include <utility>

namespace vesselbench {

PlaceSearch::PlaceSearch(std::function<void()> wake) : task_(std::move(wake)) {}

void PlaceSearch::begin(const Surface* surface, bool tips) {
    places_ = {};
    task_.forget();
    if (surface == nullptr || surface->empty()) return;
    task_.begin([surface = *surface, tips](const Progress& progress) {
        return places_of(surface, tips, progress);
    });
}

bool PlaceSearch::update() {
    auto places = task_.take();
    std::string problem = task_.take_problem();
    if (!places && problem.empty()) return false;
    places_ = places ? std::move(*places) : SurfacePlaces{.problem = std::move(problem)};
    return true;
}

}  // namespace vesselbench
