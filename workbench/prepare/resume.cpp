#include "workbench/prepare/resume.h"

#include <algorithm>
#include <vector>

#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/errors.h"
#include "workbench/operations/table.h"
#include "workbench/prepare/recipe_run.h"

namespace vesselbench {

namespace {

bool has_place_of(const EditRecord& edit, const RecipeEntry& entry, const std::string& variant) {
    return edit.operation == entry.given.operation().name && edit.place.step == step_of(entry) &&
           is_part_of(edit.place, variant);
}

/// True for an argument that limits an operation to one vessel's end, or to ends that were decided.
bool names_end(const Parameter& parameter) {
    const Meaning meaning = parameter.meaning;
    return meaning == Meaning::Planes || (parameter.type == ParameterType::Point &&
                                          (meaning == Meaning::Tip || meaning == Meaning::Branch));
}

/// True for an edit that loads another neighbour than the entry.
bool is_other_neighbour(const Arguments& edit, const GivenArguments& entry) {
    return entry.operation().recipe.loads == InputKind::Neighbour &&
           edit.optional_text("name") != entry->optional_text("name");
}

/// True unless the edit does a part only of what the entry does.
bool covers(const Arguments& edit, const GivenArguments& entry) {
    if (is_other_neighbour(edit, entry)) return false;
    return std::ranges::none_of(entry.operation().parameters, [&](const Parameter& parameter) {
        const std::string& name = parameter.name;
        return names_end(parameter) && edit.has(name) &&
               !(entry->has(name) && edit.values().at(name) == entry->values().at(name));
    });
}

/// The edits on the way to the current state, with those that were removed.
std::vector<EditId> edits_made(const Snapshot& made) {
    std::vector<EditId> ids;
    for (const LogEntry& entry : made.log) ids.push_back(entry.edit.edit.id);
    for (const HistoryState* state = &made.history->state(made.history->current());
         state->change != StateChange::Start; state = &made.history->state(state->parent))
        if (state->change == StateChange::Remove) ids.push_back(state->edit.id);
    return ids;
}

/// An edit's revisions: it counts with its first arguments and with those it was changed to.
bool does(EditId id, const Snapshot& made, const RecipeEntry& entry, const std::string& variant) {
    const auto first = made.past->lower_bound({id, 0}), last = made.past->lower_bound({id + 1, 0});
    return std::any_of(first, last, [&](const auto& revision) {
        const EditRecord& edit = revision.second.edit;
        return has_place_of(edit, entry, variant) && covers(edit.given, entry.given);
    });
}

}  // namespace

Session resumed(const std::filesystem::path& project, const SessionOptions& options) {
    Session session = Session::open(project, options);
    if (!session.read_only_reason().empty()) throw IoError(session.read_only_reason());
    return session;
}

void refuse_other_input(Session& session, const Input& input) {
    const std::vector<LogEntry> log = session.log();
    if (log.empty()) return;
    // Files made for a phantom are not the user's.
    if (!input.keep && std::filesystem::is_regular_file(input.file) &&
        !session.find_source_in(input.file))
        throw UsageError("--resume: the project was not made from '" + input.name +
                         "', or the file has changed since: prepare it into another folder");
    const LogEntry& loading = log.front();
    if (input.units.empty() || !loading.result || !loading.result->resolved.has("units")) return;
    const std::string units = loading.result->resolved.text("units");
    if (units == input.units) return;
    const EditRecord& edit = loading.edit;
    const bool model_follows =
        parameter_of(find_operation(edit.operation), Meaning::Unit) != nullptr;
    Diagnostic found{.code = "read-in-another-unit",
                     .operation = edit.operation,
                     .edit = edit.edit.id,
                     .words = {{"was", units}, {"wanted", input.units}}};
    if (model_follows)
        found.remedies = {{.arguments = {{"units", input.units}}}};
    else
        found.words["advice"] = ", or prepare it into another folder";
    throw DiagnosedUsage(std::move(found));
}

void refuse_stale_edits(const std::vector<LogEntry>& log) {
    const auto stale = std::ranges::find(log, EditStatus::Stale, &LogEntry::status);
    if (stale == log.end()) return;
    const EditRecord& edit = stale->edit;
    throw DiagnosedFailure({.code = "edit-no-longer-applies",
                            .operation = edit.operation,
                            .edit = edit.edit.id,
                            .words = {{"number", std::to_string(edit.edit.id)},
                                      {"name", edit.operation},
                                      {"why", stale->reason}},
                            .remedies = {{.action = RemedyAction::ChooseAgain}}});
}

std::vector<EditId> edits_of(const Recipe& recipe, const Snapshot& made,
                             const std::string& variant) {
    std::vector<EditId> left = edits_made(made), edits;
    for (const RecipeEntry& entry : recipe) {
        const auto found =
            std::ranges::find_if(left, [&](EditId id) { return does(id, made, entry, variant); });
        edits.push_back(found == left.end() ? 0 : *found);
        if (found != left.end()) left.erase(found);
    }
    return edits;
}

Recipe rest_of(const Recipe& recipe, const Snapshot& made, const std::string& variant) {
    const std::vector<EditId> edits = edits_of(recipe, made, variant);
    std::size_t behind_last = edits.size();
    while (behind_last > 0 && edits[behind_last - 1] == 0) --behind_last;
    std::vector<LogEntry> own = made.log;
    std::erase_if(own,
                  [&](const LogEntry& entry) { return !is_part_of(entry.edit.place, variant); });
    Recipe rest;
    for (std::size_t i = 0; i < recipe.size(); ++i) {
        const bool may_lack =
            recipe[i].optional || recipe[i].unless_closed || !recipe[i].unless_made.empty();
        const bool skipped = i < behind_last && may_lack &&
                             std::ranges::none_of(made.log, [&](const LogEntry& entry) {
                                 return has_place_of(entry.edit, recipe[i], variant);
                             });
        if (edits[i] == 0 && !skipped && !is_replaced(recipe[i], own)) rest.push_back(recipe[i]);
    }
    return rest;
}

std::vector<std::string> removed_entries(const Recipe& recipe, const Snapshot& made,
                                         const std::string& variant) {
    std::vector<std::string> names;
    const std::vector<EditId> ids = edits_made(made);
    for (const RecipeEntry& entry : recipe) {
        const std::string& name = entry.given.operation().name;
        const bool present = std::ranges::any_of(made.log, [&](const LogEntry& edit) {
            return has_place_of(edit.edit, entry, variant);
        });
        const bool was_made =
            std::ranges::any_of(ids, [&](EditId id) { return does(id, made, entry, variant); });
        if (!present && was_made && std::ranges::count(names, name) == 0) names.push_back(name);
    }
    return names;
}

void refuse_late_settings(std::span<const std::string> settings, const Recipe& rest,
                          const std::vector<LogEntry>& log) {
    for (const std::string& text : settings) {
        const std::string name = text.substr(0, text.find('.'));
        const bool comes = std::ranges::any_of(
            rest, [&](const RecipeEntry& entry) { return entry.given.operation().name == name; });
        if (comes) continue;
        Diagnostic made{.code = "set-too-late",
                        .operation = name,
                        .words = {{"setting", text}, {"name", name}}};
        for (const LogEntry& entry : log)
            if (entry.edit.operation == name) made.edit = entry.edit.edit.id;
        const std::size_t dot = text.find('.') + 1, equals = text.find('=', dot);
        if (made.edit && equals != std::string::npos)
            made.remedies = {
                {.arguments = {{text.substr(dot, equals - dot), text.substr(equals + 1)}}}};
        throw DiagnosedUsage(std::move(made));
    }
}

}  // namespace vesselbench
