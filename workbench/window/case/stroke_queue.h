#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "workbench/window/case/live_stroke.h"

namespace vesselbench {

/// How a stroke ended.
struct EndedStroke {
    std::string operation;
    std::optional<LogEntry> entry;  ///< the edit; none: nothing was painted, or it failed
    std::optional<Scene> scene = std::nullopt;       ///< after it
    std::optional<Diagnostic> error = std::nullopt;  ///< none unless it failed
    bool cancelled = false;
};

/// The strokes that have not ended: the one that is painted, and those before it that are being
/// entered. Their runner must outlive them.
class StrokeQueue {
public:
    void begin(SessionRunner& runner, StrokeRequest request, const EditOptions& options);
    void add(const StrokePlace& place);

    /// The painted stroke becomes an edit, or is dropped.
    void end();
    void drop();

    /// Cancels all of them.
    void cancel();

    /// Drops the painted stroke, and waits until the others are entered. For the end of a case;
    /// may be called by another thread than the rest.
    void finish() noexcept;

    /// Collects what has been done. \return strokes that ended
    [[nodiscard]] std::vector<EndedStroke> poll();

    /// What the dabs changed since the last call, in order.
    [[nodiscard]] std::vector<SceneMove> take_moves() { return std::exchange(moves_, {}); }

    [[nodiscard]] bool has_moves() const { return !moves_.empty(); }

    /// True from begin() to end() or drop().
    [[nodiscard]] bool painting() const;

    [[nodiscard]] bool empty() const { return strokes_.empty(); }

    /// The stroke that is being entered; null: none.
    [[nodiscard]] const LiveStroke* entering() const;

    /// The scene after the newest dab; null before the first.
    [[nodiscard]] const Scene* scene() const;

private:
    void poll(LiveStroke& stroke, std::vector<EndedStroke>& ended);

    std::deque<std::unique_ptr<LiveStroke>> strokes_;
    std::vector<SceneMove> moves_;
    std::vector<EndedStroke> failed_;  ///< while dabs were added
};

}  // namespace vesselbench
