#include "workbench/window/case/live_stroke.h"

#include <utility>

#include "workbench/operations/brush/dabs.h"
#include "workbench/session/surface_change.h"

namespace vesselbench {

namespace {

/// By the local radius of the vessel: places between two others that are farther from the surface
/// are not on the way along it.
constexpr double kBeside = 0.5;

}  // namespace

LiveStroke::LiveStroke(SessionRunner& runner, StrokeRequest request, const EditOptions& options)
    : runner_(runner), request_(std::move(request)) {
    starting_ = runner_.submit([name = request_.operation, given = request_.given, options](
                                   Session& session, const Progress& progress) {
        auto live = std::make_shared<LiveEdit>(session.start_live(name, given, options, progress));
        const Scene before = live->scene();
        return Started{std::move(live), before, distance_to(surface_of(before))};
    });
}

void LiveStroke::cancel() {
    starting_.cancel();
    for (const auto& dab : dabs_) dab.cancel();
    if (committing_) committing_->cancel();
}

void LiveStroke::finish() noexcept {
    try {
        starting_.wait();
        static_cast<void>(poll());
        if (committing_) committing_->wait();
    } catch (const std::exception&) {
        cancel();  // there is nobody left to be told
    }
}

void LiveStroke::add(const StrokePlace& place) {
    waiting_.push_back(place);
    send();
}

void LiveStroke::end() {
    ending_ = true;
    send();
}

void LiveStroke::send() {
    if (!started_) return;
    for (const StrokePlace& place : std::exchange(waiting_, {})) send(place);
    if (ending_ && sent_ && !committing_) committing_ = runner_.commit(started_->live);
}

void LiveStroke::send(const StrokePlace& place) {
    const std::optional<Dab> dab = dab_at(place);
    if (!dab) return;
    sent_ = true;
    dabs_.push_back(runner_.submit(
        [live = started_->live, added = listed({&*dab, 1})](Session&, const Progress& progress) {
            SceneMove move{.before = live->scene()};
            live->add({{"dabs", added}}, progress);
            move.after = live->scene();
            move.changed = changed_vertices(surface_of(move.before), surface_of(move.after));
            return move;
        }));
}

std::optional<Dab> LiveStroke::dab_at(const StrokePlace& place) const {
    const Surface& surface = surface_of(started_->before);
    Dab dab{.anchor = nearest_anchor(surface, *started_->places, place.point, request_.radius),
            .radius = request_.radius,
            .strength = request_.strength,
            .falloff = request_.falloff};
    const double beside = (dab.anchor.point - place.point).norm();
    if (place.between && beside > kBeside * dab.anchor.radius) return std::nullopt;
    dab.anchor.point = place.point;
    dab.anchor.normal = place.normal;
    return dab;
}

std::vector<SceneMove> LiveStroke::poll() {
    if (!started_ && starting_.ended()) {
        started_ = starting_.result();
        send();
    }
    std::vector<SceneMove> moves;
    while (!dabs_.empty() && dabs_.front().ended()) {
        moves.push_back(dabs_.front().result());
        dabs_.pop_front();
        scene_ = moves.back().after;
    }
    if (committing_ && committing_->ended()) static_cast<void>(committing_->result());
    return moves;
}

bool LiveStroke::ended() const {
    if (!ending_ || !started_) return false;
    return committing_ ? committing_->ended() && dabs_.empty() : !sent_;
}

std::optional<LogEntry> LiveStroke::entry() const {
    if (!committing_) return std::nullopt;
    return committing_->result();
}

TaskProgress LiveStroke::progress() const {
    return committing_ ? committing_->progress() : TaskProgress{};
}

}  // namespace vesselbench
