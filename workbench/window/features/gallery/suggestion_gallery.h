#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "workbench/session/task.h"
#include "workbench/suggest/preset_suggestions.h"
#include "workbench/window/features/gallery/spot_list.h"
#include "workbench/window/features/live/live_smoothing.h"

namespace vesselbench {

/// How suggestions are looked at.
enum class GalleryMode {
    Off,
    Models,  ///< whole models side by side, seen by one camera (thesis 6.5.6, Fig. 6.18)
    Spots    ///< beside the model, one spot magnified under each of them (Fig. 6.19)
};

/// Those found so far: little, medium, strong.
struct GalleryAnswer {
    std::vector<std::shared_ptr<const PresetSuggestion>> found;
};

/// The gallery of suggestions for a smoothing form, and the spots that are inspected in it. What
/// was found stays while the gallery is closed, until it no longer suits the form. Used by the
/// frame's thread; no call blocks but the destructor.
class SuggestionGallery {
public:
    /// \param wake called by another thread when update() has something to do
    explicit SuggestionGallery(const std::function<void()>& wake);

    static constexpr std::size_t kCount = 3;

    /// Once a frame. \return true if what is shown has changed
    bool update(const LiveSmoothing::Followed& followed, const LiveSmoothing& live);

    [[nodiscard]] GalleryMode mode() const { return mode_; }

    /// Ignored without a form that smooths a model.
    void show(GalleryMode mode);

    /// As show(), or ends the mode if it is shown.
    void toggle(GalleryMode mode) { show(mode_ == mode ? GalleryMode::Off : mode); }

    /// One of kCount; null: not found yet.
    [[nodiscard]] std::shared_ptr<const PresetSuggestion> suggestion(std::size_t i) const;

    /// The surface that is smoothed; null: none.
    [[nodiscard]] const std::shared_ptr<const Surface>& original() const { return original_; }

    /// Why there are no suggestions; empty: no problem.
    [[nodiscard]] const std::string& problem() const { return searches_.problem(); }

    /// True while suggestions are searched.
    [[nodiscard]] bool searches() const { return mode_ != GalleryMode::Off && searches_.pending(); }

    [[nodiscard]] bool pending() const { return searches() || spots.pending(); }

    /// The texts by which a form makes a suggestion.
    [[nodiscard]] static std::vector<FieldText> texts(const OperationForm& form,
                                                      const PresetSuggestion& suggestion);

    /// A suggestion was filled in: the others still suit the form.
    void took(const OperationForm& form);

    /// True while a click on the model makes a spot.
    [[nodiscard]] bool picks() const {
        return mode_ == GalleryMode::Spots && spots.is_read() && (picks_ || spots.all().empty());
    }

    void pick(bool on) { picks_ = on; }

    /// Adds a spot, and ends picking.
    void add_spot(const Vec3& point, const Vec3& normal);

    SpotList spots;

private:
    void ask(const LiveSmoothing::Followed& followed, const LiveSmoothing& live);
    void take_original(const Scene* scene);
    void drop();

    /// What was asked for.
    struct Asked {
        int base = -1;
        Arguments given;

        bool operator==(const Asked&) const = default;
    };

    Task<GalleryAnswer> searches_;
    GalleryMode mode_ = GalleryMode::Off;
    bool possible_ = false;  ///< a form smooths a model
    Asked asked_;
    std::shared_ptr<const Surface> original_;
    bool picks_ = false;
};

}  // namespace vesselbench
