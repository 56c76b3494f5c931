#include "workbench/session/known_results.h"

namespace vesselbench {

ResultId known_end(const std::vector<HistoryEntry>& line) {
    ResultId end = 0;
    for (const HistoryEntry& entry : line) {
        if (entry.status == EditStatus::Pending) return end;
        if (entry.status == EditStatus::Done) end = entry.result;
    }
    return end;
}

std::vector<ResultId> known_results(History history, const std::vector<StateId>& states,
                                    const std::string& variant) {
    std::vector<ResultId> results;
    for (const StateId state : states) {
        history.jump(state);
        results.push_back(known_end(history.line(variant)));
    }
    return results;
}

}  // namespace vesselbench
