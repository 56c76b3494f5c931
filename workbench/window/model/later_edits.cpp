#include "workbench/window/model/later_edits.h"

#include <algorithm>

namespace vesselbench {

const HistoryEntry* edit_behind(const std::vector<HistoryEntry>& line, Step step) {
    const auto found = std::ranges::find_if(
        line, [&](const HistoryEntry& entry) { return entry.place.step > step; });
    return found == line.end() ? nullptr : &*found;
}

}  // namespace vesselbench
