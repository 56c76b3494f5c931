#include "workbench/session/session.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <ctime>
#include <map>
#include <utility>

#include <nlohmann/json.hpp>
#include <pwd.h>
#include <unistd.h>

#include "geometry/kernel/errors.h"
#include "workbench/case/version.h"
#include "workbench/project/source_files.h"
#include "workbench/project/stored_text.h"
#include "workbench/session/replay_tolerance.h"
#include "workbench/session/scene_cache.h"
#include "workbench/session/surface_change.h"

namespace vesselbench {

namespace {

std::string utc_now() {
    const std::time_t now = std::time(nullptr);
    std::tm parts{};
    gmtime_r(&now, &parts);
    std::array<char, 32> text{};
    std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &parts);
    return text.data();
}

std::string login_name() {
    const passwd* user = getpwuid(geteuid());
    return user != nullptr ? user->pw_name : "unknown";
}

std::string device_of(const Arguments& resolved) {
    const auto found = resolved.values().find("device");
    if (found == resolved.values().end()) return "cpu";
    const auto* device = std::get_if<std::string>(&found->second);
    return device != nullptr && *device == "gpu" ? "gpu" : "cpu";
}

std::string step_names(const std::vector<Step>& steps) {
    std::string names;
    for (const Step step : steps) names += (names.empty() ? "" : ", ") + to_string(step);
    return names;
}

EditPlace place_of(const Operation& operation, const EditOptions& options) {
    EditPlace place{options.step.value_or(operation.usual_step), {}};
    if (std::find(operation.allowed.begin(), operation.allowed.end(), place.step) ==
        operation.allowed.end())
        throw UsageError(operation.name + " is not allowed in step " + to_string(place.step) +
                         " (only in: " + step_names(operation.allowed) + ")");
    if (!belongs_to_variant(place.step)) return place;
    if (options.variant.empty())
        throw UsageError("step " + to_string(place.step) +
                         " belongs to a variant; name it (cfd, rp, ...)");
    place.variant = options.variant;
    return place;
}

/// The entries that stand before a new edit of this place.
std::vector<HistoryEntry> entries_before(const History& history, const EditPlace& place) {
    std::vector<HistoryEntry> before = history.line(place.variant);
    std::erase_if(before, [&](const HistoryEntry& e) { return e.place.step > place.step; });
    return before;
}

/// The entries of the edit's line up to it, without it.
std::vector<HistoryEntry> entries_before(const History& history, EditId id) {
    for (const HistoryEntry& entry : history.entries()) {
        if (entry.edit.id != id) continue;
        std::vector<HistoryEntry> before = history.line(entry.place.variant);
        const auto own = std::find_if(before.begin(), before.end(),
                                      [&](const auto& e) { return e.edit.id == id; });
        before.erase(own, before.end());
        return before;
    }
    throw UsageError("the current state holds no edit " + std::to_string(id) +
                     "; the log lists its edits");
}

bool refers_to_image(const Scene& scene, std::size_t embed_limit) {
    const auto large = [&](const std::optional<Image>& image) {
        return image && image->voxels && image->voxels->size() * sizeof(float) > embed_limit;
    };
    return large(scene.image) || large(scene.mask);
}

}  // namespace

struct Session::Parts {
    SessionOptions options;
    ProjectFile project;
    History history;
    SceneCache cache;
    /// Results of pending edits that a session without the right to write ran for itself.
    std::map<ResultId, ResultRecord> own_results;
    std::map<ResultId, Scene> own_scenes;

    Parts(SessionOptions o, ProjectFile p)
        : options(std::move(o)),
          project(std::move(p)),
          history(project.history()),
          cache(options.scene_bytes) {
        if (options.author.empty()) options.author = login_name();
    }

    /// An edit that has run: everything that is going to be committed.
    struct Run {
        Scene input;
        Outcome outcome;
        ResultRecord record;
        Arguments located;  ///< the arguments with the paths of the files it read
    };

    void check_writable() const {
        if (!project.read_only_reason().empty()) throw IoError(project.read_only_reason());
    }

    Run run(const Operation& operation, ResultId input, const Arguments& located,
            Progress& progress) {
        Run done;
        done.input = load(input);
        done.located = located;
        const auto start = std::chrono::steady_clock::now();
        done.outcome = run_operation(operation, done.input, located, progress, options.worker);
        const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
        ResultRecord& record = done.record;
        record.input = input;
        record.resolved = without_folders(operation, done.outcome.resolved);
        record.warnings = done.outcome.warnings;
        if (done.outcome.report) record.report = stored_text(*done.outcome.report);
        record.change = surface_change(done.input, done.outcome.scene);
        record.duration = took.count();
        record.device = device_of(record.resolved);
        stamp(record);
        return done;
    }

    static void stamp(ResultRecord& record) {
        record.time = utc_now();
        record.program_version = version();
    }

    [[nodiscard]] bool only_reads() const { return !project.read_only_reason().empty(); }

    /// Writes the difference between the history and `next`, then makes it the history.
    void commit(History next, ProjectChange change) {
        change.before = &history;
        change.after = &next;
        project.commit(change);
        history = std::move(next);
    }

    /// Enters the result of a pending edit. A session that only reads keeps it to itself.
    void commit_result(History next, const ResultRecord& record, const Scene* scene,
                       const Scene* input) {
        if (only_reads()) {
            own_results[record.id] = record;
            if (scene != nullptr) own_scenes[record.id] = *scene;
            history = std::move(next);
            return;
        }
        ProjectChange change;
        change.result = &record;
        change.scene = scene;
        change.input = input;
        commit(std::move(next), std::move(change));
        if (scene != nullptr) cache.put(record.id, *scene);
    }

    [[nodiscard]] ResultRecord record_of(ResultId id) const {
        const auto own = own_results.find(id);
        return own != own_results.end() ? own->second : project.result(id);
    }

    void navigate(const std::function<void(History&)>& move) {
        check_writable();
        History next = history;
        move(next);
        commit(std::move(next), {});
    }

    /// Commits a run edit as a new edit or a new revision. \return its entry for the log
    LogEntry enter(const Operation& operation, History next, EditRecord edit, Run run) {
        run.record.edit = edit.edit;
        run.record.id = next.add_result(edit.edit, run.record.input);
        ProjectChange change;
        change.edit = &edit;
        change.result = &run.record;
        change.scene = &run.outcome.scene;
        change.input = &run.input;
        change.sources = source_files(operation, run.located, project.folder());
        if (!refers_to_image(run.outcome.scene, options.embed_limit))
            for (SourceFile& source : change.sources) source.place.clear();
        commit(std::move(next), std::move(change));
        cache.put(run.record.id, run.outcome.scene);
        return {std::move(edit), EditStatus::Done, {}, std::move(run.record)};
    }

    /// Runs a pending edit on an input and stores what came out. \return the result behind it
    ResultId run_pending(EditRef ref, ResultId input, Progress& progress) {
        const EditRecord edit = project.edit(ref);
        const HistoryResult* earlier = history.newest_result_of(ref);
        const Arguments arguments =
            earlier != nullptr ? record_of(earlier->id).resolved : edit.given;
        History next = history;
        try {
            const Operation& operation = options.find(edit.operation);
            Run done =
                run(operation, input,
                    with_found_files(operation, arguments, project.sources(ref), project.folder()),
                    progress);
            done.record.edit = ref;
            done.record.id = next.add_result(ref, input);
            commit_result(std::move(next), done.record, &done.outcome.scene, &done.input);
            return done.record.id;
        } catch (const AlgorithmFailure& error) {
            return enter_stale(ref, input, error.what());
        } catch (const InvalidInput& error) {
            return enter_stale(ref, input, error.what());
        } catch (const UsageError& error) {
            return enter_stale(ref, input, error.what());
        }
    }

    ResultId enter_stale(EditRef ref, ResultId input, const std::string& reason) {
        History next = history;
        ResultRecord record;
        record.id = next.add_result(ref, input, reason);
        record.edit = ref;
        record.input = input;
        record.stale_reason = reason;
        record.device = "cpu";
        stamp(record);
        commit_result(std::move(next), record, nullptr, nullptr);
        return input;
    }

    /// Runs what is pending among the entries, from the first on. \return the result behind them
    ResultId evaluate(const std::vector<HistoryEntry>& entries, const Progress& progress) {
        ResultId input = 0;
        for (std::size_t i = 0; i < entries.size(); ++i) {
            const auto whole = static_cast<double>(entries.size());
            Progress part =
                progress.part(static_cast<double>(i) / whole, static_cast<double>(i + 1) / whole);
            const HistoryResult* known = history.result_of(entries[i].edit, input);
            if (known == nullptr)
                input = run_pending(entries[i].edit, input, part);
            else if (known->stale_reason.empty())
                input = known->id;
        }
        return input;
    }

    Scene load(ResultId id) {
        if (id == 0) return {};
        if (const auto own = own_scenes.find(id); own != own_scenes.end()) return own->second;
        if (auto scene = cache.find(id)) return *scene;
        const std::vector<Scene> recalled = recall(id);
        Scene scene = project.scene(id);
        cache.put(id, scene);
        return scene;
    }

    /// Makes again what is referenced only: runs the first edit of the chain that lacks something.
    /// \return scenes that must live until the result is loaded
    std::vector<Scene> recall(ResultId id) {
        std::vector<Scene> recalled;
        ResultId last = 0;
        while (project.needs_recall(id)) {
            ResultId first = id;
            for (ResultId at = id; at != 0; at = history.results().at(at).input)
                if (project.needs_recall(at)) first = at;
            if (first == last)
                throw InvalidInput("the image that edit " +
                                   std::to_string(history.results().at(first).edit.id) +
                                   " made cannot be made again: its source has changed");
            last = first;
            Progress quiet;
            const HistoryResult& result = history.results().at(first);
            recalled.push_back(rerun(result, quiet).scene);
            project.recall(recalled.back());
        }
        return recalled;
    }

    /// Runs a stored edit again on its stored input, with what it had decided.
    Outcome rerun(const HistoryResult& result, Progress& progress) {
        const EditRecord edit = project.edit(result.edit);
        const Operation& operation = options.find(edit.operation);
        const Arguments arguments =
            with_found_files(operation, record_of(result.id).resolved, project.sources(result.edit),
                             project.folder());
        return run_operation(operation, load(result.input), arguments, progress, options.worker);
    }

    /// Bit for bit; what a GPU computed by tolerance, as no two devices round alike.
    void compare(ResultId stored, const Scene& scene, ReplayEntry& replayed) {
        const std::vector<std::string> names = project.differences(stored, scene);
        if (record_of(stored).device == "gpu" && names == std::vector<std::string>{"positions"}) {
            const auto distance = replay_distance(surface_of(load(stored)), surface_of(scene));
            if (distance) replayed.distance = distance->largest;
            if (distance && distance->allowed) return;
        }
        replayed.differences.insert(replayed.differences.end(), names.begin(), names.end());
    }

    ReplayEntry replay(const HistoryEntry& entry, Progress& progress) {
        ReplayEntry replayed;
        replayed.edit = entry.edit;
        replayed.operation = project.edit(entry.edit).operation;
        replayed.variant = entry.place.variant;
        if (entry.status != EditStatus::Done || own_results.contains(entry.result)) {
            replayed.note = to_string(entry.status) + ": it has no stored result";
            return replayed;
        }
        replayed.differences = project.damages(entry.result);
        try {
            const Outcome outcome = rerun(history.results().at(entry.result), progress);
            replayed.replayed = true;
            compare(entry.result, outcome.scene, replayed);
        } catch (const Cancelled&) {
            throw;
        } catch (const IoError& error) {
            // The source file is not here any more; what was made of it is, and its checksums fit.
            replayed.note = error.what();
        } catch (const std::exception& error) {
            replayed.differences.push_back(std::string("it fails now: ") + error.what());
        }
        return replayed;
    }
};

Session::Session(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}

Session::Session(Session&&) noexcept = default;
Session& Session::operator=(Session&&) noexcept = default;
Session::~Session() = default;

Session Session::create(const std::filesystem::path& project, SessionOptions options) {
    auto file = ProjectFile::create(project, options.embed_limit);
    return Session(std::make_unique<Parts>(std::move(options), std::move(file)));
}

Session Session::open(const std::filesystem::path& project, SessionOptions options) {
    auto file = ProjectFile::open(project, options.embed_limit);
    return Session(std::make_unique<Parts>(std::move(options), std::move(file)));
}

Session Session::unsaved(SessionOptions options) {
    auto file = ProjectFile::temporary(options.embed_limit);
    return Session(std::make_unique<Parts>(std::move(options), std::move(file)));
}

const std::string& Session::read_only_reason() const {
    return parts_->project.read_only_reason();
}

LogEntry Session::apply(const std::string& operation, const Arguments& given,
                        const EditOptions& options, Progress progress) {
    parts_->check_writable();
    const Operation& found = parts_->options.find(operation);
    EditRecord edit;
    edit.place = place_of(found, options);
    edit.operation = operation;
    edit.given = without_folders(found, given);
    edit.author = options.author.empty() ? parts_->options.author : options.author;
    edit.time = utc_now();
    edit.note = options.note;
    (void)checked_arguments(found, given);  // before pending edits are run for nothing
    const auto before = entries_before(parts_->history, edit.place);
    const ResultId input = parts_->evaluate(before, progress.part(0.0, 0.5));
    Progress own = progress;
    auto run = parts_->run(found, input, given, own);
    History next = parts_->history;
    edit.edit = next.apply(edit.place);
    return parts_->enter(found, std::move(next), std::move(edit), std::move(run));
}

LogEntry Session::change_edit(EditId id, const Arguments& given, const EditOptions& options,
                              Progress progress) {
    parts_->check_writable();
    const auto before = entries_before(parts_->history, id);
    const EditRef old = parts_->history.find(id).value();
    EditRecord edit = parts_->project.edit(old);
    const Operation& found = parts_->options.find(edit.operation);
    const Arguments located =
        with_found_files(found, given, parts_->project.sources(old), parts_->project.folder());
    edit.given = without_folders(found, given);
    edit.author = options.author.empty() ? parts_->options.author : options.author;
    edit.time = utc_now();
    if (!options.note.empty()) edit.note = options.note;
    (void)checked_arguments(found, given);
    const ResultId input = parts_->evaluate(before, progress.part(0.0, 0.5));
    auto run = parts_->run(found, input, located, progress);
    History next = parts_->history;
    edit.edit = next.change(id);
    return parts_->enter(found, std::move(next), std::move(edit), std::move(run));
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
    return parts_->load(parts_->evaluate(parts_->history.line(variant), progress));
}

Scene Session::scene_after(EditId id, Progress progress) {
    auto entries = entries_before(parts_->history, id);
    entries.emplace_back().edit = parts_->history.find(id).value();
    return parts_->load(parts_->evaluate(entries, progress));
}

std::vector<LogEntry> Session::log() const {
    std::vector<LogEntry> log;
    for (const HistoryEntry& entry : parts_->history.entries()) {
        LogEntry line;
        line.edit = parts_->project.edit(entry.edit);
        line.status = entry.status;
        line.reason = entry.reason;
        if (entry.status == EditStatus::Done) line.result = parts_->record_of(entry.result);
        log.push_back(std::move(line));
    }
    return log;
}

const History& Session::history() const {
    return parts_->history;
}

std::vector<ReplayEntry> Session::replay(Progress progress) {
    const auto entries = parts_->history.entries();
    std::vector<ReplayEntry> replayed;
    for (std::size_t i = 0; i < entries.size(); ++i) {
        const auto whole = static_cast<double>(entries.size());
        Progress part =
            progress.part(static_cast<double>(i) / whole, static_cast<double>(i + 1) / whole);
        replayed.push_back(parts_->replay(entries[i], part));
    }
    return replayed;
}

void Session::save_as(const std::filesystem::path& project) const {
    parts_->project.save_as(project);
}

}  // namespace vesselbench
