#include "workbench/window/model/place_search.h"

#include <chrono>
#include <utility>

#include "geometry/kernel/errors.h"

namespace vesselbench {

PlaceSearch::PlaceSearch(std::function<void()> wake) : wake_(std::move(wake)) {}

PlaceSearch::~PlaceSearch() {
    stop_.request_stop();
}

void PlaceSearch::begin(const Surface* surface, bool tips) {
    places_ = {};
    wanted_.reset();
    if (surface != nullptr && !surface->empty()) wanted_ = Request{*surface, tips};
    outdated_ = next_.valid();
    if (outdated_)
        stop_.request_stop();
    else
        start();
}

void PlaceSearch::start() {
    outdated_ = false;
    if (!wanted_) return;
    stop_ = {};
    next_ = std::async(std::launch::async, [request = *std::exchange(wanted_, std::nullopt),
                                            stop = stop_.get_token(), wake = wake_] {
        SurfacePlaces places;
        try {
            places = places_of(request.surface, request.tips, Progress(nullptr, stop));
        } catch (const std::exception& error) {
            places.problem = error.what();
        }
        if (wake) wake();
        return places;
    });
}

bool PlaceSearch::update() {
    using namespace std::chrono_literals;
    if (!next_.valid() || next_.wait_for(0s) != std::future_status::ready) return false;
    SurfacePlaces places = next_.get();
    if (outdated_) {
        start();
        return false;
    }
    places_ = std::move(places);
    return true;
}

}  // namespace vesselbench
