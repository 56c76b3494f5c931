#pragma once

#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "geometry/kernel/surface_distance.h"
#include "smoothing/brush/brush.h"
#include "workbench/session/session_runner.h"
#include "workbench/window/case/stroke.h"
#include "workbench/window/case/stroke_request.h"

namespace vesselbench {

/// What a dab changed: of two surfaces with the same connectivity, the vertices that moved or that
/// were painted.
struct SceneMove {
    Scene before, after;
    std::vector<VertexId> changed;  ///< ascending
};

/// A stroke of a brush that a session's runner works on: requests return at once, poll() collects
/// the results. One stroke makes one edit. The runner must outlive it.
class LiveStroke {
public:
    LiveStroke(SessionRunner& runner, StrokeRequest request, const EditOptions& options);

    [[nodiscard]] const std::string& operation() const { return request_.operation; }

    /// Appends a dab; sent to the runner once the stroke has started there. \throw AlgorithmFailure
    /// if the triangle there has no area
    void add(const StrokePlace& place);

    /// No further dabs: what was added becomes an edit.
    void end();

    /// Cancels all that waits or runs; nothing is entered.
    void cancel();

    /// After end(): waits until the edit is entered, or has failed.
    void finish() noexcept;

    /// Collects the dabs that were done since the last call, in order. \throw what they or the
    /// edit threw
    [[nodiscard]] std::vector<SceneMove> poll();

    /// The scene after the last collected dab; null before the first.
    [[nodiscard]] const Scene* scene() const { return scene_ ? &*scene_ : nullptr; }

    /// True if end() was called.
    [[nodiscard]] bool ending() const { return ending_; }

    /// True once the edit is entered, or it ended without a dab.
    [[nodiscard]] bool ended() const;

    /// The edit, once ended; none if there was no dab.
    [[nodiscard]] std::optional<LogEntry> entry() const;

    [[nodiscard]] TaskProgress progress() const;

private:
    /// The stroke in the session; the surface before it, and its places.
    struct Started {
        SessionRunner::Live live;
        Scene before;
        std::optional<SurfaceDistance> places;
    };

    void send();
    void send(const StrokePlace& place);
    [[nodiscard]] std::optional<Dab> dab_at(const StrokePlace& place) const;

    SessionRunner& runner_;
    StrokeRequest request_;
    Task<Started> starting_;
    std::optional<Started> started_;
    std::vector<StrokePlace> waiting_;  ///< for the start
    std::deque<Task<SceneMove>> dabs_;  ///< sent and not collected
    std::optional<Task<LogEntry>> committing_;
    std::optional<Scene> scene_;
    bool ending_ = false, sent_ = false;
};

}  // namespace vesselbench
