#include "tests/soak/random_edits.h"

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <stop_token>
#include <thread>

#include <nlohmann/json.hpp>

#include "geometry/kernel/errors.h"
#include "tests/support/scene_bits.h"
#include "workbench/case/argument_texts.h"
#include "workbench/case/arguments_json.h"
#include "workbench/case/checked_value.h"
#include "workbench/case/history.h"
#include "workbench/export/products.h"
#include "workbench/operations/table.h"
#include "workbench/project/stored_text.h"

namespace vesselbench::soak {

namespace {

constexpr auto kPatience = std::chrono::seconds(4);  // then an action is cancelled
constexpr auto kLongest = std::chrono::seconds(30);  // until a cancel must have worked
constexpr std::size_t kLargest = 20000;              // triangles: larger scenes take too long

/// Cancels after a while.
class Deadline {
public:
    Deadline()
        : thread_([this](const std::stop_token& ended) {
              std::unique_lock lock(mutex_);
              waiting_.wait_for(lock, ended, kPatience, [] { return false; });
              if (!ended.stop_requested()) stop_.request_stop();
          }) {}

    [[nodiscard]] Progress progress() const { return {nullptr, stop_.get_token()}; }

private:
    std::stop_source stop_;
    std::mutex mutex_;
    std::condition_variable_any waiting_;
    std::jthread thread_;
};

/// Runs an action; errors of the program's own are refusals.
template <class Run>
std::string outcome_of(Run run, std::string& reason) {
    reason.clear();
    const auto begin = std::chrono::steady_clock::now();
    std::string outcome = "done";
    try {
        run();
    } catch (const UsageError& error) {
        outcome = "refused";
        reason = error.what();
    } catch (const InvalidInput& error) {
        outcome = "refused";
        reason = error.what();
    } catch (const AlgorithmFailure& error) {
        outcome = "failed";
        reason = error.what();
        if (reason.find("crashed (") != std::string::npos ||
            reason.find("ended early (") != std::string::npos)
            throw std::runtime_error(reason);
    } catch (const Cancelled&) {
        outcome = "cancelled";
    }
    if (std::chrono::steady_clock::now() - begin > kLongest)
        throw std::runtime_error("an action took over 30 s");
    return outcome;
}

bool is_small(const Scene& scene) {
    return !scene.surface || scene.surface->triangle_count() < kLargest;
}

/// Arguments as a user gives them again: with the files where they are.
Arguments with_files(const Operation& operation, Arguments arguments, const SmallFiles& files) {
    for (const Parameter& parameter : operation.parameters)
        if (parameter.type == ParameterType::File && arguments.has(parameter.name))
            arguments.set(parameter.name,
                          (files.folder() / arguments.text(parameter.name)).string());
    return arguments;
}

std::string place_of(const LogEntry& entry) {
    return "edit " + std::to_string(entry.edit.edit.id) + ", " + entry.edit.operation + " " +
           stored_text(entry.edit.given);
}

void check_texts(const LogEntry& entry, std::vector<std::string>& found) {
    const Operation& operation = find_operation(entry.edit.operation);
    const Arguments& resolved = entry.result->resolved;
    if (arguments_from_stored(stored_text(resolved)) != resolved)
        found.push_back(place_of(entry) + ": the stored text loses something");
    try {
        if (static_cast<const Arguments&>(arguments_from_json(operation, to_json(resolved))) !=
            resolved)
            found.push_back(place_of(entry) + ": JSON loses something");
        for (const auto& [name, value] : resolved.values())
            if (checked_value(find_parameter(operation, name), to_text(value)) != value)
                found.push_back(place_of(entry) + ": the text of " + name +
                                " loses something: " + to_text(value));
    } catch (const UsageError& error) {
        found.push_back(place_of(entry) + ": resolved arguments are refused: " + error.what());
    }
}

void check_replay(Session& session, std::vector<std::string>& found) {
    for (const ReplayEntry& entry : session.replay())
        for (const std::string& difference : entry.differences)
            found.push_back("replay of edit " + std::to_string(entry.edit.id) + ", " +
                            entry.operation + ": another " + difference);
}

/// The same edits in a new session, with what they resolved to.
void check_from_nothing(Session& session, const SmallFiles& files, const SessionOptions& own,
                        std::vector<std::string>& found) {
    Session again = Session::unsaved(own);
    for (const LogEntry& entry : session.log()) {
        if (entry.status != EditStatus::Done) continue;
        const Operation& operation = find_operation(entry.edit.operation);
        EditOptions options{.step = entry.edit.place.step};
        if (!entry.edit.place.variant.empty()) options.variant = entry.edit.place.variant;
        try {
            const LogEntry made = again.apply(
                operation.name, with_files(operation, entry.result->resolved, files), options);
            if (made.result->resolved != entry.result->resolved)
                found.push_back(place_of(entry) + " resolves to " +
                                stored_text(made.result->resolved) + " instead of " +
                                stored_text(entry.result->resolved));
        } catch (const std::exception& error) {
            found.push_back(place_of(entry) + " cannot be applied again: " + error.what());
        }
    }
    for (const std::string variant : {"cfd", "rp"})
        if (test::bits_of(session.scene(variant)) != test::bits_of(again.scene(variant)))
            found.push_back("the edits applied again give another scene for " + variant);
}

}  // namespace

RandomEditor::RandomEditor(std::uint64_t seed, const SmallFiles& files)
    : dice_(seed), files_(files) {}

std::string RandomEditor::act(Session& session) {
    static const std::vector<std::pair<double, Action>> actions = {
        {50, &RandomEditor::apply},     {8, &RandomEditor::change}, {3, &RandomEditor::remove},
        {10, &RandomEditor::undo},      {6, &RandomEditor::redo},   {4, &RandomEditor::go_to},
        {4, &RandomEditor::go_by_edit}, {8, &RandomEditor::show},   {2, &RandomEditor::note},
        {5, &RandomEditor::write}};
    std::vector<double> shares;
    for (const auto& [share, action] : actions) shares.push_back(share);
    Action action = actions[dice_.pick(shares)].second;
    if (session.log().empty()) action = &RandomEditor::apply;
    std::string what;
    doing_ = "other";
    const std::string outcome = outcome_of([&] { what = (this->*action)(session); }, reason_);
    ++tally_[outcome];
    if (outcome == "done") ++tally_[what.substr(0, what.find(' '))];
    return (outcome == "done" ? what : doing_) + " " + outcome;
}

const Operation& RandomEditor::some_operation(const Session& session, const Scene& scene) {
    if (session.log().empty())
        return loading_operation(dice_.chance(0.7) ? InputKind::Surface : InputKind::Image);
    if (!scene.surface && dice_.chance(0.6))
        return scene.image ? extracting_operation() : loading_operation(InputKind::Surface);
    const auto table = operation_table();
    return table[dice_.whole(0, static_cast<int>(table.size()) - 1)];
}

std::optional<EditId> RandomEditor::some_edit(const Session& session) {
    const auto log = session.log();
    if (log.empty()) return std::nullopt;
    return log[dice_.whole(0, static_cast<int>(log.size()) - 1)].edit.edit.id;
}

Scene RandomEditor::scene_before(Session& session) {
    const Deadline deadline;
    return session.scene(dice_.chance(0.5) ? "cfd" : "rp", deadline.progress());
}

std::string RandomEditor::apply(Session& session) {
    const Scene scene = scene_before(session);
    if (!is_small(scene)) return undo(session);
    const Operation& operation = some_operation(session, scene);
    EditOptions options{.variant = dice_.chance(0.5) ? "cfd" : "rp"};
    if (dice_.chance(0.3))
        options.step =
            operation.allowed[dice_.whole(0, static_cast<int>(operation.allowed.size()) - 1)];
    const Arguments given = random_arguments(operation, scene, files_, dice_);
    const Deadline deadline;
    doing_ = "apply " + operation.name;
    session.apply(operation.name, given, options, deadline.progress());
    ++tally_["applied " + operation.name];
    return "apply " + operation.name;
}

std::string RandomEditor::change(Session& session) {
    const auto id = some_edit(session);
    if (!id) return "change";
    for (const LogEntry& entry : session.log()) {
        if (entry.edit.edit.id != *id) continue;
        const Operation& operation = find_operation(entry.edit.operation);
        const Arguments given = random_arguments(operation, scene_before(session), files_, dice_);
        const Deadline deadline;
        session.change_edit(*id, given, {}, deadline.progress());
    }
    return "change " + std::to_string(*id);
}

std::string RandomEditor::remove(Session& session) {
    if (const auto id = some_edit(session)) session.remove_edit(*id);
    return "remove";
}

std::string RandomEditor::undo(Session& session) {
    session.undo();
    return "undo";
}

std::string RandomEditor::redo(Session& session) {
    session.redo();
    return "redo";
}

std::string RandomEditor::go_to(Session& session) {
    const auto& states = session.snapshot()->history->states();
    session.jump(dice_.whole(0, static_cast<int>(states.size()) - 1));
    return "jump";
}

std::string RandomEditor::go_by_edit(Session& session) {
    const auto id = some_edit(session);
    if (id) dice_.chance(0.5) ? session.undo(*id) : session.redo(*id);
    return "jump";
}

std::string RandomEditor::show(Session& session) {
    (void)scene_before(session);
    return "show";
}

std::string RandomEditor::note(Session& session) {
    const auto log = session.log();
    session.set_note(log.back().edit.edit, "note " + std::to_string(dice_.whole(0, 999)));
    return "note";
}

std::string RandomEditor::write(Session& session) {
    if (export_folder_.empty()) return "show";
    static const std::vector<std::string> names = {"a.stl", "a.vtp", "a.3mf", "a.obj", "a.msh"};
    const Scene scene = scene_before(session);
    PendingFiles files;
    export_scene(files, export_folder_ / names[dice_.whole(0, static_cast<int>(names.size()) - 1)],
                 scene, {});
    files.commit();
    return "export";
}

SessionOptions table_options(std::vector<std::string> worker) {
    SessionOptions options;
    options.author = "soak";
    options.find = find_operation;
    options.worker.command = std::move(worker);
    return options;
}

std::vector<std::string> unreproduced(Session& session, const SmallFiles& files,
                                      const SessionOptions& options) {
    std::vector<std::string> found;
    for (const std::string variant : {"cfd", "rp"}) (void)session.scene(variant);
    for (const LogEntry& entry : session.log())
        if (entry.status == EditStatus::Done) check_texts(entry, found);
    check_replay(session, found);
    check_from_nothing(session, files, options, found);
    return found;
}

}  // namespace vesselbench::soak
