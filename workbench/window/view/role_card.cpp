#include "workbench/window/view/role_card.h"

#include <algorithm>

#include <imgui.h>

#include "workbench/window/style/icons.h"
#include "workbench/window/widgets/controls.h"

namespace vesselbench {

namespace {

constexpr float kWidth = 23.0F;  ///< [em]
constexpr float kBeside = 1.5F;  ///< distance from the opening's middle [em]

/// Beside a place, and within the view.
ImVec2 corner_beside(const Ui& ui, const ScreenRect& view, const ViewPixel& at,
                     const ImVec2& size) {
    const float most_x = view.x + view.width - size.x - ui.grid(1);
    const float most_y = view.y + view.height - size.y - ui.grid(1);
    const float x = static_cast<float>(at.x()) + kBeside * ui.em;
    const float y = static_cast<float>(at.y()) - size.y / 2;
    return {std::clamp(x, view.x + ui.grid(1), std::max(view.x, most_x)),
            std::clamp(y, view.y + ui.grid(1), std::max(view.y, most_y))};
}

void draw_back(const Ui& ui, ImVec2 at, ImVec2 size) {
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const float rounding = ImGui::GetStyle().FrameRounding;
    const ImVec2 to{at.x + size.x, at.y + size.y};
    draw.AddRectFilled(at, to, faded(ui.theme.panel, 0.96), rounding);
    draw.AddRect(at, to, ui.theme.border, rounding);
}

bool role_button(Ui& ui, const PatchMeasures& opening, PatchKind role, const std::string& label,
                 float width) {
    return button(ui, "role." + to_string(role), label,
                  {.primary = opening.kind != role,
                   .enabled = opening.kind != role,
                   .width = width,
                   .help = "Fill in Clip opening so that this opening gets this role"});
}

}  // namespace

void draw_role_card(PanelContext& c, const PixelView& screen) {
    const auto& asked = c.place.role_question();
    if (!asked) return;
    const PatchMeasures opening = *asked;
    const auto at = screen.place(opening.centroid);
    if (!at) return;
    const float pad = c.ui.grid(1), line = ImGui::GetFrameHeight();
    const ImVec2 size{kWidth * c.ui.em, 2 * line + 3 * pad};
    const ImVec2 corner = corner_beside(c.ui, rect_of(screen), *at, size);
    draw_back(c.ui, corner, size);
    ImGui::SetCursorScreenPos({corner.x + pad, corner.y + pad});
    ImGui::AlignTextToFramePadding();
    clipped_text(c.ui, opening_text(opening), c.ui.theme.text, size.x - 3 * pad - line);
    ImGui::SetCursorScreenPos({corner.x + size.x - pad - line, corner.y + pad});
    if (icon_button(c.ui, "role.close", icons::kClose, "Keep the role  Esc"))
        return c.place.forget_role_question();
    const float wide = (size.x - 3 * pad) / 2;
    ImGui::SetCursorScreenPos({corner.x + pad, corner.y + 2 * pad + line});
    if (role_button(c.ui, opening, PatchKind::Inlet, "Inlet", wide))
        return c.place.give_role(PatchKind::Inlet);
    ImGui::SameLine(0, pad);
    if (role_button(c.ui, opening, PatchKind::Outlet, "Outlet", wide))
        c.place.give_role(PatchKind::Outlet);
}

}  // namespace vesselbench
