#include "workbench/window/widgets/panel_frame.h"

#include <algorithm>

#include <imgui.h>
#include <imgui_internal.h>

namespace vesselbench {

namespace {

constexpr ImGuiWindowFlags kFixed = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize |
                                    ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoCollapse |
                                    ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoNav |
                                    ImGuiWindowFlags_NoBringToFrontOnFocus;
constexpr ImGuiWindowFlags kStill =
    ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse;

}  // namespace

void begin_frame(const Ui& ui, const std::string& name, const ScreenRect& rect,
                 const FrameLook& look) {
    const float padding = look.padding < 0 ? ui.grid(1.5F) : look.padding;
    ImGui::SetNextWindowPos({rect.x, rect.y});
    ImGui::SetNextWindowSize({std::max(1.0F, rect.width), std::max(1.0F, rect.height)});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {padding, padding});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, look.bordered ? 1.0F : 0.0F);
    ImGui::PushStyleColor(ImGuiCol_WindowBg, look.back == 0 ? ui.theme.panel : look.back);
    // A banner that appears while something is dragged must not take the drag's focus.
    const ImGuiWindowFlags calm = ImGui::IsAnyMouseDown() ? ImGuiWindowFlags_NoFocusOnAppearing : 0;
    ImGui::Begin(name.c_str(), nullptr, kFixed | calm | (look.scrolls ? 0 : kStill));
    // Once only: popups of this part come to the front later.
    if (look.floats && ImGui::IsWindowAppearing())
        ImGui::BringWindowToDisplayFront(ImGui::GetCurrentWindow());
    ImGui::PopStyleColor();
    ImGui::PopStyleVar(2);
}

void end_frame() {
    ImGui::End();
}

ScreenRect begin_dialog(const Ui& ui, const std::string& name, const ScreenRect& window,
                        float width, float height) {
    begin_frame(ui, name + ".shade", window,
                {.back = faded(paint(0x000000), ui.theme.dark ? 0.55 : 0.35),
                 .scrolls = false,
                 .floats = true});
    end_frame();
    const float wide = std::min(width, window.width - ui.grid(4));
    const float high = std::min(height, window.height - ui.grid(4));
    const ScreenRect rect{window.x + (window.width - wide) / 2,
                          window.y + (window.height - high) / 2, wide, high};
    begin_frame(ui, name, rect,
                {.padding = ui.grid(2.5F), .scrolls = false, .floats = true, .bordered = true});
    return rect;
}

}  // namespace vesselbench
