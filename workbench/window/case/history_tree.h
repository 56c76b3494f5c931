#pragma once

#include <cstddef>
#include <set>
#include <string>
#include <vector>

#include "workbench/session/snapshot.h"

namespace vesselbench {

/// A state of the history as a row of a list; rows are in the order of the tree, parents first.
struct HistoryRow {
    StateId state = 0;
    int column = 0;       ///< branch: 0 for the line of the first children
    int parent_row = -1;  ///< index of the parent's row; -1: none
    bool current = false;
    bool on_path = false;  ///< the current state comes from it, or it is it
    std::string title;     ///< "smooth", "changed smooth", "removed smooth", "empty case"
    std::string arguments;
    std::string note;
    EditRef edit;         ///< the revision that was applied or changed; id 0: none
    std::string change;   ///< of its run in this state: "volume -2.1 %, moved up to 0.31 mm"
    std::string author;   ///< empty for a removal, as its change and time
    std::string time;     ///< local, "2024-05-17 09:30"
    std::string variant;  ///< "printing": whose model it changes; empty: of all
    std::string brush;    ///< the operation, if it is a stroke of a brush; else empty
    StateId fold = 0;     ///< first state of the strokes that it belongs to; 0: they are not folded
    std::size_t strokes = 1;  ///< that the row stands for
};

struct HistoryTree {
    std::vector<HistoryRow> rows;
    int columns = 1;
    bool can_undo = false;
    bool can_redo = false;
    std::string undo_title;  ///< "smooth": what undo takes back
    std::string redo_title;
};

[[nodiscard]] HistoryTree history_tree(const Snapshot& snapshot);

/// The same with strokes of one brush that follow one another in one row, the last one's. Strokes
/// with a note, those at which the history branches and what follows the current one stay rows of
/// their own.
/// \param unfolded first states of strokes that are listed one by one
[[nodiscard]] HistoryTree folded(const HistoryTree& tree, const std::set<StateId>& unfolded);

}  // namespace vesselbench
