#include "workbench/window/widgets/ui.h"

#include <algorithm>

#include <imgui.h>

namespace vesselbench {

void Ui::item(const std::string& name, bool enabled) {
    const ImVec2 window = ImGui::GetWindowPos(), size = ImGui::GetWindowSize();
    const ImVec2 from = ImGui::GetItemRectMin(), to = ImGui::GetItemRectMax();
    const float left = std::max(from.x, window.x), top = std::max(from.y, window.y);
    const float right = std::min(to.x, window.x + size.x);
    const float bottom = std::min(to.y, window.y + size.y);
    if (!ImGui::IsItemVisible() || right <= left || bottom <= top) return;
    item(name, ScreenRect{left, top, right - left, bottom - top}, enabled);
}

void Ui::item(const std::string& name, const ScreenRect& rect, bool enabled) {
    items_[name] = {rect, enabled};
}

void Ui::say(const std::string& name, const std::string& label) {
    if (const auto found = items_.find(name); found != items_.end()) found->second.label = label;
}

}  // namespace vesselbench
