#include "workbench/window/model/document.h"

#include <algorithm>
#include <chrono>
#include <mutex>

#include <nlohmann/json.hpp>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/pending_files.h"
#include "geometry/kernel/wording.h"
#include "workbench/export/export_formats.h"
#include "workbench/export/products.h"
#include "workbench/operations/table.h"
#include "workbench/prepare/prepare.h"
#include "workbench/report/log_json.h"
#include "workbench/session/surface_change.h"
#include "workbench/window/model/rail.h"

namespace vesselbench {

namespace {

constexpr std::size_t kMostMessages = 500;
constexpr const char* kReading = "reading the model";

/// The texts that a recipe tells while it runs, handed from its thread to the frame's.
class ToldTexts {
public:
    void add(const std::string& text) {
        const std::lock_guard lock(mutex_);
        texts_.push_back(text);
    }

    std::vector<std::string> take() {
        const std::lock_guard lock(mutex_);
        return std::exchange(texts_, {});
    }

private:
    std::mutex mutex_;
    std::vector<std::string> texts_;
};

Message told(const std::string& text) {
    constexpr std::string_view kWarning = "warning: ";
    if (text.starts_with(kWarning))
        return make_message(MessageKind::Warning, text.substr(kWarning.size()));
    return make_message(MessageKind::Remark, text);
}

/// The last edit up to which the variant's model is known.
std::optional<EditId> last_known(const Snapshot& snapshot, const std::string& variant) {
    std::optional<EditId> last;
    for (const HistoryEntry& entry : snapshot.history->line(variant)) {
        if (entry.status == EditStatus::Pending) break;
        if (entry.status == EditStatus::Done) last = entry.edit.id;
    }
    return last;
}

/// The last edit of the source's step, if other edits follow it.
std::optional<EditId> source_edit(const Snapshot& snapshot, const std::string& variant) {
    std::optional<EditId> source;
    for (const HistoryEntry& entry : snapshot.history->line(variant)) {
        if (entry.status != EditStatus::Done) continue;
        if (entry.place.step != Step::Source) return source;
        source = entry.edit.id;
    }
    return std::nullopt;
}

bool has_pending(const Snapshot& snapshot, const std::string& variant) {
    return pending_count(snapshot, variant) > 0;
}

const Scene* scene_at_hand(const Snapshot& snapshot, const std::string& variant) {
    if (has_pending(snapshot, variant)) return nullptr;
    const auto variants = snapshot.history->variants();
    const bool own = std::ranges::count(variants, variant) > 0;
    const auto found = snapshot.scenes.find(own ? variant : "");
    return found == snapshot.scenes.end() ? nullptr : &found->second;
}

/// True for a recipe's entry of the source's step that the case has an edit for.
bool is_done(const Snapshot& snapshot, const RecipeEntry& entry) {
    const Step step = entry.step.value_or(entry.given.operation().usual_step);
    return step == Step::Source && std::ranges::any_of(snapshot.log, [&](const LogEntry& made) {
               return made.edit.operation == entry.given.operation().name &&
                      made.edit.place.step == Step::Source;
           });
}

/// The variant of the newest edit that belongs to one.
std::string newest_variant(const Snapshot& snapshot) {
    const LogEntry* newest = nullptr;
    for (const LogEntry& entry : snapshot.log)
        if (!entry.edit.place.variant.empty() &&
            (newest == nullptr || newest->edit.edit.id < entry.edit.edit.id))
            newest = &entry;
    return newest == nullptr ? kDefaultVariant : newest->edit.place.variant;
}

std::string entered_text(const LogEntry& entry) {
    const std::string change = entry.result ? change_text(entry.result->change) : "";
    return entry.edit.operation + (change.empty() ? "" : ": " + change);
}

}  // namespace

/// A job whose end poll() handles.
struct Document::Watched {
    std::string what;
    bool background = false;
    std::function<bool()> ended;
    std::function<JobProgress()> progress;
    std::function<void()> cancel;
    std::function<void()> finish;  ///< reports errors as messages
};

Document::Document(DocumentOptions options) : options_(std::move(options)) {}

Document::~Document() = default;

template <class Result, class Then>
void Document::watch(Job<Result> job, std::string what, std::string operation, bool background,
                     Then then) {
    auto watched = std::make_unique<Watched>();
    watched->what = std::move(what);
    watched->background = background;
    watched->ended = [job] { return job.ended(); };
    watched->progress = [job] { return job.progress(); };
    watched->cancel = [job] { job.cancel(); };
    watched->finish = [this, job, background, operation = std::move(operation), then] {
        try {
            then(job.result());
        } catch (const Cancelled&) {
            if (!background) stop_with("cancelled");
        } catch (const std::exception& error) {
            if (!background) fail(error.what(), operation);
        }
    };
    jobs_.push_back(std::move(watched));
}

bool Document::poll() {
    bool changed = false;
    if (opening_ && opening_->job().ended()) {
        take_opened();
        changed = true;
    }
    if (!runner_) return changed;
    std::vector<std::unique_ptr<Watched>> ended;
    for (auto& job : jobs_)
        if (job->ended()) ended.push_back(std::move(job));
    std::erase(jobs_, nullptr);
    const std::vector<EndedStroke> strokes = strokes_.poll();
    if (runner_->snapshot() != snapshot_) {
        take_snapshot();
        changed = true;
    }
    for (const auto& job : ended) job->finish();
    for (const EndedStroke& stroke : strokes) end(stroke);
    return changed || !ended.empty() || !strokes.empty() || strokes_.has_moves();
}

// --- the case

/// Lets a runner or an opening end on a thread of its own: it may have to wait for an operation.
template <class Owner>
void Document::retire(std::unique_ptr<Owner> owner) {
    if (!owner) return;
    retired_ =
        std::async(std::launch::async, [owner = std::move(owner), before = retired_]() mutable {
            owner.reset();
            if (before.valid()) before.wait();
        }).share();
}

bool Document::is_closing() const {
    return retired_.valid() &&
           retired_.wait_for(std::chrono::seconds(0)) != std::future_status::ready;
}

void Document::open(OpenRequest request) {
    request.documents = options_.documents;
    failure_.reset();
    std::error_code ignored;
    const bool can_change = runner_ && snapshot_->read_only_reason.empty();
    if (can_change && std::filesystem::equivalent(request.path, project_, ignored))
        return tell(make_message(MessageKind::Remark, request.name() + " is open already"));
    if (opening_) opening_->cancel();
    retire(std::move(opening_));
    opening_ =
        std::make_unique<Opening>(std::move(request), options_.session, options_.wake, retired_);
}

void Document::close() {
    jobs_.clear();
    strokes_.clear();
    preparation_.reset();
    retire(std::move(runner_));
    snapshot_.reset();
    preview_.reset();
    input_.reset();
    failure_.reset();
    project_.clear();
    set_scene(std::nullopt);
    ++snapshot_changes_;
}

void Document::take_opened() {
    const std::unique_ptr<Opening> ended = std::move(opening_);
    try {
        Opened opened = ended->take();
        close();
        project_ = opened.project;
        input_ = std::move(opened.input);
        runner_ = std::make_unique<SessionRunner>(std::move(opened.session), options_.wake);
        if (opened.is_new)
            tell(make_message(MessageKind::Success, "new project " + project_.string()));
        else
            tell(make_message(MessageKind::Success, "opened " + project_.string()));
        for (const std::string& remark : opened.remarks) tell(told(remark));
        variant_ = newest_variant(*runner_->snapshot());
        take_snapshot();
    } catch (const Cancelled&) {
        tell(make_message(MessageKind::Remark, "cancelled"));
    } catch (const std::exception& error) {
        fail(error.what(), {});
    }
}

void Document::take_snapshot() {
    const auto before = snapshot_;
    snapshot_ = runner_->snapshot();
    ++snapshot_changes_;
    const bool moved = !before || before->history != snapshot_->history;
    if (moved || !scene_) request_scene();
}

void Document::show_variant(const std::string& variant) {
    if (variant_ == variant) return;
    variant_ = variant;
    drop_preview();
    if (runner_) request_scene();
}

// --- what is shown

const Scene* Document::shown() const {
    if (preview_) return &preview_->scene();
    return strokes_.scene() != nullptr ? strokes_.scene() : current();
}

void Document::set_scene(std::optional<Scene> scene) {
    scene_ = std::move(scene);
    figures_ = {};
    scene_changed();
    if (scene_ && scene_->surface && !is_painting()) request_figures();
}

void Document::scene_changed() {
    ++scene_changes_;
    deviation_.reset();
    if (wants_deviation_ && !is_painting()) request_deviation();
    if (wants_source_ && !is_painting()) request_source();
}

void Document::want_deviation(bool wanted) {
    if (wanted == wants_deviation_) return;
    wants_deviation_ = wanted;
    deviation_.reset();
    if (wanted) request_deviation();
}

void Document::request_deviation() {
    if (!runner_ || shown() == nullptr || !shown()->surface) return;
    const auto source = source_edit(*snapshot_, variant_);
    const std::optional<Scene> before = preview_ ? scene_ : std::nullopt;
    if (!source && !before) return;
    const auto job = runner_->submit(
        [source, before, scene = *shown()](Session& session, const Progress& progress) {
            const Scene from = before ? *before : session.scene_after(*source, progress);
            progress.check_cancelled();
            return std::make_shared<const DeviationMap>(
                deviation_map(surface_of(scene), surface_of(from), progress));
        },
        "deviation");
    watch(job, "measuring", {}, true,
          [this](const std::shared_ptr<const DeviationMap>& map) { deviation_ = map; });
}

void Document::want_source(bool wanted) {
    if (wanted == wants_source_) return;
    wants_source_ = wanted;
    source_.reset();
    if (wanted) request_source();
}

void Document::request_source() {
    if (!runner_) return source_.reset();
    const auto source = source_edit(*snapshot_, variant_);
    if (!source) return source_.reset();
    const auto job = runner_->submit(
        [id = *source](Session& session, const Progress& progress) {
            return session.scene_after(id, progress);
        },
        "source");
    watch(job, "reading the source", {}, true,
          [this](const Scene& scene) { source_ = scene.surface; });
}

void Document::request_scene() {
    cancel_background();
    if (const Scene* known = scene_at_hand(*snapshot_, variant_)) return set_scene(*known);
    const auto last = last_known(*snapshot_, variant_);
    if (!last) return set_scene(Scene{});
    const auto job = runner_->submit(
        [id = *last](Session& session, const Progress& progress) {
            return session.scene_after(id, progress);
        },
        "scene");
    watch(job, kReading, {}, true, [this](const Scene& scene) { set_scene(scene); });
}

void Document::request_figures() {
    const auto source = source_edit(*snapshot_, variant_);
    const auto job = runner_->submit(
        [source, scene = *scene_](Session& session, const Progress& progress) {
            const Scene from = source ? session.scene_after(*source, progress) : scene;
            return surface_change(from, scene, progress);
        },
        "figures");
    watch(job, "measuring", {}, true, [this, source](const SurfaceChange& change) {
        figures_.volume = change.volume_after;
        if (source) figures_.largest_deviation = change.largest_deviation;
    });
}

void Document::cancel_background() {
    for (const auto& job : jobs_)
        if (job->background) job->cancel();
    std::erase_if(jobs_, [](const auto& job) { return job->background; });
}

// --- requests

bool Document::begin_request() {
    failure_.reset();
    if (!runner_ || is_painting()) return false;
    cancel_background();
    return true;
}

void Document::enter(const LogEntry& entry) {
    ++entered_;
    drop_preview();
    tell_entered(entry);
}

void Document::tell_entered(const LogEntry& entry) {
    tell(make_message(MessageKind::Success, entered_text(entry)));
    if (!entry.result) return;
    for (const std::string& warning : entry.result->warnings)
        tell(make_message(MessageKind::Warning, entry.edit.operation + ": " + warning,
                          entry.edit.operation));
}

void Document::show_preview(const Preview& preview) {
    preview_ = preview;
    scene_changed();
    tell(make_message(MessageKind::Remark, "preview of " + preview.edit().operation + ": " +
                                               change_text(preview.result().change)));
}

void Document::apply(const std::string& operation, Arguments given, Step step) {
    if (!begin_request()) return;
    watch(runner_->apply(operation, std::move(given), {.step = step, .variant = variant_}),
          operation, operation, false, [this](const LogEntry& entry) { enter(entry); });
}

void Document::preview(const std::string& operation, Arguments given, Step step) {
    if (!begin_request()) return;
    watch(runner_->preview(operation, std::move(given), {.step = step, .variant = variant_}),
          "preview of " + operation, operation, false,
          [this](const Preview& preview) { show_preview(preview); });
}

void Document::change(EditId edit, Arguments given) {
    if (!begin_request()) return;
    watch(runner_->change_edit(edit, std::move(given)), "edit " + std::to_string(edit), {}, false,
          [this](const LogEntry& entry) { enter(entry); });
}

void Document::preview_change(EditId edit, Arguments given) {
    if (!begin_request()) return;
    const auto job = runner_->submit(
        [edit, given = std::move(given)](Session& session, const Progress& progress) {
            return session.preview_change(edit, given, {}, progress);
        },
        "preview");
    watch(job, "preview of edit " + std::to_string(edit), {}, false,
          [this](const Preview& preview) { show_preview(preview); });
}

void Document::commit_preview() {
    if (!preview_ || !begin_request()) return;
    const std::string operation = preview_->edit().operation;
    watch(runner_->commit(*preview_), operation, operation, false,
          [this](const LogEntry& entry) { enter(entry); });
}

void Document::drop_preview() {
    if (!preview_) return;
    preview_.reset();
    scene_changed();
}

void Document::remove(EditId edit) {
    if (!begin_request()) return;
    watch(runner_->remove_edit(edit), "removing edit " + std::to_string(edit), {}, false,
          [](const Nothing&) {});
}

void Document::undo() {
    if (!begin_request()) return;
    drop_preview();
    watch(runner_->undo(), "undo", {}, false, [](const Nothing&) {});
}

void Document::redo() {
    if (!begin_request()) return;
    drop_preview();
    watch(runner_->redo(), "redo", {}, false, [](const Nothing&) {});
}

void Document::jump(StateId state) {
    if (!begin_request()) return;
    drop_preview();
    watch(runner_->jump(state), "going to another state", {}, false, [](const Nothing&) {});
}

void Document::run_pending() {
    if (!begin_request()) return;
    watch(runner_->scene(variant_), "running pending edits", {}, false, [this](const Scene& scene) {
        if (!has_pending(*snapshot_, variant_)) set_scene(scene);
    });
}

void Document::set_note(EditRef edit, const std::string& note) {
    if (!begin_request()) return;
    const auto job = runner_->submit([edit, note](Session& session, const Progress&) {
        session.set_note(edit, note);
        return Nothing{};
    });
    watch(job, "writing a note", {}, false, [](const Nothing&) {});
}

Recipe Document::recipe(const std::string& purpose) const {
    const Scene* scene = current();
    RecipeUse use = {scene != nullptr && scene->image ? "image" : "surface", purpose};
    if (scene != nullptr && scene->mask) use.emplace_back("mask");
    const nlohmann::ordered_json own = input_ ? own_recipe(*input_, purpose) : nullptr;
    Recipe recipe = own.is_null() ? default_recipe(use) : recipe_from_json(own, use);
    std::erase_if(recipe, [&](const RecipeEntry& entry) {
        return entry.given.operation().recipe.loads.has_value() || is_done(*snapshot_, entry);
    });
    return recipe;
}

void Document::prepare(const std::string& purpose) {
    if (!begin_request()) return;
    drop_preview();
    variant_ = purpose;
    preparation_ = Preparation{.recipe = recipe(purpose), .purpose = purpose};
    prepare_next();
}

/// One job per entry, so that the view follows the recipe.
void Document::prepare_next() {
    if (preparation_->next == preparation_->recipe.size()) {
        tell(make_message(MessageKind::Success, "prepared for " + preparation_->purpose));
        return preparation_.reset();
    }
    cancel_background();
    const RecipeEntry entry = preparation_->recipe[preparation_->next];
    const auto texts = std::make_shared<ToldTexts>();
    const auto job = runner_->submit([entry, purpose = preparation_->purpose, texts](
                                         Session& session, const Progress& progress) {
        const Teller note = [&](const std::string& text) { texts->add(text); };
        apply_recipe(session, {entry}, purpose, note, progress);
        return Nothing{};
    });
    const std::string& name = entry.given.operation().name;
    watch(job, name, name, false, [this, texts](const Nothing&) {
        for (const std::string& text : texts->take()) tell(told(text));
        ++preparation_->next;
        prepare_next();
    });
}

void Document::export_to(const std::filesystem::path& file) {
    if (!begin_request()) return;
    try {
        check_export_name(file);
    } catch (const UsageError& error) {
        return fail(error.what(), {});
    }
    const ExportFormat* format = row_that_writes(export_formats(), file.string());
    const std::string unit = format == nullptr ? "" : ", in " + format->unit;
    const auto write = [file](const Scene& scene, const Progress& progress) {
        PendingFiles files;
        export_scene(files, file, scene, {});
        progress.check_cancelled();
        files.commit();
    };
    const std::string done = "exported " + file.string() + unit;
    watch(runner_->with_scene(variant_, write), "export", {}, false,
          [this, done](const Nothing&) { tell(make_message(MessageKind::Success, done)); });
}

void Document::save_copy(const std::filesystem::path& project) {
    if (!begin_request()) return;
    watch(runner_->save_as(project), "saving a copy", {}, false, [this, project](const Nothing&) {
        tell(make_message(MessageKind::Success, "saved a copy as " + project.string()));
    });
}

// --- strokes of a brush

bool Document::can_paint() const {
    const Scene* scene = current();
    return scene != nullptr && scene->surface && !preview_ && !opening_ &&
           snapshot_->read_only_reason.empty() && std::ranges::all_of(jobs_, [](const auto& job) {
               return job->background && job->what != kReading;
           });
}

/// The last edit's step: what is painted on is the shown surface, not an earlier one.
Step Document::stroke_step(const std::string& operation) const {
    const Operation& brush = find_operation(operation);
    Step last = brush.usual_step, step = brush.usual_step;
    for (const HistoryEntry& entry : snapshot_->history->line(variant_))
        if (entry.status == EditStatus::Done) last = std::max(last, entry.place.step);
    for (const Step allowed : brush.allowed)
        if (allowed <= last) step = std::max(step, allowed);
    return step;
}

void Document::begin_stroke(StrokeRequest request) {
    if (!can_paint() || !begin_request()) return;
    const Step step = stroke_step(request.operation);
    strokes_.begin(*runner_, std::move(request), {.step = step, .variant = variant_});
}

void Document::drop_stroke() {
    if (!is_painting()) return;
    strokes_.drop();
    show_without_stroke();
}

void Document::end(const EndedStroke& stroke) {
    if (stroke.entry) return tell_entered(*stroke.entry);
    if (stroke.cancelled) stop_with("cancelled");
    if (!stroke.error.empty()) fail(stroke.error, stroke.operation);
    show_without_stroke();
}

void Document::show_without_stroke() {
    scene_changed();
    if (scene_ && scene_->surface && !is_painting()) request_figures();
}

// --- progress and messages

std::optional<Activity> Document::activity() const {
    if (opening_) {
        const JobProgress progress = opening_->job().progress();
        return Activity{progress.what.empty() ? "opening" : progress.what, progress.fraction};
    }
    for (const auto& job : jobs_) {
        if (job->background) continue;
        const JobProgress progress = job->progress();
        const std::string what = progress.what.empty() || progress.what == job->what
                                     ? job->what
                                     : job->what + ": " + progress.what;
        if (!preparation_) return Activity{what, progress.fraction};
        const auto done = static_cast<double>(preparation_->next);
        return Activity{"preparing: " + what, (done + progress.fraction) /
                                                  static_cast<double>(preparation_->recipe.size())};
    }
    if (const LiveStroke* stroke = strokes_.entering())
        return Activity{stroke->operation(), stroke->progress().fraction};
    return std::nullopt;
}

void Document::cancel() {
    strokes_.cancel();
    if (opening_) opening_->cancel();
    for (const auto& job : jobs_)
        if (!job->background) job->cancel();
}

void Document::tell(Message message) {
    messages_.push_back(std::move(message));
    if (messages_.size() > kMostMessages) messages_.pop_front();
}

void Document::stop_with(const std::string& text) {
    preparation_.reset();
    tell(make_message(MessageKind::Remark, text));
}

void Document::fail(const std::string& text, const std::string& operation) {
    preparation_.reset();
    failure_ = make_message(MessageKind::Error, text, operation);
    tell(*failure_);
}

}  // namespace vesselbench
