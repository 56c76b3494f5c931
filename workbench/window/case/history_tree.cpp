#include "workbench/window/case/history_tree.h"

#include <map>
#include <set>
#include <utility>

#include "workbench/report/log_json.h"
#include "workbench/window/case/local_time.h"
#include "workbench/window/case/rail.h"
#include "workbench/window/case/readable.h"

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
    row.variant = readable_variant(edit.place.variant);
    if (state.change == StateChange::Apply && makes_strokes(edit.operation))
        row.brush = edit.operation;
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

/// By row: the number of states that come from it.
std::vector<int> children_of(const HistoryTree& tree) {
    std::vector<int> children(tree.rows.size(), 0);
    for (const HistoryRow& row : tree.rows)
        if (row.parent_row >= 0) ++children[static_cast<std::size_t>(row.parent_row)];
    return children;
}

/// True if a row is one more stroke of the row before it.
bool continues(const HistoryTree& tree, std::size_t row, const std::vector<int>& children) {
    if (row == 0) return false;
    const HistoryRow &here = tree.rows[row], &before = tree.rows[row - 1];
    return !here.brush.empty() && here.brush == before.brush && here.variant == before.variant &&
           here.parent_row == static_cast<int>(row) - 1 && children[row - 1] == 1 &&
           here.note.empty() && before.note.empty() && !before.current;
}

}  // namespace

HistoryTree folded(const HistoryTree& tree, const std::set<StateId>& unfolded) {
    const std::vector<int> children = children_of(tree);
    HistoryTree shown = tree;
    shown.rows.clear();
    std::vector<int> places;  // of the tree's rows among the shown ones
    StateId first = 0;        // of the strokes at hand
    for (std::size_t i = 0; i < tree.rows.size(); ++i) {
        HistoryRow row = tree.rows[i];
        const bool same = continues(tree, i, children);
        if (!same) first = row.state;
        const bool one_by_one = unfolded.contains(first);
        const bool more = i + 1 < tree.rows.size() && continues(tree, i + 1, children);
        row.fold = same || more ? first : 0;
        if (same && !one_by_one) {
            row.strokes = shown.rows.back().strokes + 1;
            row.parent_row = shown.rows.back().parent_row;
            shown.rows.back() = std::move(row);
        } else {
            if (row.parent_row >= 0)
                row.parent_row = places[static_cast<std::size_t>(row.parent_row)];
            shown.rows.push_back(std::move(row));
        }
        places.push_back(static_cast<int>(shown.rows.size()) - 1);
    }
    return shown;
}

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
