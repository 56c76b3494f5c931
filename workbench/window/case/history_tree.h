#pragma once

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
    EditRef edit;        ///< the revision that was applied or changed; id 0: none
    std::string change;  ///< of its run in this state: "volume -2.1 %, moved up to 0.31 mm"
    std::string author;  ///< empty for a removal, as its change and time
    std::string time;    ///< local, "2024-05-17 09:30"
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

}  // namespace vesselbench
