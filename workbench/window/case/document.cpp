#include "workbench/window/case/document.h"

#include <algorithm>
#include <cctype>
#include <chrono>
#include <exception>
#include <iterator>
#include <utility>

#ifdef __GLIBC__
#include <malloc.h>
#endif

#include "geometry/kernel/derived_cache.h"
#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/diagnostic_text.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/pending_files.h"
#include "geometry/kernel/wording.h"
#include "workbench/case/diagnostic_words.h"
#include "workbench/case/purposes.h"
#include "workbench/export/export_formats.h"
#include "workbench/export/products.h"
#include "workbench/prepare/acceptance_gate.h"
#include "workbench/prepare/marked_sac.h"
#include "workbench/prepare/prepared_purposes.h"
#include "workbench/prepare/vessel_question.h"
#include "workbench/review/provenance.h"
#include "workbench/review/review.h"
#include "workbench/session/export_record.h"
#include "workbench/session/source_counterpart.h"
#include "workbench/session/stored_texts.h"
#include "workbench/window/case/rail.h"
#include "workbench/window/case/readable.h"
#include "workbench/window/case/snapshot_edits.h"

namespace vesselbench {

namespace {

constexpr std::size_t kMostMessages = 500;

/// How often an opening that waits asks whether it was cancelled.
constexpr std::chrono::milliseconds kCancelAsked(20);

// Polls after a case was closed until the frames between them have let go of what they showed: of
// the frame that closed it, then of the first one without it.
constexpr int kPollsToRelease = 3;

/// The free memory of all arenas: without this, glibc keeps it below what is still used.
void give_back_memory() {
#ifdef __GLIBC__
    malloc_trim(0);
#endif
}

/// A case on its way out: strokes that were painted to their end are entered first.
class ClosedCase {
public:
    ClosedCase(std::unique_ptr<SessionRunner> runner, StrokeQueue strokes)
        : runner_(std::move(runner)), strokes_(std::move(strokes)) {}

    ~ClosedCase() { strokes_.finish(); }

    ClosedCase(const ClosedCase&) = delete;
    ClosedCase& operator=(const ClosedCase&) = delete;

private:
    std::unique_ptr<SessionRunner> runner_;
    StrokeQueue strokes_;  ///< last: they use the runner
};

/// \throw IoError for a file that an edit has read
void require_no_source(const Session& session, const std::filesystem::path& file) {
    if (session.is_source(file))
        throw IoError("'" + file.filename().string() +
                      "' is a source of this project: it is not replaced");
}

RequestLabel history_label(const std::string& what) {
    return {.what = what, .kind = RequestKind::History};
}

/// Empty: the state has no such edit.
std::string operation_of(const Snapshot& snapshot, EditId edit) {
    const LogEntry* entry = find_entry(snapshot, edit);
    return entry == nullptr ? "" : entry->edit.operation;
}

RequestLabel edit_label(const std::string& operation) {
    return {.what = readable(operation), .kind = RequestKind::Edit, .operation = operation};
}

RequestLabel preview_label(const std::string& what, const std::string& operation) {
    return {.what = "Preview of " + what, .kind = RequestKind::Preview, .operation = operation};
}

RequestLabel output_label(const std::string& what) {
    return {.what = what, .kind = RequestKind::Output};
}

/// What is known of why a request failed; empty: it was cancelled.
std::vector<Diagnostic> errors_of(const std::exception_ptr& error) {
    std::string text = error_text(error);
    if (text.empty()) return {};
    try {
        std::rethrow_exception(error);
    } catch (const Diagnosed& known) {
        return known.diagnostics();
    } catch (...) {
        return {plain_text(std::move(text))};
    }
}

}  // namespace

Document::Document(DocumentOptions options)
    : options_(std::move(options)),
      opening_(options_.wake),
      shown_([this](const std::string& text) { tell(make_message(MessageKind::Warning, text)); }) {}

Document::~Document() {
    close();
}

template <class Result, class Then>
void Document::watch(Task<Result> task, const RequestLabel& label, Then then) {
    auto run = task.run();
    const auto finish = [this, task = std::move(task), label, then = std::move(then)] {
        try {
            then(task.result());
        } catch (...) {
            end(RequestEnd{label, errors_of(std::current_exception())});
        }
    };
    requests_.push_back({label, std::move(run), finish});
}

bool Document::poll() {
    bool changed = false;
    if (is_opening() && opening_.ended()) {
        take_opened();
        changed = true;
    }
    release_memory();
    if (!runner_) return changed;
    const std::vector<Request> ended = take_ended(requests_);
    const std::vector<EndedStroke> strokes = strokes_.poll();
    if (runner_->snapshot() != snapshot_) {
        take_snapshot();
        changed = true;
    }
    for (const Request& request : ended) request.finish();
    for (const EndedStroke& stroke : strokes) end(stroke);
    changed |= shown_.poll();
    if (requests_.empty() && strokes_.empty()) shown_.request(*runner_);
    return changed || !ended.empty() || !strokes.empty() || strokes_.has_moves();
}

// --- the case

/// Lets a case end on a thread of its own: it may have to wait for an operation.
void Document::retire(std::shared_ptr<void> owner) {
    closing_ = std::make_shared<TaskRun>(
        [owner = std::move(owner)](const Progress&) mutable { owner.reset(); });
    closer_.add(closing_);
}

/// Gives a closed case's memory back to the system, on a thread of its own: that takes a while.
void Document::release_memory() {
    if (polls_to_release_ == 0 || is_closing()) return;
    if (--polls_to_release_ > 0) return;
    const bool open = is_open() || is_opening();
    closing_ = std::make_shared<TaskRun>([open](const Progress&) {
        if (!open) derived_cache().clear();
        give_back_memory();
    });
    closer_.add(closing_);
}

void Document::open(OpenRequest request) {
    request.documents = options_.documents;
    request.open_project = project_;
    failure_.reset();
    std::error_code ignored;
    const bool can_change = runner_ && snapshot_->read_only_reason.empty();
    if (can_change && std::filesystem::equivalent(request.path, project_, ignored))
        return tell(make_message(MessageKind::Remark, request.name() + " is open already"));
    opening_.forget();
    other_messages_ = messages_.size();
    // A case that is being closed, or opened, may hold the same project: it ends first.
    opening_.start([request = std::move(request), options = options_.session,
                    closing = closing_](const Progress& progress) {
        while (closing && !closing->wait_for(kCancelAsked)) progress.check_cancelled();
        Opened opened = open_case(request, options, progress);
        static_cast<void>(opened.session.snapshot());  // reads the records here, not in a frame
        return opened;
    });
}

void Document::begin_anew() {
    if (!made_before_) return;
    OpenRequest request = *std::exchange(made_before_, std::nullopt);
    request.anew = true;
    open(std::move(request));
}

void Document::close() {
    for (const Request& request : requests_) request.run->cancel();
    requests_.clear();
    preparation_.reset();
    if (runner_) {
        retire(std::make_shared<ClosedCase>(std::move(runner_), std::exchange(strokes_, {})));
        polls_to_release_ = kPollsToRelease;
    }
    snapshot_.reset();
    input_.reset();
    made_before_.reset();
    prepared_.clear();
    making_.reset();
    made_.reset();
    failure_.reset();
    project_.clear();
    shown_.clear();
    ++snapshot_changes_;
}

void Document::take_opened() {
    static_cast<void>(opening_.poll());
    std::optional<Opened> opened = opening_.take();
    if (!opened && opening_.problem().empty())
        return tell(make_message(MessageKind::Remark, "Cancelled"));
    if (!opened) return fail(opening_.problem());
    if (opened->is_open) return show_again(*opened);
    try {
        show(std::move(*opened));
    } catch (const std::exception& error) {
        fail(diagnostics_of(error).front(), {});
    }
}

/// The project that is open: what was asked for is a file that it was made from.
void Document::show_again(const Opened& opened) {
    made_before_ = opened.made_before;
    tell(make_message(MessageKind::Remark, made_before_->name() + " is open already, as " +
                                               project_.filename().string()));
}

void Document::show(Opened opened) {
    close();
    ++opened_;
    forget_messages();
    project_ = opened.project;
    input_ = std::move(opened.input);
    prepared_ = opened.prepared.done;
    runner_ = std::make_unique<SessionRunner>(std::move(opened.session), options_.wake);
    variant_ = newest_variant(*runner_->snapshot(), opened.prepared.last);
    take_snapshot();
    for (const LogEntry& entry : snapshot_->log)
        if (entry.result) tell_warnings(entry.edit, *entry.result);
    const std::string what = opened.is_new ? "New project " : "Opened ";
    made_before_ = std::move(opened.made_before);
    const std::string from =
        made_before_ ? ", which was made from " + made_before_->name() : std::string();
    tell(make_message(MessageKind::Success, what + project_.string() + from));
    for (const Message& remark : opened.remarks) tell_once(remark);
}

void Document::take_snapshot() {
    const auto before = snapshot_;
    snapshot_ = runner_->snapshot();
    const bool same = before && same_edits(*before, *snapshot_);
    if (!same) ++snapshot_changes_;
    if (!same) renew_messages();
    if (!before || before->history != snapshot_->history) shown_.follow(snapshot_, variant_);
}

void Document::show_variant(const std::string& variant) {
    if (variant_ == variant || preparation_) return;
    variant_ = variant;
    drop_preview();
    if (!runner_) return;
    ++snapshot_changes_;
    renew_messages();
    shown_.follow(snapshot_, variant_);
}

const EditInput* Document::stands_before() const {
    const std::optional<EditInput>& input = shown_.input();
    return input && is_earlier(*input) ? &*input : nullptr;
}

std::string Document::why_not_input() const {
    const std::optional<EditInput>& input = shown_.input();
    return input && input->has_pending ? "edits before it are pending: run them first" : "";
}

const Scene* Document::shown() const {
    if (shown_.previewed() || strokes_.scene() == nullptr) return shown_.scene();
    return strokes_.scene();
}

// --- requests

std::string Document::why_not(RequestKind kind) const {
    if (!runner_) return "no case is open";
    if (is_opening()) return "another case is being opened";
    if (strokes_.painting()) return "a stroke is being drawn";
    if (preparation_) return "the model is being prepared";
    for (const Request& request : requests_)
        if (request.label.kind == RequestKind::Edit || request.label.kind == RequestKind::Output)
            return request.label.what + " is running";
    const bool writes = kind == RequestKind::Edit || kind == RequestKind::History;
    return writes ? snapshot_->read_only_reason : "";
}

bool Document::begin_request(RequestKind kind) {
    const std::string reason = why_not(kind);
    if (!reason.empty()) {
        tell(make_message(MessageKind::Remark, "Not now: " + reason));
        return false;
    }
    failure_.reset();
    runs_following_ = false;
    cancel_preview();
    shown_.pause();
    return true;
}

void Document::end(const RequestEnd& end) {
    if (end.label.kind == RequestKind::Edit) {
        preparation_.reset();
        making_.reset();
    }
    if (end.errors.empty())
        tell(make_message(MessageKind::Remark, "Cancelled"));
    else
        fail(end.errors.front(), end.label.operation);
}

void Document::enter(const LogEntry& entry) {
    ++entered_;
    drop_preview();
    tell_entered(entry);
    const bool runs = std::exchange(runs_following_, false);
    if (runs && pending_count(*snapshot_, variant_) > 0) return run_pending();
    making_.reset();
}

void Document::begin_making() {
    const Scene* before = newest() != nullptr ? newest() : current();
    making_ = MadeModel{.variant = variant_,
                        .from = snapshot_->history->current(),
                        .before = before != nullptr ? std::optional(*before) : std::nullopt,
                        .warnings_before = warning_count(*snapshot_, variant_)};
}

void Document::end_making(const std::string& what) {
    made_ = std::exchange(making_, std::nullopt);
    if (!made_) return;
    if (made_->what.empty()) made_->what = what;
    made_->state = snapshot_->history->current();
    ++made_models_;
}

void Document::tell_entered(const LogEntry& entry) {
    if (!entry.result) return;
    Message message = make_message(MessageKind::Success, changed_text(entry.edit, *entry.result));
    message.variant = entry.edit.place.variant;
    tell(std::move(message));
    tell_warnings(entry.edit, *entry.result);
}

void Document::tell_warnings(const EditRecord& edit, const ResultRecord& result, bool of_preview) {
    for (Diagnostic warning : result.warnings) {
        warning.operation = edit.operation;
        if (edit.edit.id != 0) warning.edit = edit.edit.id;
        Message message = make_message(warning);
        message.of_preview = of_preview;
        if (!of_preview) message.result = result.id;
        tell(std::move(message));
    }
}

/// Unless it was told with the edits.
void Document::tell_once(Message message) {
    if (std::ranges::count(messages_, message.text, &Message::text) == 0) tell(std::move(message));
}

/// After pending edits were run.
void Document::tell_run(const Snapshot& before) {
    const std::vector<LogEntry> run = run_since(before, *snapshot_);
    for (const LogEntry& entry : run)
        if (entry.status == EditStatus::Stale)
            tell(stale_message(entry));
        else
            tell_entered(entry);
    const std::string what = "Ran " + counted(run.size(), "pending edit");
    tell(make_message(MessageKind::Success, what));
    end_making(what);
}

void Document::apply(const std::string& operation, Arguments given, Step step, std::string note) {
    if (!begin_request(RequestKind::Edit)) return;
    watch(runner_->apply(operation, std::move(given),
                         {.step = step, .variant = variant_, .note = std::move(note)}),
          edit_label(operation), [this](const LogEntry& entry) { enter(entry); });
}

void Document::change(EditId edit, Arguments given) {
    if (!begin_request(RequestKind::Edit)) return;
    watch(runner_->change_edit(edit, std::move(given)),
          {.what = "Changing edit " + std::to_string(edit),
           .operation = operation_of(*snapshot_, edit)},
          [this](const LogEntry& entry) { enter(entry); });
}

void Document::remove(EditId edit) {
    if (!begin_request(RequestKind::Edit)) return;
    watch(runner_->remove_edit(edit), {.what = "Removing edit " + std::to_string(edit)},
          [](const Nothing&) {});
}

void Document::undo() {
    if (!begin_request(RequestKind::History)) return;
    drop_preview();
    watch(runner_->undo(), history_label("Undo"), [this, before = snapshot_](const Nothing&) {
        tell_move("Undid ", edits_between(*before, *snapshot_));
    });
}

void Document::redo() {
    if (!begin_request(RequestKind::History)) return;
    drop_preview();
    watch(runner_->redo(), history_label("Redo"), [this, before = snapshot_](const Nothing&) {
        tell_move("Redid ", edits_between(*before, *snapshot_));
    });
}

void Document::jump(StateId state) {
    if (!begin_request(RequestKind::History)) return;
    drop_preview();
    watch(runner_->jump(state), history_label("Switching state"),
          [this](const Nothing&) { tell_move("Switched to another state", ""); });
}

void Document::tell_move(const std::string& verb, const std::string& edits) {
    tell(make_message(MessageKind::Remark, verb + edits));
}

void Document::run_following() {
    if (requests_.empty()) return;
    begin_making();
    runs_following_ = true;
}

void Document::run_pending() {
    if (!begin_request(RequestKind::Edit)) return;
    if (!making_) begin_making();
    watch(runner_->scene(variant_), {.what = "Running pending edits"},
          [this, before = snapshot_](const Scene& scene) {
              if (pending_count(*snapshot_, variant_) == 0) shown_.offer_newest(scene);
              tell_run(*before);
          });
}

void Document::set_note(EditRef edit, const std::string& note) {
    if (!begin_request(RequestKind::History)) return;
    auto task = runner_->submit([edit, note](Session& session, const Progress&) {
        session.set_note(edit, note);
        return Nothing{};
    });
    watch(std::move(task), history_label("Writing a note"), [](const Nothing&) {});
}

void Document::export_to(const std::filesystem::path& file,
                         const std::optional<FlowSettings>& given) {
    if (!begin_request(RequestKind::Output)) return;
    try {
        check_export_name(file);
    } catch (const UsageError& error) {
        return fail(error.what());
    }
    const ExportFormat* format = row_that_writes(export_formats(), file.string());
    const std::string unit = format == nullptr ? "" : ", in " + format->unit;
    const auto write = [file, given, project = project_, variant = variant_](
                           Session& session, const Progress& progress) {
        require_no_source(session, file);
        const Review review = review_of(session, variant);
        require_acceptance(session, project, variant, 0, review);
        const Scene scene = session.scene(variant, progress.part(0.0, 0.7));
        PendingFiles files;
        const FlowSettings kept(stored_text(project, StoredText::Flow));
        const FlowSettings& flow = given ? *given : kept;
        export_scene(files, file, scene,
                     {.flow = flow_in_vessel(flow.parameters(), session.log(variant)),
                      .provenance = provenance(session, variant, review),
                      .shown = {.title = shown_name(session), .purpose = model_title(variant)},
                      .ends = made_ends(session, variant, progress.silent()),
                      .neck = recorded_neck(session.log(variant))},
                     progress.part(0.7, 1.0));
        progress.check_cancelled();
        files.commit();
        if (given && given->stored() != kept.stored() && session.read_only_reason().empty())
            store_text(project, StoredText::Flow, given->stored());
        return record_export(session, file, variant);
    };
    const std::string done = "Exported " + file.string() + unit;
    watch(runner_->submit(write), output_label("Export"), [this, done](bool recorded) {
        tell(recorded ? make_message(MessageKind::Success, done)
                      : make_message(MessageKind::Warning,
                                     done + "; not recorded: " + snapshot_->read_only_reason));
    });
}

void Document::save_copy(const std::filesystem::path& project) {
    if (!begin_request(RequestKind::Output)) return;
    watch(runner_->save_as(project), output_label("Saving a copy"),
          [this, project](const Nothing&) {
              tell(make_message(MessageKind::Success, "Saved a copy as " + project.string()));
          });
}

void Document::write_table(const std::filesystem::path& file, const std::string& table) {
    write_text(file, output_label("Export"), [table](Session&, const Progress&) { return table; });
}

void Document::write_text(const std::filesystem::path& file, const RequestLabel& label,
                          std::function<std::string(Session&, const Progress&)> make) {
    const auto write = [file, make = std::move(make)](Session& session, const Progress& progress) {
        require_no_source(session, file);
        PendingFiles files;
        files.add_text(file, make(session, progress));
        progress.check_cancelled();
        files.commit();
        return make_message(MessageKind::Success, "Exported " + file.string());
    };
    run(label, write, {});
}

void Document::run(const RequestLabel& label,
                   std::function<Message(Session&, const Progress&)> work,
                   std::function<void()> then) {
    if (!begin_request(label.kind)) return;
    watch(runner_->submit(std::move(work)), label,
          [this, then = std::move(then)](const Message& done) {
              tell(done);
              if (then) then();
          });
}

// --- previews

void Document::preview(const std::string& operation, Arguments given, Step step) {
    if (!begin_request(RequestKind::Preview)) return;
    watch(runner_->preview(operation, std::move(given), {.step = step, .variant = variant_}),
          preview_label(readable(operation), operation),
          [this](const Preview& preview) { show(preview); });
}

void Document::preview_change(EditId edit, Arguments given) {
    if (!begin_request(RequestKind::Preview)) return;
    watch(runner_->preview_change(edit, std::move(given)),
          preview_label("edit " + std::to_string(edit), operation_of(*snapshot_, edit)),
          [this](const Preview& preview) { show(preview); });
}

void Document::show(const Preview& preview) {
    shown_.show_preview(preview);
    tell(make_message(MessageKind::Remark,
                      "Preview of " + changed_text(preview.edit(), preview.result())));
    tell_warnings(preview.edit(), preview.result(), true);
}

void Document::commit_preview() {
    if (!previewed() || !begin_request(RequestKind::Edit)) return;
    watch(runner_->commit(*previewed()), edit_label(previewed()->edit().operation),
          [this](const LogEntry& entry) { enter(entry); });
}

void Document::drop_preview() {
    cancel_preview();
    const bool shown = previewed().has_value();
    shown_.drop_preview();
    if (shown) renew_messages();
}

/// That is being made.
void Document::cancel_preview() {
    const auto previews = [](const Request& request) {
        return request.label.kind == RequestKind::Preview;
    };
    for (const Request& request : requests_)
        if (previews(request)) request.run->cancel();
    std::erase_if(requests_, previews);
}

// --- preparing

ResumedRecipe Document::to_prepare(const std::string& purpose,
                                   std::optional<Step> again_from) const {
    const Scene* scene = newest() != nullptr ? newest() : current();
    ResumedRecipe resumed = missing_entries(*snapshot_, input_, scene, purpose, prepared_);
    if (again_from) resumed.rest = rest_from(*again_from, resumed);
    return resumed;
}

void Document::prepare(const std::string& purpose, std::optional<Step> again_from,
                       const std::optional<Recipe>& changed) {
    if (!begin_request(RequestKind::Edit)) return;
    const ResumedRecipe resumed = to_prepare(purpose, again_from);
    if (!resumed.refusal.empty()) return fail(resumed.refusal);
    show_variant(purpose);
    drop_preview();
    begin_making();
    for (const std::string& remark : resumed.remarks) tell(make_message(plain_text(remark)));
    if (resumed.rest.empty()) return end_at_once(purpose, all_made_text(resumed));
    preparation_ = Preparation{.recipe = changed.value_or(resumed.rest),
                               .purpose = purpose,
                               .project = project_,
                               .warnings = resumed.remarks.size()};
    if (again_from) return leave_out(own_edits_from(*again_from, *snapshot_, purpose));
    prepare_next();
}

/// Nothing is missing of the purpose's model.
void Document::end_at_once(const std::string& purpose, const std::string& text) {
    auto task =
        runner_->submit([project = project_, purpose](Session& /*session*/, const Progress&) {
            end_purpose(project, purpose);
            return Nothing{};
        });
    watch(std::move(task), {.what = "Looking for missing edits"},
          [this, purpose, text](const Nothing&) {
              if (std::ranges::count(prepared_, purpose) == 0) prepared_.push_back(purpose);
              tell(make_message(MessageKind::Success, readable_sentence(text)));
              if (pending_count(*snapshot_, variant_) > 0) return run_pending();
              making_.reset();
          });
}

/// Before they are made again.
void Document::leave_out(const std::vector<EditId>& edits) {
    auto task = runner_->submit([edits](Session& session, const Progress&) {
        for (const EditId edit : edits) session.remove_edit(edit);
        return Nothing{};
    });
    watch(std::move(task), {.what = "Leaving out " + counted(edits.size(), "edit")},
          [this](const Nothing&) { prepare_next(); });
}

void Document::prepare_next() {
    if (preparation_->cancelled) {
        preparation_.reset();
        making_.reset();
        return tell(make_message(MessageKind::Remark, "Cancelled"));
    }
    if (preparation_->done()) return end_preparation();
    shown_.pause();
    const auto messages = std::make_shared<RecipeMessages>();
    watch(preparation_->start(*runner_, messages), edit_label(preparation_->operation()),
          [this, messages](const Nothing&) { end_entry(*messages); });
}

void Document::end_entry(RecipeMessages& messages) {
    const LogEntry* made = newest_edit(*snapshot_, preparation_->operation());
    for (Message& message : messages.take()) {
        const bool warns = message.kind == MessageKind::Warning;
        if (warns) ++preparation_->warnings;
        if (warns && made != nullptr) message.edit = made->edit.edit.id;
        if (warns && made != nullptr && made->result) message.result = made->result->id;
        tell(std::move(message));
    }
    ++preparation_->next;
    prepare_next();
}

/// Edits that were made before it may follow the recipe's.
void Document::end_preparation() {
    const Preparation done = *std::exchange(preparation_, std::nullopt);
    if (std::ranges::count(prepared_, done.purpose) == 0) prepared_.push_back(done.purpose);
    std::string model = find_purpose(done.purpose).title;
    model[0] = static_cast<char>(std::tolower(model[0]));
    const std::string text = "Prepared the " + model;
    if (done.warnings == 0)
        tell(make_message(MessageKind::Success, text));
    else
        tell(make_message(MessageKind::Warning,
                          text + " with " + counted(done.warnings, "warning")));
    if (making_) making_->what = text;
    if (pending_count(*snapshot_, variant_) > 0) return run_pending();
    end_making(text);
}

// --- strokes of a brush

bool Document::can_paint() const {
    const Scene* scene = current();
    return scene != nullptr && scene->surface && !previewed() && !is_opening() &&
           snapshot_->read_only_reason.empty() && requests_.empty() && !is_reading() &&
           why_not_input().empty();
}

void Document::begin_stroke(StrokeRequest request, Step step) {
    if (!can_paint() || is_painting() || !begin_request(RequestKind::Edit)) return;
    strokes_.begin(*runner_, std::move(request), {.step = step, .variant = variant_});
}

void Document::drop_stroke() {
    if (!is_painting()) return;
    strokes_.drop();
    ++dropped_strokes_;
}

void Document::end(const EndedStroke& stroke) {
    if (stroke.entry) {
        if (stroke.scene && stroke.entry->result)
            shown_.offer(stroke.entry->result->id, *stroke.scene);
        return tell_entered(*stroke.entry);
    }
    if (stroke.cancelled) tell(make_message(MessageKind::Remark, "Cancelled"));
    if (stroke.error) fail(*stroke.error, stroke.operation);
    ++dropped_strokes_;
}

// --- progress and messages

std::optional<Activity> Document::activity() const {
    if (is_opening()) {
        const TaskProgress progress = opening_.progress();
        return Activity{progress.what.empty() ? "opening" : progress.what, progress.fraction};
    }
    if (!requests_.empty()) {
        const Request& request = requests_.front();
        const TaskProgress progress = request.run->progress();
        const std::string& name = request.label.what;
        const bool same = progress.what.empty() || progress.what == name;
        const std::string what = same ? name : name + ": " + progress.what;
        if (!preparation_) return Activity{what, progress.fraction};
        const auto done = static_cast<double>(preparation_->next);
        return Activity{"Preparing: " + what, (done + progress.fraction) /
                                                  static_cast<double>(preparation_->recipe.size())};
    }
    if (const LiveStroke* stroke = strokes_.entering())
        return Activity{stroke->operation(), stroke->progress().fraction};
    return std::nullopt;
}

bool Document::is_editing() const {
    return preparation_ || !strokes_.empty() ||
           std::ranges::any_of(requests_, [](const Request& request) {
               return request.label.kind == RequestKind::Edit;
           });
}

void Document::cancel() {
    strokes_.cancel();
    opening_.cancel();
    for (const Request& request : requests_) request.run->cancel();
    // Its running entry may be entered before it can be stopped.
    if (preparation_) preparation_->cancelled = true;
}

void Document::tell(Message message) {
    ++message_changes_;
    if (holds(message)) shown_messages_.push_back(message);
    messages_.push_back(std::move(message));
    if (messages_.size() <= kMostMessages) return;
    messages_.pop_front();
    if (other_messages_ > 0) --other_messages_;
    renew_messages();
}

bool Document::holds(const Message& message) const {
    return !snapshot_ || holds_now(message, *snapshot_, variant_, previewed().has_value());
}

void Document::renew_messages() {
    std::deque<Message> now;
    std::ranges::copy_if(messages_, std::back_inserter(now),
                         [this](const Message& message) { return holds(message); });
    if (now.size() != shown_messages_.size()) ++message_changes_;
    shown_messages_ = std::move(now);
}

/// Those about the case before.
void Document::forget_messages() {
    messages_.erase(messages_.begin(),
                    messages_.begin() + static_cast<std::ptrdiff_t>(other_messages_));
    other_messages_ = 0;
    renew_messages();
}

void Document::fail(const std::string& text) {
    failure_ = make_message(MessageKind::Error, text);
    tell(*failure_);
}

void Document::fail(Diagnostic error, const std::string& operation) {
    if (error.code == kPlainText) return fail(text_of(error));
    if (error.operation.empty()) error.operation = operation;
    failure_ = make_message(error);
    tell(*failure_);
}

}  // namespace vesselbench
