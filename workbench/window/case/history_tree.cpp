#include "workbench/window/case/history_tree.h"

#include <map>
#include <set>

#include "workbench/case/argument_texts.h"
#include "workbench/report/log_json.h"
#include "workbench/window/case/local_time.h"
#include "workbench/window/case/rail.h"

namespace vesselbench {

namespace {

using Children = std::map<StateId, std::vector<StateId>>;

Children children_in(const History& history) {
    Children children;
    for (const auto& [id, state] : history.states())
        if (state.change != StateChange::Start) children[state.parent].push_back(id);
    return children;
}

std::set<StateId> path_to(const History& history, StateId id) {
    std::set<StateId> path = {id};
    while (history.state(id).change != StateChange::Start) {
        id = history.state(id).parent;
        path.insert(id);
    }
    return path;
}

std::string title_of(const HistoryState& state, const std::string& operation) {
    switch (state.change) {
        case StateChange::Start:
            return "empty case";
        case StateChange::Apply:
            return operation;
        case StateChange::Change:
            return "changed " + operation;
        case StateChange::Remove:
            return "removed " + operation;
    }
    return operation;
}

std::string operation_of(const Snapshot& snapshot, EditRef edit) {
    const auto found = snapshot.past->find(edit);
    return found == snapshot.past->end() ? "" : found->second.edit.operation;
}

HistoryRow row_of(const Snapshot& snapshot, const HistoryState& state) {
    HistoryRow row{.state = state.id,
                   .current = state.id == snapshot.history->current(),
                   .title = title_of(state, operation_of(snapshot, state.edit))};
    const auto found = snapshot.past->find(state.edit);
    if (found == snapshot.past->end()) return row;
    const EditRecord& edit = found->second.edit;
    row.arguments = arguments_text(edit);
    row.note = edit.note;
    row.edit = state.edit;
    // A removal runs nothing: author, time and figures are those of the edit that it leaves out.
    if (state.change == StateChange::Remove) return row;
    row.author = edit.author;
    row.time = local_time(edit.time, "%Y-%m-%d %H:%M");
    if (found->second.first) row.change = effect_text(*found->second.first);
    return row;
}

/// A state that is still to be listed.
struct Waiting {
    StateId state;
    int column;
    int parent_row;
};

/// The first child continues its parent's column; each other one begins a new column.
std::vector<HistoryRow> rows_of(const Snapshot& snapshot, int& columns) {
    const Children children = children_in(*snapshot.history);
    const std::set<StateId> path = path_to(*snapshot.history, snapshot.history->current());
    std::vector<HistoryRow> rows;
    std::vector<Waiting> waiting = {{0, 0, -1}};
    while (!waiting.empty()) {
        const Waiting next = waiting.back();
        waiting.pop_back();
        rows.push_back(row_of(snapshot, snapshot.history->state(next.state)));
        HistoryRow& row = rows.back();
        row.column = next.column < 0 ? columns++ : next.column;
        row.parent_row = next.parent_row;
        row.on_path = path.contains(next.state);
        const auto found = children.find(next.state);
        if (found == children.end()) continue;
        const int here = static_cast<int>(rows.size()) - 1;
        const auto& all = found->second;
        for (std::size_t i = 0; i < all.size(); ++i)
            waiting.push_back({all[i], i == 0 ? row.column : -1, here});
    }
    return rows;
}

}  // namespace

HistoryTree history_tree(const Snapshot& snapshot) {
    const History& history = *snapshot.history;
    HistoryTree tree;
    tree.rows = rows_of(snapshot, tree.columns);
    const HistoryState& now = history.state(history.current());
    tree.can_undo = now.change != StateChange::Start;
    tree.can_redo = now.last_child != 0;
    if (tree.can_undo) tree.undo_title = title_of(now, operation_of(snapshot, now.edit));
    if (tree.can_redo) {
        const HistoryState& next = history.state(now.last_child);
        tree.redo_title = title_of(next, operation_of(snapshot, next.edit));
    }
    return tree;
}

}  // namespace vesselbench
