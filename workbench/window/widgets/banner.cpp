#include "workbench/window/widgets/banner.h"

#include <imgui.h>

#include "workbench/window/style/icons.h"
#include "workbench/window/widgets/controls.h"
#include "workbench/window/widgets/panel_frame.h"

namespace vesselbench {

namespace {

/// What a banner's buttons take at its end.
float width_of_buttons(const Ui& ui, const Banner& banner) {
    const float action =
        banner.action.empty() ? 0 : ImGui::CalcTextSize(banner.action.c_str()).x + ui.grid(4);
    return action + (banner.can_close ? ImGui::GetFrameHeight() + ui.grid(1) : 0);
}

/// What is left of a banner's width for its text.
float room_for_text(const Ui& ui, const Banner& banner, float width) {
    const float icon = ImGui::CalcTextSize(banner.icon).x + ImGui::GetStyle().ItemSpacing.x;
    return width - 2 * ui.grid(1) - icon - width_of_buttons(ui, banner);
}

}  // namespace

float width_of(const Ui& ui, const Banner& banner) {
    constexpr float kRounding = 1;  // [pixels]
    return ImGui::CalcTextSize(banner.text.c_str()).x - room_for_text(ui, banner, 0) + kRounding;
}

float height_of(const Ui& ui, const Banner& banner, float width) {
    const ImGuiStyle& style = ImGui::GetStyle();
    const float room = room_for_text(ui, banner, width);
    const std::string lines = broken(banner.text, room);
    const float text = ImGui::CalcTextSize(lines.c_str(), nullptr, false, room).y;
    return text + 2 * style.FramePadding.y + 2 * ui.grid(1);
}

BannerAnswer draw_banner(Ui& ui, const std::string& name, const Banner& banner,
                         const ScreenRect& rect) {
    begin_frame(ui, "banner." + name, rect,
                {.back = ui.theme.raised,
                 .padding = ui.grid(1),
                 .scrolls = false,
                 .floats = true,
                 .bordered = true});
    ImGui::AlignTextToFramePadding();
    text(ui, banner.icon, banner.colour);
    ImGui::SameLine();
    const float end = rect.width - ui.grid(1) - width_of_buttons(ui, banner);
    ImGui::PushTextWrapPos(end);
    text(ui, broken(banner.text, end - ImGui::GetCursorPosX()), ui.theme.text);
    ImGui::PopTextWrapPos();
    BannerAnswer answer = BannerAnswer::None;
    ImGui::SetCursorPos({end + ui.grid(1), ui.grid(1)});
    if (!banner.action.empty() &&
        button(ui, "banner." + name + ".action", banner.action, {.primary = banner.is_next}))
        answer = BannerAnswer::Action;
    ImGui::SetCursorPos({rect.width - ui.grid(1) - ImGui::GetFrameHeight(), ui.grid(1)});
    if (banner.can_close && icon_button(ui, "banner." + name + ".close", icons::kClose, "Close"))
        answer = BannerAnswer::Close;
    end_frame();
    return answer;
}

}  // namespace vesselbench
