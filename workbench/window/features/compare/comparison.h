#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "geometry/kernel/deviation_map.h"
#include "workbench/session/task.h"
#include "workbench/window/case/document.h"

namespace vesselbench {

enum class CompareMode {
    SideBySide,
    Blink,     ///< the two in turn, in the same place
    Deviation  ///< the shown surface, coloured by its distance from the reference
};

/// The model that an edit of the current state runs on.
struct EditStart {
    EditId edit = 0;
    ResultId result = 0;  ///< that is known of it

    bool operator==(const EditStart&) const = default;
};

/// What is compared with the shown scene: a state of the history, or the model before an edit.
using Reference = std::variant<StateId, EditStart>;

/// What lies between the reference and the shown scene.
struct SceneDifference {
    SurfaceChange change;
    std::shared_ptr<const DeviationMap> map;  ///< of the shown surface; null if one has none
};

/// Compares a reference with whatever the window shows: the current state, a preview, or the model
/// that stands before an edit. The session's runner reads the reference; the difference is measured
/// on another thread, so that no request waits for it. Used by the frame's thread.
class Comparison {
public:
    static constexpr double kBlinkTime = 0.8;  ///< for which each of the two is shown [s]

    /// \param wake called by another thread when update() has something to do
    explicit Comparison(const Reference& reference, CompareMode mode = CompareMode::SideBySide,
                        std::function<void()> wake = {})
        : reference_(reference), mode_(mode), measuring_(std::move(wake)) {}

    /// Cancels what runs.
    ~Comparison();

    Comparison(const Comparison&) = delete;
    Comparison& operator=(const Comparison&) = delete;

    /// Collects what is ready and requests what is missing, once a frame while the case is open.
    /// \return true if something has changed
    bool update(Document& document);

    [[nodiscard]] const Reference& reference() const { return reference_; }

    [[nodiscard]] CompareMode mode() const { return mode_; }

    /// Blinking begins with the reference, and goes on by itself.
    void set_mode(CompareMode mode);

    /// The reference's scene, as far as its edits have run; null until it is read.
    [[nodiscard]] const Scene* scene() const { return scene_ ? &*scene_ : nullptr; }

    /// Counts changes of scene().
    [[nodiscard]] int scene_changes() const { return scene_changes_; }

    /// None until it is measured.
    [[nodiscard]] const std::optional<SceneDifference>& difference() const { return difference_; }

    /// Why the reference cannot be read, or not be compared; empty: it can.
    [[nodiscard]] const std::string& problem() const { return problem_; }

    [[nodiscard]] bool pending() const { return reading_.pending() || measuring_.pending(); }

    // --- blinking

    /// True if the reference is to be seen instead of the shown scene.
    [[nodiscard]] bool blinks_reference() const {
        return mode_ == CompareMode::Blink && on_reference_ && scene_;
    }

    /// Shows the other one; from now on only this call does.
    void switch_by_hand();

    /// Shows the other one if its time has come. \param now [s]
    void blink(double now);

    /// Time until blink() has something to do [s]; none: it never has.
    [[nodiscard]] std::optional<double> next_blink(double now) const;

private:
    void read(Document& document);
    void measure(Document& document);
    bool take_scene();
    bool take_difference();

    Reference reference_;
    CompareMode mode_;
    std::string variant_;
    std::optional<Scene> scene_;
    std::optional<SceneDifference> difference_;
    Task<Scene> reading_;
    Task<SceneDifference> measuring_;
    std::string problem_;
    int scene_changes_ = 0;
    int measured_scenes_ = -1;  ///< the document's scene changes at the last measuring
    bool on_reference_ = true, by_hand_ = false;
    std::optional<double> switches_at_;  ///< [s]
};

}  // namespace vesselbench
