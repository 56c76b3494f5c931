#include "workbench/session/session.h"

#include <algorithm>
#include <utility>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/printable.h"
#include "workbench/project/content_hash.h"
#include "workbench/project/source_files.h"
#include "workbench/session/case_store.h"
#include "workbench/session/edit_place.h"
#include "workbench/session/edit_runner.h"
#include "workbench/session/guarded_run.h"
#include "workbench/session/known_results.h"
#include "workbench/session/login_name.h"
#include "workbench/session/moved_places.h"

namespace vesselbench {

namespace {

/// SHA-256 of a file, if an edit has read one of this content.
std::optional<std::string> source_hash(const ProjectFile& project, const std::vector<LogEntry>& log,
                                       const std::filesystem::path& file) {
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(file, ignored)) return std::nullopt;
    const std::string hash = hash_of_file(file);
    const bool is_source = std::ranges::any_of(log, [&](const LogEntry& entry) {
        const auto sources = project.sources(entry.edit.edit);
        return std::ranges::count(sources, hash, &SourceFile::hash) > 0;
    });
    return is_source ? std::optional(hash) : std::nullopt;
}

bool refers_to_image(const Scene& scene, std::size_t embed_limit) {
    const auto large = [&](const std::optional<Image>& image) {
        return image && image->voxels && image->voxels->size() * sizeof(float) > embed_limit;
    };
    return large(scene.image) || large(scene.mask);
}

/// The fraction of a new edit's progress for the pending edits before it [-].
double share_of_pending(const std::vector<HistoryEntry>& before) {
    const auto pending =
        std::ranges::count(before, EditStatus::Pending, [](const auto& e) { return e.status; });
    return static_cast<double>(pending) / static_cast<double>(pending + 1);
}

}  // namespace

/// A new edit, or a new revision of one, before it runs.
struct PlannedEdit {
    const Operation* operation = nullptr;
    EditRecord edit;           ///< id 0: a new one
    CheckedArguments located;  ///< with the paths of the files it reads
    std::vector<HistoryEntry> before;
};

struct Session::Parts {
    SessionOptions options;
    CaseStore store;
    EditRunner runner;

    Parts(SessionOptions o, ProjectFile project)
        : options(std::move(o)),
          store(std::move(project), options.find, options.scene_bytes),
          runner(store, options) {
        if (options.author.empty()) options.author = login_name();
        store.set_author(options.author);
    }

    void describe(EditRecord& edit, const EditOptions& how) const {
        require_utf8(how.author, "the author");
        require_utf8(how.note, "the note");
        edit.author = how.author.empty() ? options.author : how.author;
        if (!how.note.empty()) edit.note = how.note;
    }

    /// \throw UsageError before anything runs
    PlannedEdit plan(const std::string& name, const Arguments& given, const EditOptions& how) {
        return plan(given_arguments(options.find(name), given), how);
    }

    PlannedEdit plan(const GivenArguments& given, const EditOptions& how) {
        const Operation& operation = given.operation();
        PlannedEdit planned{&operation, {}, checked_arguments(given), {}};
        planned.edit.place = place_of(operation, how, store.history());
        planned.edit.operation = operation.name;
        planned.edit.given = without_folders(operation, given);
        describe(planned.edit, how);
        planned.before = entries_before(store.history(), planned.edit.place);
        return planned;
    }

    PlannedEdit plan_change(EditId id, const Arguments& given, const EditOptions& how) {
        auto before = entries_before(store.history(), id);
        const EditRef old = store.history().find(id).value();
        EditRecord edit = store.edit(old);
        const Operation& operation = options.find(edit.operation);
        require_bare_files(operation, edit.given);
        const Arguments located =
            with_found_files(operation, given, store.project().sources(old), store.files());
        edit.given = without_folders(operation, given);
        describe(edit, how);
        return {&operation, std::move(edit), checked_arguments(operation, located),
                std::move(before)};
    }

    /// The files that a run has read, with their hashes.
    [[nodiscard]] std::vector<SourceFile> sources(const Operation& operation,
                                                  const Arguments& located, const Scene& scene) {
        auto sources = source_files(operation, located, store.project().folder());
        store.keep_places(sources, located);
        if (!refers_to_image(scene, options.embed_limit))
            for (SourceFile& source : sources) source.place.clear();
        return sources;
    }

    Preview::Data run(PlannedEdit planned, const Progress& progress) {
        const double share = share_of_pending(planned.before);
        Preview::Data data;
        data.edit = std::move(planned.edit);
        data.before = runner.evaluated(planned.before, progress.part(0.0, share));
        data.run = runner.run(*planned.operation, data.before.scene, planned.located,
                              progress.part(share, 1.0));
        data.sources = sources(*planned.operation, planned.located, *data.run.scene);
        return data;
    }

    /// The edits that precede the previewed one now.
    /// \throw UsageError if they are not those it ran on
    void check_same_input(const Preview::Data& data) const {
        const EditRecord& edit = data.edit;
        const auto now = edit.edit.id == 0 ? entries_before(store.history(), edit.place)
                                           : entries_before(store.history(), edit.edit.id);
        const auto same = [](const HistoryEntry& entry, const EvaluatedLine::Link& link) {
            return entry.edit == link.edit;
        };
        if (!std::ranges::equal(now, data.before.links, same))
            throw UsageError("the preview of " + edit.operation +
                             " no longer fits: the edits before it have changed; preview it again");
    }

    /// By how much lengths grow if the edit's revision reads the model in another unit than the one
    /// before [-]; none: it does not.
    std::optional<double> growth(const EditRecord& old, const ResultRecord& now) {
        const HistoryResult* earlier = store.history().newest_result_of(old.edit);
        if (earlier == nullptr) return std::nullopt;
        return unit_factor(options.find(old.operation), store.record(earlier->id)->resolved,
                           now.resolved);
    }

    /// \param factor of the places that were given
    std::size_t decide_anew(const EditOptions& how, double factor = 1.0) {
        std::size_t count = 0;
        for (const HistoryEntry& entry : store.history().entries()) {
            if (entry.status == EditStatus::Done) continue;
            History next = store.history();
            EditRecord edit = store.edit(entry.edit);
            if (factor != 1.0)
                edit.given = with_scaled_places(options.find(edit.operation), edit.given, factor);
            describe(edit, how);
            edit.edit = next.change(entry.edit.id);
            edit.time = utc_now();
            ProjectChange change;
            change.edit = &edit;
            change.sources = store.project().sources(entry.edit);
            store.commit(std::move(next), std::move(change));
            ++count;
        }
        return count;
    }

    LogEntry enter(Preview::Data data) {
        store.check_writable();
        check_same_input(data);
        EditRecord edit = data.edit;
        edit.time = utc_now();
        History next = store.history();
        ProjectChange change;
        ResultRecord& record = data.run.record;
        const auto factor = edit.edit.id != 0 ? growth(edit, record) : std::nullopt;
        edit.edit = edit.edit.id == 0 ? next.apply(edit.place) : next.change(edit.edit.id);
        record.edit = edit.edit;
        record.input = vesselbench::enter(data.before, next, change.results);
        record.id = next.add_result(edit.edit, record.input);
        change.results.push_back({&record, &*data.run.scene, &data.run.input});
        change.edit = &edit;
        change.sources = std::move(data.sources);
        store.commit(std::move(next), std::move(change));
        if (factor) decide_anew({.author = edit.author}, *factor);
        return {std::move(edit), EditStatus::Done, {}, store.record(record.id)};
    }

    void navigate(const std::function<void(History&)>& move) {
        store.check_writable();
        History next = store.history();
        move(next);
        store.commit(std::move(next), {});
    }
};

Session::Session(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}

Session::Session(Session&&) noexcept = default;
Session& Session::operator=(Session&&) noexcept = default;
Session::~Session() = default;

Session Session::create(const std::filesystem::path& project, SessionOptions options,
                        const std::function<void()>& make_room) {
    require_utf8(options.author, "the author");
    auto file = ProjectFile::create(project, options.embed_limit, make_room);
    return Session(std::make_unique<Parts>(std::move(options), std::move(file)));
}

Session Session::open(const std::filesystem::path& project, SessionOptions options) {
    require_utf8(options.author, "the author");
    auto file = options.only_reads ? ProjectFile::open_to_read(project, "it is only looked at")
                                   : ProjectFile::open(project, options.embed_limit);
    return Session(std::make_unique<Parts>(std::move(options), std::move(file)));
}

Session Session::unsaved(SessionOptions options) {
    auto file = ProjectFile::temporary(options.embed_limit);
    return Session(std::make_unique<Parts>(std::move(options), std::move(file)));
}

const std::string& Session::read_only_reason() const {
    return parts_->store.project().read_only_reason();
}

LogEntry Session::apply(const std::string& operation, const Arguments& given,
                        const EditOptions& options, Progress progress) {
    parts_->store.check_writable();
    return parts_->enter(parts_->run(parts_->plan(operation, given, options), progress));
}

LogEntry Session::apply(const GivenArguments& given, const EditOptions& options,
                        Progress progress) {
    parts_->store.check_writable();
    return parts_->enter(parts_->run(parts_->plan(given, options), progress));
}

LogEntry Session::change_edit(EditId id, const Arguments& given, const EditOptions& options,
                              Progress progress) {
    parts_->store.check_writable();
    return parts_->enter(parts_->run(parts_->plan_change(id, given, options), progress));
}

std::size_t Session::decide_anew(const EditOptions& options) {
    parts_->store.check_writable();
    return parts_->decide_anew(options);
}

Preview Session::preview(const std::string& operation, const Arguments& given,
                         const EditOptions& options, Progress progress) {
    return Preview(parts_->run(parts_->plan(operation, given, options), progress));
}

Preview Session::preview_change(EditId id, const Arguments& given, const EditOptions& options,
                                Progress progress) {
    return Preview(parts_->run(parts_->plan_change(id, given, options), progress));
}

LogEntry Session::commit(const Preview& preview) {
    return parts_->enter(*preview.data_);
}

LiveEdit Session::start_live(const std::string& operation, const Arguments& given,
                             const EditOptions& options, Progress progress) {
    PlannedEdit planned = parts_->plan(operation, given, options);
    const double share = share_of_pending(planned.before);
    EvaluatedLine before = parts_->runner.evaluated(planned.before, progress.part(0.0, share));
    Progress own = progress.part(share, 1.0);
    return {*planned.operation, std::move(planned.edit), std::move(before), planned.located, own};
}

Preview Session::preview(LiveEdit& live, Progress progress) {
    Progress own = progress.part(0.0, 0.9);
    Outcome outcome = live.outcome(own);
    Preview::Data data;
    data.edit = live.edit_;
    data.edit.given = without_folders(*live.operation_, live.given(outcome.resolved));
    data.before = live.before_;
    data.sources = parts_->sources(*live.operation_, live.arguments_, outcome.scene);
    data.run = guarded_run(*live.operation_, live.before_.scene, std::move(outcome), live.seconds_,
                           progress.part(0.9, 1.0));
    return Preview(std::move(data));
}

void Session::remove_edit(EditId id) {
    parts_->navigate([&](History& history) { history.remove(id); });
}

void Session::undo() {
    parts_->navigate([](History& history) { history.undo(); });
}

void Session::undo(EditId before) {
    parts_->navigate([&](History& history) { history.undo_before(before); });
}

void Session::redo() {
    parts_->navigate([](History& history) { history.redo(); });
}

void Session::redo(EditId to) {
    parts_->navigate([&](History& history) { history.redo_to(to); });
}

void Session::jump(StateId state) {
    parts_->navigate([&](History& history) { history.jump(state); });
}

Scene Session::scene(const std::string& variant, Progress progress) {
    const auto line = parts_->store.history().line(variant);
    return parts_->runner.load(parts_->runner.evaluate(line, progress), progress);
}

Scene Session::scene_after(EditId id, Progress progress) {
    auto entries = entries_before(parts_->store.history(), id);
    entries.emplace_back().edit = parts_->store.history().find(id).value();
    return parts_->runner.load(parts_->runner.evaluate(entries, progress), progress);
}

Scene Session::known_scene(StateId state, const std::string& variant, Progress progress) {
    const ResultId end = known_results(parts_->store.history(), {state}, variant).front();
    return parts_->runner.load(end, progress);
}

Scene Session::result_scene(ResultId id, Progress progress) {
    if (id != 0 && !parts_->store.history().results().contains(id))
        throw UsageError("there is no result " + std::to_string(id));
    return parts_->runner.load(id, progress);
}

void Session::set_note(EditRef edit, const std::string& note) {
    if (!parts_->store.history().edits().contains(edit))
        throw UsageError("there is no revision " + std::to_string(edit.revision) + " of edit " +
                         std::to_string(edit.id) + "; see the edits with log");
    require_utf8(note, "the note");
    parts_->store.set_note(edit, note);
}

const ProjectFile& Session::project() const {
    return parts_->store.project();
}

void Session::record(const OutsideEntry& entry) {
    parts_->store.check_writable();
    parts_->store.record(entry);
}

bool Session::add_verdicts(const StoredVerdicts& verdicts, const std::string& hash,
                           const OutsideEntry& entry) {
    parts_->store.check_writable();
    return parts_->store.add_verdicts(verdicts, hash, entry);
}

bool Session::is_source(const std::filesystem::path& file) const {
    return source_hash(parts_->store.project(), log(), file).has_value();
}

bool Session::find_source_in(const std::filesystem::path& file) {
    const auto hash = source_hash(parts_->store.project(), log(), file);
    if (hash) parts_->store.keep_place(*hash, file);
    return hash.has_value();
}

std::vector<LogEntry> Session::log() const {
    return snapshot()->log;
}

std::vector<LogEntry> Session::log(const std::string& variant) const {
    std::vector<LogEntry> entries = log();
    std::erase_if(entries, [&](const LogEntry& e) { return !is_part_of(e.edit.place, variant); });
    return entries;
}

std::shared_ptr<const Snapshot> Session::snapshot() const {
    return parts_->store.snapshot();
}

std::vector<ReplayEntry> Session::replay(Progress progress) {
    return vesselbench::replay(parts_->store, parts_->runner, progress);
}

void Session::save_as(const std::filesystem::path& project, Progress progress) const {
    parts_->store.project().save_as(project, progress);
}

void Session::fold_log() const {
    parts_->store.fold_log();
}

void Session::discard() {
    parts_->store.discard();
}

void Session::run_in_workers() {
    parts_->options.worker.every_operation = true;
}

}  // namespace vesselbench
