#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "geometry/kernel/deviation_map.h"
#include "workbench/session/session_runner.h"
#include "workbench/session/surface_change.h"
#include "workbench/window/case/edit_input.h"
#include "workbench/window/case/known_models.h"

namespace vesselbench {

/// The model of a case's current state, the one that an edit of it runs on, or a preview in their
/// place, and what is derived from it. What is not at hand is found by the session's thread while
/// no request of the user runs.
class ShownScene {
public:
    /// \param report called with the reason if something cannot be found
    explicit ShownScene(std::function<void(const std::string& text)> report);

    /// The case is in another state, or another variant is shown. The last scene stays until the
    /// new one is known.
    void follow(std::shared_ptr<const Snapshot> snapshot, std::string variant);

    /// Shows what an edit runs on, as long as the followed state has it; none: the newest model.
    /// The last scene stays until the new one is known.
    void stand_before(const std::optional<EditSite>& site);

    /// A scene that a request has found, which is used if it is the awaited one.
    void offer(ResultId result, const Scene& scene);

    /// The newest model of the followed state, as offer().
    void offer_newest(const Scene& scene) { offer(newest_, scene); }

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

    /// True while another scene is shown than what should be.
    [[nodiscard]] bool outdated() const { return model_.wanted; }

    /// Counts changes of scene().
    [[nodiscard]] int changes() const { return changes_; }

    // --- the scene

    /// The preview's, else current(); null while none is known.
    [[nodiscard]] const Scene* scene() const { return preview_ ? &preview_->scene() : current(); }

    /// What a preview replaces: what the edit runs on, else the newest model.
    [[nodiscard]] const Scene* current() const {
        return models_.shown() != nullptr ? &models_.shown()->scene : nullptr;
    }

    /// What the edit of stand_before() runs on, which current() is as soon as it is known; none:
    /// the newest model is meant.
    [[nodiscard]] const std::optional<EditInput>& input() const { return input_; }

    /// The newest model, also while another one is shown; null while it is not known.
    [[nodiscard]] const Scene* newest() const;

    [[nodiscard]] const std::optional<Preview>& previewed() const { return preview_; }

    void show_preview(const Preview& preview);

    void drop_preview();

    // --- what is derived from it

    [[nodiscard]] const ShownFigures& figures() const;

    void want_deviation(bool wanted);

    /// From the source; of a preview, from the surface of current(). Null while it is not wanted,
    /// not known yet, or there is nothing to compare with.
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

    void renew();
    void show(ResultId result, Scene scene);
    void model_changed();
    void scene_changed();
    [[nodiscard]] bool has_comparable() const;
    void ask_deviation();
    void ask_source();
    bool poll_model();
    bool poll_figures();
    bool poll_deviation();
    bool poll_source();
    template <class Result>
    std::optional<Result> taken(Wish<Result>& wish, const char* what);
    void request_figures(SessionRunner& runner);
    void request_deviation(SessionRunner& runner);
    void request_source(SessionRunner& runner);
    [[nodiscard]] std::optional<EditId> source_edit() const;

    static constexpr ResultId kNone = -1;  ///< of what could not be read

    std::function<void(const std::string&)> report_;
    std::shared_ptr<const Snapshot> snapshot_;
    std::string variant_;
    std::optional<EditSite> site_;
    std::optional<EditInput> input_;  ///< of `site_`
    ResultId newest_ = kNone;         ///< of the followed state
    ResultId wanted_ = kNone;         ///< what should be shown
    KnownModels models_;
    std::optional<Preview> preview_;
    std::shared_ptr<const DeviationMap> known_deviation_;
    std::optional<Surface> known_source_;
    bool wants_deviation_ = false, wants_source_ = false;
    Wish<Scene> model_;  ///< of `wanted_`
    Wish<ShownFigures> figures_;
    Wish<std::shared_ptr<const DeviationMap>> deviation_;
    Wish<Scene> source_;
    int changes_ = 0;
};

}  // namespace vesselbench
