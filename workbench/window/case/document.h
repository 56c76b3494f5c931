#pragma once

#include <deque>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "geometry/kernel/deviation_map.h"
#include "workbench/export/products.h"
#include "workbench/session/session_runner.h"
#include "workbench/window/case/made_model.h"
#include "workbench/window/case/message.h"
#include "workbench/window/case/opening.h"
#include "workbench/window/case/preparation.h"
#include "workbench/window/case/request.h"
#include "workbench/window/case/shown_scene.h"
#include "workbench/window/case/stroke_queue.h"

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

/// The case in the window: requests return at once, poll() collects their results once a frame. A
/// request that cannot be made now is refused with a message. Used by the frame's thread only.
class Document {
public:
    explicit Document(DocumentOptions options);
    ~Document();

    /// Collects what has ended since the last call. \return true if something shown has changed
    bool poll();

    // --- the case

    void open(OpenRequest request);
    void close();

    /// The file that was asked for, if this is a project that was made from it before; none: it was
    /// begun anew, or kept.
    [[nodiscard]] const std::optional<OpenRequest>& made_before() const { return made_before_; }

    /// Makes a new project from that file.
    void begin_anew();

    /// Asks no longer whether to begin anew.
    void keep_made_before() { made_before_.reset(); }

    [[nodiscard]] bool is_open() const { return runner_ != nullptr; }

    [[nodiscard]] bool is_opening() const { return opening_.pending(); }

    /// Counts the cases that have been opened.
    [[nodiscard]] int opened() const { return opened_; }

    [[nodiscard]] const std::filesystem::path& project() const { return project_; }

    /// Never null while a case is open.
    [[nodiscard]] const std::shared_ptr<const Snapshot>& snapshot() const { return snapshot_; }

    /// Counts changes of the history, the edits and the variant that lists show.
    [[nodiscard]] int snapshot_changes() const { return snapshot_changes_; }

    /// For requests that nothing here depends on; null while no case is open.
    [[nodiscard]] SessionRunner* runner() const { return runner_.get(); }

    [[nodiscard]] const std::string& variant() const { return variant_; }

    /// Ignored while the model is prepared.
    void show_variant(const std::string& variant);

    // --- what is shown

    /// The preview's scene if there is one, else that of a stroke, else current(); null while none
    /// is known.
    [[nodiscard]] const Scene* shown() const;

    /// The model that forms, handles, marks and searches are about, and that a preview replaces:
    /// what the edit of stand_before() runs on, else the newest one. The last one stays until
    /// another is read.
    [[nodiscard]] const Scene* current() const { return shown_.current(); }

    /// Makes what an edit runs on the current model, as long as the case has the edit; none: the
    /// newest model.
    void stand_before(const std::optional<EditSite>& site) { shown_.stand_before(site); }

    /// The edit that current() stands before, with those that follow; null: it is the newest model.
    [[nodiscard]] const EditInput* stands_before() const;

    /// Why what the edit of stand_before() runs on cannot be current(); empty: it can.
    [[nodiscard]] std::string why_not_input() const;

    /// True while current() is still another model than the one that is meant.
    [[nodiscard]] bool is_reading() const { return shown_.outdated(); }

    /// The model of the current state, whatever is shown; null while it is not known.
    [[nodiscard]] const Scene* newest() const { return shown_.newest(); }

    /// Counts changes of shown(), without those by dabs of a stroke.
    [[nodiscard]] int scene_changes() const { return shown_.changes() + dropped_strokes_; }

    /// What dabs changed in shown() since the last call.
    [[nodiscard]] std::vector<SceneMove> take_moves() { return strokes_.take_moves(); }

    [[nodiscard]] const std::optional<Preview>& previewed() const { return shown_.previewed(); }

    [[nodiscard]] const ShownFigures& figures() const { return shown_.figures(); }

    /// Whether the distance of the shown surface from the source is wanted; of a preview, from the
    /// surface before it.
    void want_deviation(bool wanted) { shown_.want_deviation(wanted); }

    /// As ShownScene::deviation().
    [[nodiscard]] const std::shared_ptr<const DeviationMap>& deviation() const {
        return shown_.deviation();
    }

    /// Whether the source's surface is wanted.
    void want_source(bool wanted) { shown_.want_source(wanted); }

    /// As ShownScene::source().
    [[nodiscard]] const std::optional<Surface>& source() const { return shown_.source(); }

    // --- requests

    /// Why a request of this kind would be refused now; empty: it would not.
    [[nodiscard]] std::string why_not(RequestKind kind) const;

    [[nodiscard]] bool can(RequestKind kind) const { return why_not(kind).empty(); }

    void apply(const std::string& operation, Arguments given, Step step, std::string note = {});
    void preview(const std::string& operation, Arguments given, Step step);
    void change(EditId edit, Arguments given);
    void preview_change(EditId edit, Arguments given);
    void commit_preview();

    /// Also cancels one that is being made.
    void drop_preview();

    void remove(EditId edit);
    void undo();
    void redo();
    void jump(StateId state);
    void run_pending();

    /// Also runs what the edit that was just asked for makes pending, as soon as it is entered.
    void run_following();

    /// What the last recipe, or the last run of pending edits, has made; none in this case yet.
    [[nodiscard]] const std::optional<MadeModel>& made() const { return made_; }

    /// Lets go of the model before it, which nothing else may hold.
    void forget_made_before() {
        if (made_) made_->before.reset();
    }

    /// Counts changes of made().
    [[nodiscard]] int made_models() const { return made_models_; }

    /// Makes what is missing of a purpose's recipe: the case's own, else the default one. Where
    /// nothing is, pending edits run.
    /// \param again_from the purpose's own edits from this step on are left out, and made again:
    /// one of repeatable_steps()
    /// \param changed the entries of to_prepare().rest with other arguments; none: as they are
    void prepare(const std::string& purpose, std::optional<Step> again_from = {},
                 const std::optional<Recipe>& changed = {});

    /// What prepare() would make, and why it would not.
    [[nodiscard]] ResumedRecipe to_prepare(const std::string& purpose,
                                           std::optional<Step> again_from = {}) const;

    /// The operations that prepare() would run.
    [[nodiscard]] Recipe recipe(const std::string& purpose) const {
        return to_prepare(purpose).rest;
    }

    /// Replaces the note on a revision of an edit, also of another state; empty: none.
    void set_note(EditRef edit, const std::string& note);

    /// \param flow of a solver's case, which the project keeps; none: the one that it kept
    void export_to(const std::filesystem::path& file, const std::optional<FlowSettings>& flow = {});
    void save_copy(const std::filesystem::path& project);

    /// Writes a text of the window's, which must not replace a source of the project.
    void write_table(const std::filesystem::path& file, const std::string& table);

    /// The same of a text that is made on the case's thread.
    void write_text(const std::filesystem::path& file, const RequestLabel& label,
                    std::function<std::string(Session&, const Progress&)> make);

    /// A feature's request, run on the case's thread.
    /// \param work returns what is said of its success
    /// \param then called by poll() after a success
    void run(const RequestLabel& label, std::function<Message(Session&, const Progress&)> work,
             std::function<void()> then);

    // --- strokes of a brush

    /// True if a stroke may begin: of other requests, only strokes are being entered.
    [[nodiscard]] bool can_paint() const;

    /// Begins a stroke, whose edit will belong to a step. Other requests are ignored until it ends.
    void begin_stroke(StrokeRequest request, Step step);

    void add_dab(const StrokePlace& place) { strokes_.add(place); }

    /// The stroke becomes an edit, or is dropped.
    void end_stroke() { strokes_.end(); }

    void drop_stroke();

    [[nodiscard]] bool is_painting() const { return strokes_.painting(); }

    // --- progress and messages

    /// The foreground request that runs or waits; none: idle.
    [[nodiscard]] std::optional<Activity> activity() const;

    /// True while an edit or a stroke is being made, or the model is prepared: closing the case
    /// would cancel it.
    [[nodiscard]] bool is_editing() const;

    /// True if anything runs, also in the background.
    [[nodiscard]] bool busy() const {
        return is_opening() || !requests_.empty() || !strokes_.empty() || is_closing() ||
               polls_to_release_ > 0 || shown_.pending();
    }

    /// True while a closed case still ends, and holds its project.
    [[nodiscard]] bool is_closing() const { return !closer_.idle(); }

    void cancel();

    /// Those that hold now: what warns of an edit goes with that edit's result, with the variant
    /// and with the preview that it is about, and comes back with them.
    [[nodiscard]] const std::deque<Message>& messages() const { return shown_messages_; }

    /// Counts changes of messages().
    [[nodiscard]] int message_changes() const { return message_changes_; }

    void tell(Message message);

    /// Why the last request failed; none once another one is made.
    [[nodiscard]] const std::optional<Message>& failure() const { return failure_; }

    void forget_failure() { failure_.reset(); }

    /// Counts edits that were entered by apply, change and commit_preview.
    [[nodiscard]] int entered() const { return entered_; }

private:
    void retire(std::shared_ptr<void> owner);
    void release_memory();
    template <class Result, class Then>
    void watch(Task<Result> task, const RequestLabel& label, Then then);
    [[nodiscard]] bool begin_request(RequestKind kind);
    void end(const RequestEnd& end);
    void end(const EndedStroke& stroke);
    void enter(const LogEntry& entry);
    void begin_making();
    void end_making(const std::string& what);
    void tell_entered(const LogEntry& entry);
    void tell_warnings(const EditRecord& edit, const ResultRecord& result, bool of_preview = false);
    [[nodiscard]] bool holds(const Message& message) const;
    void renew_messages();
    void tell_once(Message message);
    void tell_run(const Snapshot& before);
    void tell_move(const std::string& verb, const std::string& edits);
    void show(const Preview& preview);
    void cancel_preview();
    void take_opened();
    void show(Opened opened);
    void show_again(const Opened& opened);
    void take_snapshot();
    void leave_out(const std::vector<EditId>& edits);
    void prepare_next();
    void end_entry(RecipeMessages& messages);
    void end_preparation();
    void end_at_once(const std::string& purpose, const std::string& text);
    void forget_messages();
    void fail(const std::string& text);
    void fail(Diagnostic error, const std::string& operation);

    DocumentOptions options_;
    TaskThread closer_;
    std::shared_ptr<TaskRun> closing_;  ///< ends when every closed case has ended; null: none was
    int polls_to_release_ = 0;          ///< until a closed case's memory can be given back
    Task<Opened> opening_;
    std::unique_ptr<SessionRunner> runner_;
    std::vector<Request> requests_;
    StrokeQueue strokes_;
    ShownScene shown_;
    std::filesystem::path project_;
    std::optional<Input> input_;
    std::optional<OpenRequest> made_before_;
    std::vector<std::string> prepared_;  ///< purposes whose model was made
    std::string variant_ = kDefaultVariant;
    std::shared_ptr<const Snapshot> snapshot_;
    std::optional<Preparation> preparation_;
    bool runs_following_ = false;      ///< what the edit that runs makes pending
    std::optional<MadeModel> making_;  ///< while it runs
    std::optional<MadeModel> made_;
    std::deque<Message> messages_, shown_messages_;
    std::size_t other_messages_ = 0;  ///< those before a case was asked for
    std::optional<Message> failure_;
    int snapshot_changes_ = 0, dropped_strokes_ = 0, entered_ = 0, opened_ = 0,
        message_changes_ = 0, made_models_ = 0;
};

}  // namespace vesselbench
