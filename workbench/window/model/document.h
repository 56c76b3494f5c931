#pragma once

#include <deque>
#include <filesystem>
#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "geometry/kernel/deviation_map.h"
#include "workbench/session/session_runner.h"
#include "workbench/window/model/message.h"
#include "workbench/window/model/opening.h"
#include "workbench/window/model/stroke_queue.h"

namespace vesselbench {

struct DocumentOptions {
    SessionOptions session;           ///< of every case that is opened
    std::function<void()> wake;       ///< called by any thread when poll() has something to do
    std::filesystem::path documents;  ///< where projects go that cannot be beside their input
};

/// What runs, for the status line.
struct Activity {
    std::string what;
    double fraction = 0.0;  ///< [0, 1]
};

/// Figures of the shown scene, found in the background.
struct ShownFigures {
    std::optional<double> volume;             ///< [mm^3]
    std::optional<double> largest_deviation;  ///< [mm] from the source; none: it is the source
};

/// The case in the window: requests return at once, poll() collects their results once a frame.
/// Used by the frame's thread only.
class Document {
public:
    explicit Document(DocumentOptions options);
    ~Document();

    /// Collects what has ended since the last call. \return true if something shown has changed
    bool poll();

    // --- the case

    void open(OpenRequest request);
    void close();

    [[nodiscard]] bool is_open() const { return runner_ != nullptr; }

    [[nodiscard]] bool is_opening() const { return opening_ != nullptr; }

    [[nodiscard]] const std::filesystem::path& project() const { return project_; }

    /// Never null while a case is open.
    [[nodiscard]] const std::shared_ptr<const Snapshot>& snapshot() const { return snapshot_; }

    /// Counts changes of snapshot().
    [[nodiscard]] int snapshot_changes() const { return snapshot_changes_; }

    /// For requests that nothing here depends on; null while no case is open.
    [[nodiscard]] SessionRunner* runner() const { return runner_.get(); }

    [[nodiscard]] const std::string& variant() const { return variant_; }

    void show_variant(const std::string& variant);

    // --- what is shown

    /// The preview's scene if there is one, else that of a stroke, else the case's; null while none
    /// is known.
    [[nodiscard]] const Scene* shown() const;

    /// The scene that a preview replaces.
    [[nodiscard]] const Scene* current() const { return scene_ ? &*scene_ : nullptr; }

    /// Counts changes of shown(), without those by dabs of a stroke.
    [[nodiscard]] int scene_changes() const { return scene_changes_; }

    /// What dabs changed in shown() since the last call.
    [[nodiscard]] std::vector<SceneMove> take_moves() { return strokes_.take_moves(); }

    [[nodiscard]] const std::optional<Preview>& previewed() const { return preview_; }

    [[nodiscard]] const ShownFigures& figures() const { return figures_; }

    /// Whether the distance of the shown surface from the source is wanted; of a preview, from the
    /// surface before it.
    void want_deviation(bool wanted);

    /// Null while it is not wanted, not known yet, or there is nothing to compare with.
    [[nodiscard]] const std::shared_ptr<const DeviationMap>& deviation() const {
        return deviation_;
    }

    /// Whether the source's surface is wanted.
    void want_source(bool wanted);

    /// The surface as the source's step left it; none while it is not wanted, not known yet, or is
    /// the shown one.
    [[nodiscard]] const std::optional<Surface>& source() const { return source_; }

    // --- requests

    void apply(const std::string& operation, Arguments given, Step step);
    void preview(const std::string& operation, Arguments given, Step step);
    void change(EditId edit, Arguments given);
    void preview_change(EditId edit, Arguments given);
    void commit_preview();
    void drop_preview();
    void remove(EditId edit);
    void undo();
    void redo();
    void jump(StateId state);
    void run_pending();

    /// Runs the recipe of a purpose on the case: its own, else the default one.
    void prepare(const std::string& purpose);

    /// The operations that prepare() would run.
    [[nodiscard]] Recipe recipe(const std::string& purpose) const;

    /// Replaces the note on a revision of an edit, also of another state; empty: none.
    void set_note(EditRef edit, const std::string& note);

    void export_to(const std::filesystem::path& file);
    void save_copy(const std::filesystem::path& project);

    // --- strokes of a brush

    /// True if a stroke may begin: of other requests, only strokes are being entered.
    [[nodiscard]] bool can_paint() const;

    /// Begins a stroke in the step of the last edit, if the brush is allowed there. Other requests
    /// are ignored until it ends.
    void begin_stroke(StrokeRequest request);

    void add_dab(const StrokePlace& place) { strokes_.add(place); }

    /// The stroke becomes an edit, or is dropped.
    void end_stroke() { strokes_.end(); }

    void drop_stroke();

    [[nodiscard]] bool is_painting() const { return strokes_.painting(); }

    // --- progress and messages

    /// The foreground request that runs or waits; none: idle.
    [[nodiscard]] std::optional<Activity> activity() const;

    /// True if anything runs, also in the background.
    [[nodiscard]] bool busy() const {
        return opening_ != nullptr || !jobs_.empty() || !strokes_.empty() || is_closing();
    }

    /// True while a closed case still ends, and holds its project.
    [[nodiscard]] bool is_closing() const;

    void cancel();

    [[nodiscard]] const std::deque<Message>& messages() const { return messages_; }

    void tell(Message message);

    /// Why the last request failed; none once another one is made.
    [[nodiscard]] const std::optional<Message>& failure() const { return failure_; }

    void forget_failure() { failure_.reset(); }

    /// Counts edits that were entered by apply, change and commit_preview.
    [[nodiscard]] int entered() const { return entered_; }

private:
    struct Watched;

    template <class Owner>
    void retire(std::unique_ptr<Owner> owner);

    struct Preparation {
        Recipe recipe;
        std::string purpose;
        std::size_t next = 0;  ///< the entry that runs
    };

    template <class Result, class Then>
    void watch(Job<Result> job, std::string what, std::string operation, bool background,
               Then then);
    [[nodiscard]] bool begin_request();
    void enter(const LogEntry& entry);
    void tell_entered(const LogEntry& entry);
    void end(const EndedStroke& stroke);
    void show_without_stroke();
    [[nodiscard]] Step stroke_step(const std::string& operation) const;
    void show_preview(const Preview& preview);
    void take_opened();
    void take_snapshot();
    void request_scene();
    void request_figures();
    void request_deviation();
    void request_source();
    void scene_changed();
    void cancel_background();
    void prepare_next();
    void stop_with(const std::string& text);
    void fail(const std::string& text, const std::string& operation);
    void set_scene(std::optional<Scene> scene);

    DocumentOptions options_;
    std::shared_future<void> retired_;  ///< ends when every closed case has ended
    std::unique_ptr<Opening> opening_;
    std::unique_ptr<SessionRunner> runner_;
    std::vector<std::unique_ptr<Watched>> jobs_;
    StrokeQueue strokes_;
    std::filesystem::path project_;
    std::optional<Input> input_;
    std::string variant_ = kDefaultVariant;
    std::shared_ptr<const Snapshot> snapshot_;
    std::optional<Scene> scene_;
    std::optional<Preview> preview_;
    std::optional<Preparation> preparation_;
    ShownFigures figures_;
    bool wants_deviation_ = false;
    std::shared_ptr<const DeviationMap> deviation_;
    bool wants_source_ = false;
    std::optional<Surface> source_;
    std::deque<Message> messages_;
    std::optional<Message> failure_;
    int snapshot_changes_ = 0, scene_changes_ = 0, entered_ = 0;
};

}  // namespace vesselbench
