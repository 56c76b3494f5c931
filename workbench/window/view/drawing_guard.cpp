#include "workbench/window/view/drawing_guard.h"

#include <utility>

namespace vesselbench {

void DrawingGuard::tell(Document& document) {
    const std::string now = std::exchange(problem_, {});
    if (now.empty() || now == told_) return;
    told_ = now;
    document.tell(make_message(MessageKind::Error, "not all can be drawn: " + now));
}

}  // namespace vesselbench
