#pragma once

namespace vesselbench {

/// Widths of the history's columns from left to right [em]; 0: left out.
struct HistoryColumns {
    float name = 0;    ///< of the state, and after it, where there is room, note and arguments
    float change = 0;  ///< figures of its run
    float author = 0;
    float time = 0;
};

/// Shares a row out. As it narrows, note and arguments give way, then the figures are cut, and
/// author, figures and time left out in this order; the name is cut last.
/// \param room of the row's texts, >= 0 [em]
[[nodiscard]] HistoryColumns history_columns(float room);

}  // namespace vesselbench
