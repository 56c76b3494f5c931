#include <algorithm>
#include <iostream>
#include <sstream>

#include <nlohmann/json.hpp>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/printable.h"
#include "geometry/kernel/wording.h"
#include "workbench/case/argument_texts.h"
#include "workbench/case/diagnostic_words.h"
#include "workbench/case/json_text.h"
#include "workbench/commands/commands.h"
#include "workbench/commands/console/console.h"
#include "workbench/commands/console/messages.h"
#include "workbench/operations/table.h"
#include "workbench/prepare/decided_entry.h"
#include "workbench/prepare/edits_recipe.h"
#include "workbench/prepare/prepared_purposes.h"
#include "workbench/prepare/recipe.h"
#include "workbench/report/log_json.h"
#include "workbench/report/measure_table.h"
#include "workbench/session/compaction.h"
#include "workbench/session/moved_places.h"
#include "workbench/session/session.h"
#include "workbench/session/stored_measures.h"

namespace vesselbench {

namespace {

using Json = nlohmann::ordered_json;

Session open_for_reading(const std::string& project) {
    Session session = Session::open(project, {.find = find_operation});
    if (!session.read_only_reason().empty()) remark("read-only: " + session.read_only_reason());
    return session;
}

std::string short_text(const Json& value) {
    if (value.is_string()) return value.get<std::string>();
    if (value.is_array()) {
        std::string text;
        for (const Json& part : value) text += (text.empty() ? "" : ", ") + short_text(part);
        return text;
    }
    if (!value.is_number_float()) return value.dump();
    return formatted(value.get<double>(), "%.5g");
}

/// A single value, or a point.
bool is_short(const Json& value) {
    return value.is_primitive() ||
           (value.is_array() && value.size() == 3 &&
            std::ranges::all_of(value, [](const Json& part) { return part.is_number(); }));
}

/// The operation's figures: the short parts of its report.
void print_report(const std::string& text) {
    const Json report = Json::parse(text, nullptr, false);
    if (!report.is_object()) return;
    std::vector<std::vector<std::string>> rows;
    for (const auto& [key, value] : report.items())
        if (key != "headline" && is_short(value)) rows.push_back({"  " + key, short_text(value)});
    std::cout << as_columns(rows);
}

/// "3 clip-opening, 4 smooth"
std::string edit_list(const std::vector<const EditRecord*>& edits) {
    std::string list;
    for (const EditRecord* edit : edits)
        list += (list.empty() ? "" : ", ") + std::to_string(edit->edit.id) + " " + edit->operation;
    return printable(list);
}

std::vector<const EditRecord*> pending_edits(const Snapshot& now) {
    std::vector<const EditRecord*> pending;
    for (const LogEntry& entry : now.log)
        if (entry.status == EditStatus::Pending) pending.push_back(&entry.edit);
    return pending;
}

Json ids_of(const std::vector<const EditRecord*>& edits) {
    Json ids = Json::array();
    for (const EditRecord* edit : edits) ids.push_back(edit->edit.id);
    return ids;
}

Json pending_json(const Snapshot& now) {
    return ids_of(pending_edits(now));
}

/// Pending edits, and whether they run with what they chose before.
void print_pending(const Snapshot& now) {
    const std::vector<const EditRecord*> pending = pending_edits(now);
    if (pending.empty()) return;
    std::cout << "pending now: " << edit_list(pending)
              << " (they run when their result is shown, exported or built upon)\n";
    const bool anew = std::ranges::any_of(pending, [&](const EditRecord* edit) {
        return now.history->newest_result_of(edit->edit) == nullptr;
    });
    if (anew) std::cout << "they also choose again what they chose automatically\n";
}

/// What another unit of the model did to the arguments of the later edits.
struct Rescaled {
    double factor = 1.0;                    ///< of the model; 1: it has the same unit
    std::vector<const EditRecord*> places;  ///< edits whose places were scaled
    std::vector<const EditRecord*> sizes;   ///< edits whose sizes keep their numbers
};

const LogEntry* entry_of(const Snapshot& state, EditId id) {
    const auto found =
        std::ranges::find(state.log, id, [](const LogEntry& entry) { return entry.edit.edit.id; });
    return found == state.log.end() ? nullptr : &*found;
}

/// \param changed the edit that was changed between the two
Rescaled rescaled_by(EditId changed, const Snapshot& before, const Snapshot& now) {
    Rescaled found;
    const LogEntry *old = entry_of(before, changed), *made = entry_of(now, changed);
    if (old == nullptr || !old->result || made == nullptr || !made->result) return found;
    const Operation& operation = find_operation(made->edit.operation);
    const auto factor = unit_factor(operation, old->result->resolved, made->result->resolved);
    if (!factor) return found;
    found.factor = *factor;
    for (const LogEntry& entry : now.log) {
        const LogEntry* earlier = entry_of(before, entry.edit.edit.id);
        if (entry.status == EditStatus::Done || earlier == nullptr) continue;
        if (entry.edit.given != earlier->edit.given) found.places.push_back(&entry.edit);
        if (!given_sizes(find_operation(entry.edit.operation), entry.edit.given).empty())
            found.sizes.push_back(&entry.edit);
    }
    return found;
}

/// "4 remesh edge=0.2, 5 extrude-opening length=8"
std::string size_list(const std::vector<const EditRecord*>& edits) {
    std::vector<std::string> texts;
    for (const EditRecord* edit : edits) {
        std::string text = edit_list({edit});
        for (const std::string& name : given_sizes(find_operation(edit->operation), edit->given))
            text += " " + name + "=" + to_text(edit->given.values().at(name));
        texts.push_back(printable(text));
    }
    return joined(texts);
}

void print_rescaled(const Rescaled& rescaled) {
    if (!rescaled.places.empty())
        std::cout << "places given to " << edit_list(rescaled.places)
                  << " were scaled with the model, by " << short_text(rescaled.factor) << "\n";
    if (!rescaled.sizes.empty())
        std::cout << "sizes that were given keep their numbers: " << size_list(rescaled.sizes)
                  << "\n";
}

Json state_json(const Snapshot& now) {
    Json json = {{"state", now.history->current()}, {"edits", now.log.size()}};
    json["last"] = now.log.empty() ? Json() : Json(now.log.back().edit.edit.id);
    json["pending"] = pending_json(now);
    return json;
}

void print_state(const Snapshot& now) {
    std::cout << "the case now holds " << counted(now.log.size(), "edit");
    if (!now.log.empty()) std::cout << ", the last is " << edit_list({&now.log.back().edit});
    std::cout << "\n";
}

/// A change of the case that was undone or redone.
struct Move {
    StateChange change = StateChange::Apply;
    const EditRecord* edit = nullptr;
};

/// The changes that lead from an earlier state to a later one, the last one first.
std::vector<Move> moves_between(const Snapshot& earlier, const Snapshot& later) {
    std::vector<Move> moves;
    const History& history = *later.history;
    for (StateId at = history.current(); at != earlier.history->current() && at != 0;
         at = history.state(at).parent) {
        const HistoryState& state = history.state(at);
        moves.push_back({state.change, &later.past->at(state.edit).edit});
    }
    return moves;
}

std::string move_name(StateChange change) {
    return change == StateChange::Change   ? "change"
           : change == StateChange::Remove ? "remove"
                                           : "apply";
}

/// "edit 4 remesh", "the change of edit 2 smooth"
std::string move_text(const Move& move) {
    const std::string before = move.change == StateChange::Change   ? "the change of "
                               : move.change == StateChange::Remove ? "the removal of "
                                                                    : "";
    return before + "edit " + edit_list({move.edit});
}

/// \param verb "undone" or "redone"
void print_moves(const std::string& verb, const std::vector<Move>& moves, const Snapshot& now,
                 bool json) {
    if (json) {
        Json state = state_json(now);
        state[verb] = Json::array();
        for (const Move& move : moves)
            state[verb].push_back({{"edit", move.edit->edit.id},
                                   {"revision", move.edit->edit.revision},
                                   {"operation", move.edit->operation},
                                   {"change", move_name(move.change)}});
        std::cout << text_from_json(state, 2) << "\n";
        return;
    }
    std::vector<std::string> texts;
    for (const Move& move : moves) texts.push_back(move_text(move));
    std::cout << verb << ": " << joined(texts) << "\n";
    print_state(now);
}

std::string state_text(const LogEntry& entry) {
    if (entry.status != EditStatus::Done)
        return to_string(entry.status) + (entry.reason.empty() ? "" : ": " + entry.reason);
    return entry.result ? effect_text(*entry.result) : "";
}

void print_log(const std::vector<LogEntry>& log) {
    std::vector<std::vector<std::string>> rows = {
        {"edit", "step", "operation", "author", "time", "arguments and effect"}};
    for (const LogEntry& entry : log) {
        const EditRecord& edit = entry.edit;
        const std::string variant = edit.place.variant;
        const std::string revision =
            edit.edit.revision > 1 ? "." + std::to_string(edit.edit.revision) : "";
        const std::string arguments = argument_summary(find_operation(edit.operation), edit.given);
        const std::string effect = state_text(entry);
        rows.push_back({std::to_string(edit.edit.id) + revision,
                        to_string(edit.place.step) + (variant.empty() ? "" : " (" + variant + ")"),
                        edit.operation, edit.author, edit.time,
                        arguments + (arguments.empty() || effect.empty() ? "" : "; ") + effect +
                            (edit.note.empty() ? "" : " \"" + edit.note + "\"")});
    }
    std::cout << as_columns(rows);
}

void print_measures(const std::vector<KeptMeasure>& measures) {
    if (measures.empty()) return;
    std::vector<std::vector<std::string>> rows = {{"measure", "figures", "on", "state", "time"}};
    for (const KeptMeasure& measure : measures)
        rows.push_back({measure.name, measure_text(measure), to_string(measure.on),
                        std::to_string(measure.state), measure.time});
    std::cout << "\n" << as_columns(rows);
}

Json replay_json(const std::vector<ReplayEntry>& entries) {
    Json list = Json::array();
    bool same = true;
    for (const ReplayEntry& entry : entries) {
        list.push_back({{"edit", entry.edit.id},
                        {"revision", entry.edit.revision},
                        {"operation", entry.operation},
                        {"variant", entry.variant},
                        {"replayed", entry.replayed},
                        {"differences", entry.differences},
                        {"note", entry.note}});
        if (entry.distance) list.back()["distance_mm"] = *entry.distance;
        same = same && entry.differences.empty();
    }
    return {{"same", same}, {"edits", list}};
}

void print_replay(const std::vector<ReplayEntry>& entries) {
    std::vector<std::vector<std::string>> rows = {{"edit", "operation", "replay"}};
    for (const ReplayEntry& entry : entries) {
        std::string text = entry.replayed ? "same bits" : "";
        if (entry.distance) {
            std::ostringstream distance;
            distance << "computed on a GPU: within " << *entry.distance << " mm";
            text = distance.str();
        }
        if (!entry.note.empty()) text += (text.empty() ? "" : ", ") + entry.note;
        if (!entry.differences.empty()) text = "DIFFERS:";
        for (const std::string& difference : entry.differences) text += " " + difference + ";";
        rows.push_back({std::to_string(entry.edit.id), entry.operation, text});
    }
    std::cout << as_columns(rows);
}

/// With the edit, for its command.
std::vector<Diagnostic> all_warnings(const LogEntry& entry, const Arguments& given) {
    std::vector<Diagnostic> warnings = arguments_without_effect(
        find_operation(entry.edit.operation), given, entry.result->resolved);
    warnings.insert(warnings.end(), entry.result->warnings.begin(), entry.result->warnings.end());
    for (Diagnostic& warning : warnings) warning.edit = entry.edit.edit.id;
    return warnings;
}

/// What an edit that has just run did.
void print_edit(const LogEntry& entry) {
    const EditRecord& edit = entry.edit;
    std::cout << "edit " << edit.edit.id
              << (edit.edit.revision > 1 ? "." + std::to_string(edit.edit.revision) : "") << ": "
              << printable(edit.operation);
    if (!entry.result) return void(std::cout << "\n");
    const std::string effect = effect_text(*entry.result);
    std::cout << (effect.empty() ? "" : ": " + effect) << "\n";
    print_report(entry.result->report);
}

void remark_warnings(const LogEntry& entry, const Arguments& given, const std::string& project) {
    if (!entry.result) return;
    for (const Diagnostic& warning : all_warnings(entry, given))
        warn(worded(warning, {.project = project}));
}

const EditRecord& edit_of(const Snapshot& now, EditId id) {
    for (const LogEntry& entry : now.log)
        if (entry.edit.edit.id == id) return entry.edit;
    throw UsageError("the current state has no edit " + std::to_string(id) + "; 'vesselbench log " +
                     now.project + "' lists its edits");
}

}  // namespace

void apply_operation(const ApplyOptions& options, const Progress& progress) {
    const Operation& operation = find_operation(options.operation);
    const GivenArguments given = arguments_from_texts(operation, options.arguments);
    EditOptions edit{.author = options.author, .note = options.note};
    if (!options.step.empty()) edit.step = step_from(options.step);
    Session session = Session::open(options.project, {.find = find_operation});
    edit.variant = variant_of(options.project, options.variant, *session.snapshot()->history);
    const LogEntry entry = session.apply(given, edit, progress);
    remark_warnings(entry, given, options.project);
    if (options.json)
        std::cout << text_from_json(log_json(entry), 2) << "\n";
    else
        print_edit(entry);
}

void change_edit(const ChangeOptions& options, const Progress& progress) {
    Session session = Session::open(options.project, {.find = find_operation});
    const std::shared_ptr<const Snapshot> before = session.snapshot();
    const EditRecord& old = edit_of(*before, options.edit);
    const DecidedEntry changed = decided_change(
        options.edit, arguments_from_texts(find_operation(old.operation), options.arguments),
        session, progress.silent());
    const Arguments& given = changed.entry.given;
    if (!changed.remark.empty()) remark(changed.remark);
    const LogEntry entry = session.change_edit(
        options.edit, given, {.author = options.author, .note = options.note}, progress);
    if (options.anew) session.decide_anew({.author = options.author});
    remark_warnings(entry, given, options.project);
    const std::shared_ptr<const Snapshot> now = session.snapshot();
    const Rescaled rescaled = rescaled_by(options.edit, *before, *now);
    if (options.json) {
        Json json = log_json(entry);
        json["pending"] = pending_json(*now);
        if (rescaled.factor != 1.0) {
            json["places_scaled_by"] = rescaled.factor;
            json["scaled_places"] = ids_of(rescaled.places);
            json["kept_sizes"] = ids_of(rescaled.sizes);
        }
        std::cout << text_from_json(json, 2) << "\n";
        return;
    }
    print_edit(entry);
    print_pending(*now);
    print_rescaled(rescaled);
}

void remove_edit(const RemoveOptions& options) {
    Session session = Session::open(options.project, {.find = find_operation});
    const EditRecord old = edit_of(*session.snapshot(), options.edit);
    session.remove_edit(options.edit);
    const std::shared_ptr<const Snapshot> now = session.snapshot();
    if (options.json) {
        Json json = {{"removed", old.edit.id}, {"operation", old.operation}};
        json.update(state_json(*now));
        std::cout << text_from_json(json, 2) << "\n";
        return;
    }
    std::cout << "removed edit " << edit_list({&old}) << "\n";
    print_state(*now);
    print_pending(*now);
}

void note_edit(const NoteOptions& options) {
    Session session = Session::open(options.project, {.find = find_operation});
    session.set_note(edit_of(*session.snapshot(), options.edit).edit, options.words);
    const std::shared_ptr<const Snapshot> now = session.snapshot();
    const EditRecord& edit = edit_of(*now, options.edit);
    if (options.json)
        std::cout << text_from_json(Json({{"edit", edit.edit.id}, {"note", edit.note}}), 2) << "\n";
    else
        std::cout << "edit " << edit_list({&edit})
                  << (edit.note.empty() ? " has no note" : ": \"" + printable(edit.note) + "\"")
                  << "\n";
}

void print_edits_recipe(const EditsRecipeOptions& options, const Progress& progress) {
    Session session = open_for_reading(options.project);
    const std::string variant =
        variant_of(options.project, options.variant, *session.snapshot()->history);
    static_cast<void>(session.scene(variant, progress));
    std::cout << recipe_of_edits(*session.snapshot(), variant, options.portable);
}

void show_log(const LogOptions& options) {
    const Session session = open_for_reading(options.project);
    const std::shared_ptr<const Snapshot> now = session.snapshot();
    const std::vector<KeptMeasure> measures = stored_measures(options.project);
    if (!options.json) {
        print_log(now->log);
        return print_measures(measures);
    }
    Json edits = Json::array();
    for (const LogEntry& entry : now->log) edits.push_back(log_json(entry));
    std::cout << text_from_json(
                     Json({{"project", std::filesystem::path(options.project).filename().string()},
                           {"read_only", now->read_only_reason},
                           {"state", now->history->current()},
                           {"states", now->history->states().size()},
                           {"edits", edits},
                           {"measures", measures_json(measures)}}),
                     2)
              << "\n";
}

void undo_edit(const StepBackOptions& options) {
    Session session = Session::open(options.project, {.find = find_operation});
    const std::shared_ptr<const Snapshot> before = session.snapshot();
    if (options.edit)
        session.undo(*options.edit);
    else
        session.undo();
    const std::shared_ptr<const Snapshot> now = session.snapshot();
    print_moves("undone", moves_between(*now, *before), *now, options.json);
}

void redo_edit(const StepBackOptions& options) {
    Session session = Session::open(options.project, {.find = find_operation});
    const std::shared_ptr<const Snapshot> before = session.snapshot();
    if (options.edit)
        session.redo(*options.edit);
    else
        session.redo();
    const std::shared_ptr<const Snapshot> now = session.snapshot();
    std::vector<Move> moves = moves_between(*before, *now);
    std::ranges::reverse(moves);
    print_moves("redone", moves, *now, options.json);
}

bool replay_project(const LogOptions& options, const Progress& progress) {
    Session session = open_for_reading(options.project);
    const std::vector<ReplayEntry> entries = session.replay(progress);
    const Json json = replay_json(entries);
    if (options.json)
        std::cout << text_from_json(json, 2) << "\n";
    else
        print_replay(entries);
    if (json["same"] == true) return true;
    complain("the replay differs from the stored results");
    return false;
}

void compact(const LogOptions& options) {
    const Compaction done = compact_project(options.project);
    if (options.json) {
        std::cout << text_from_json(Json({{"dropped", done.dropped},
                                          {"bytes_before", done.before},
                                          {"bytes_after", done.after}}),
                                    2)
                  << "\n";
        return;
    }
    std::vector<std::string> list;
    for (const auto& [operation, count] : done.dropped)
        list.push_back(std::to_string(count) + " " + operation);
    if (list.empty())
        std::cout << "nothing to drop: the current state needs every result\n";
    else
        std::cout << "dropped results of undone or changed edits: " << joined(list)
                  << "; they are computed again where they are needed\n";
    std::cout << formatted(static_cast<double>(done.before) / 1024.0, "%.0f KB, now ")
              << formatted(static_cast<double>(done.after) / 1024.0, "%.0f KB\n");
}

}  // namespace vesselbench
