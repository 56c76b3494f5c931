#include "workbench/window/case/stroke_queue.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "geometry/kernel/diagnosed_error.h"

namespace vesselbench {

void StrokeQueue::begin(SessionRunner& runner, StrokeRequest request, const EditOptions& options) {
    strokes_.push_back(std::make_unique<LiveStroke>(runner, std::move(request), options));
}

void StrokeQueue::add(const StrokePlace& place) {
    if (!painting()) return;
    try {
        strokes_.back()->add(place);
    } catch (const std::exception& error) {
        failed_.push_back(
            {.operation = strokes_.back()->operation(), .error = diagnostics_of(error).front()});
        drop();
    }
}

void StrokeQueue::end() {
    if (painting()) strokes_.back()->end();
}

void StrokeQueue::drop() {
    if (!painting()) return;
    strokes_.back()->cancel();
    strokes_.pop_back();
    moves_.clear();
}

void StrokeQueue::cancel() {
    for (const auto& stroke : strokes_) stroke->cancel();
}

void StrokeQueue::finish() noexcept {
    drop();
    for (const auto& stroke : strokes_) stroke->finish();
    strokes_.clear();
}

std::vector<EndedStroke> StrokeQueue::poll() {
    std::vector<EndedStroke> ended = std::exchange(failed_, {});
    for (auto& stroke : strokes_) {
        const std::size_t before = ended.size();
        poll(*stroke, ended);
        if (ended.size() > before) stroke.reset();
    }
    std::erase(strokes_, nullptr);
    return ended;
}

void StrokeQueue::poll(LiveStroke& stroke, std::vector<EndedStroke>& ended) {
    const std::string operation = stroke.operation();
    try {
        std::ranges::move(stroke.poll(), std::back_inserter(moves_));
        if (!stroke.ended()) return;
        ended.push_back({.operation = operation, .entry = stroke.entry()});
        if (stroke.scene() != nullptr) ended.back().scene = *stroke.scene();
    } catch (const Cancelled&) {
        stroke.cancel();
        ended.push_back({.operation = operation, .cancelled = true});
    } catch (const std::exception& error) {
        stroke.cancel();
        ended.push_back({.operation = operation, .error = diagnostics_of(error).front()});
    }
}

bool StrokeQueue::painting() const {
    return !strokes_.empty() && !strokes_.back()->ending();
}

const LiveStroke* StrokeQueue::entering() const {
    return strokes_.empty() || !strokes_.front()->ending() ? nullptr : strokes_.front().get();
}

const Scene* StrokeQueue::scene() const {
    for (auto stroke = strokes_.rbegin(); stroke != strokes_.rend(); ++stroke)
        if ((*stroke)->scene() != nullptr) return (*stroke)->scene();
    return nullptr;
}

}  // namespace vesselbench
