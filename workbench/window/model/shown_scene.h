#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "geometry/kernel/deviation_map.h"
#include "workbench/session/session_runner.h"
#include "workbench/session/surface_change.h"

namespace vesselbench {

/// Figures of the shown scene.
struct ShownFigures {
    std::optional<double> volume;  ///< [mm^3]
    bool inside_out = false;       ///< closed, and its normals point inward
    /// From the source, of the wall without what was made at its ends; none: it is the source.
    std::optional<PointDeviation> deviation;
};

/// The scene of a case's current state, or of a preview in its place, and what is derived from it.
/// What is not at hand is found by the session's thread while no request of the user runs.
class ShownScene {
public:
    /// \param report called with the reason if something cannot be found
    explicit ShownScene(std::function<void(const std::string& text)> report);

    /// The case is in another state, or another variant is shown. The last scene stays until the
    /// new one is known.
    void follow(std::shared_ptr<const Snapshot> snapshot, std::string variant);

    /// The scene of the followed state, if a request has found it.
    void set(Scene scene);

    /// The scene after an edit, which is used if it is the awaited one.
    void offer(EditId edit, const Scene& scene);

    /// The case is closed.
    void clear();

    /// Takes what has been found. \return true if something has changed
    bool poll();

    /// Starts to find what is missing.
    void request(SessionRunner& runner);

    /// Cancels what runs, until request().
    void pause();

    /// True while something is wanted and not known.
    [[nodiscard]] bool pending() const;

    /// True while the scene is that of an earlier state.
    [[nodiscard]] bool outdated() const { return state_.wanted; }

    /// Counts changes of scene().
    [[nodiscard]] int changes() const { return changes_; }

    // --- the scene

    /// The preview's, else the state's; null while none is known.
    [[nodiscard]] const Scene* scene() const { return preview_ ? &preview_->scene() : current(); }

    /// The state's.
    [[nodiscard]] const Scene* current() const { return current_ ? &*current_ : nullptr; }

    [[nodiscard]] const std::optional<Preview>& previewed() const { return preview_; }

    void show_preview(const Preview& preview);

    void drop_preview();

    // --- what is derived from it

    [[nodiscard]] const ShownFigures& figures() const { return known_figures_; }

    void want_deviation(bool wanted);

    /// From the source; of a preview, from the state's surface. Null while it is not wanted, not
    /// known yet, or there is nothing to compare with.
    [[nodiscard]] const std::shared_ptr<const DeviationMap>& deviation() const {
        return known_deviation_;
    }

    void want_source(bool wanted);

    /// The surface as the source's step left it; none while it is not wanted, not known yet, or is
    /// the shown one.
    [[nodiscard]] const std::optional<Surface>& source() const { return known_source_; }

private:
    /// What the session's thread finds between the user's requests: what was cancelled for one of
    /// them is due again after it.
    template <class Result>
    struct Wish {
        bool wanted = false;  ///< and not known
        Task<Result> task;

        /// It is wanted, and not the one before.
        void ask() {
            forget();
            wanted = true;
        }

        void forget() {
            task.forget();
            wanted = false;
        }

        [[nodiscard]] bool due() const { return wanted && !task.pending(); }
    };

    void scene_changed();
    void ask_deviation();
    void ask_source();
    bool poll_state();
    bool poll_figures();
    bool poll_deviation();
    bool poll_source();
    template <class Result>
    std::optional<Result> taken(Wish<Result>& wish, const char* what);
    void request_state(SessionRunner& runner);
    void request_figures(SessionRunner& runner);
    void request_deviation(SessionRunner& runner);
    void request_source(SessionRunner& runner);
    [[nodiscard]] std::optional<EditId> source_edit() const;

    std::function<void(const std::string&)> report_;
    std::shared_ptr<const Snapshot> snapshot_;
    std::string variant_;
    std::optional<Scene> current_;
    std::optional<Preview> preview_;
    ShownFigures known_figures_;
    std::shared_ptr<const DeviationMap> known_deviation_;
    std::optional<Surface> known_source_;
    bool wants_deviation_ = false, wants_source_ = false;
    Wish<Scene> state_;
    Wish<ShownFigures> figures_;
    Wish<std::shared_ptr<const DeviationMap>> deviation_;
    Wish<Scene> source_;
    int changes_ = 0;
};

}  // namespace vesselbench
