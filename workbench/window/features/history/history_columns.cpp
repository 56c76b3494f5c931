#include "workbench/window/features/history/history_columns.h"

#include <algorithm>

namespace vesselbench {

namespace {

// [em]
constexpr float kName = 11.0F;  ///< "changed correct narrowing"
constexpr float kTime = 8.5F;   ///< "2024-05-17 09:30"
constexpr float kAuthor = 6.0F;
constexpr float kLeastChange = 9.0F;  ///< "volume -2.1 %, mo..."

constexpr float kChangeShare = 0.58F;  ///< of what author and time leave, where there is room

}  // namespace

HistoryColumns history_columns(float room) {
    HistoryColumns columns;
    if (room < kName + kTime) return {.name = room};
    columns.time = kTime;
    float rest = room - kTime;
    if (rest >= kName + kLeastChange + kAuthor) {
        columns.author = kAuthor;
        rest -= kAuthor;
    }
    if (rest >= kName + kLeastChange)
        columns.change = std::clamp(kChangeShare * rest, kLeastChange, rest - kName);
    columns.name = rest - columns.change;
    return columns;
}

}  // namespace vesselbench
