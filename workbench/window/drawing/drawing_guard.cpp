#include "workbench/window/drawing/drawing_guard.h"

#include <utility>

namespace vesselbench {

void DrawingGuard::note(const std::string& problem) {
    if (!problem.empty()) problems_.insert(problem);
}

void DrawingGuard::report(Document& document) {
    if (std::exchange(case_, document.opened()) != document.opened()) reported_.clear();
    for (const std::string& problem : std::exchange(problems_, {}))
        if (reported_.insert(problem).second)
            document.tell(make_message(MessageKind::Error, "not all can be drawn: " + problem));
}

}  // namespace vesselbench
