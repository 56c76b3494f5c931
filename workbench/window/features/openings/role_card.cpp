#include "workbench/window/features/openings/role_card.h"

#include <optional>

#include <imgui.h>

#include "workbench/window/core/core.h"
#include "workbench/window/drawing/card.h"
#include "workbench/window/features/openings/openings_feature.h"
#include "workbench/window/style/icons.h"
#include "workbench/window/widgets/controls.h"
#include "workbench/window/widgets/ui.h"

namespace vesselbench {

namespace {

constexpr float kWidth = 23.0F;  ///< [em]

bool role_button(Ui& ui, const PatchMeasures& opening, PatchKind role, const std::string& label,
                 float width) {
    return button(ui, "role." + to_string(role), label,
                  {.primary = opening.kind == role,
                   .width = width,
                   .help = opening.kind == role
                               ? "Its role now: keep it"
                               : "Fill in Clip opening so that this opening gets this role"});
}

}  // namespace

void draw_role_card(PanelContext& c, const PixelView& screen) {
    const auto& asked = c.core.get<OpeningsFeature>().role_question();
    if (!asked) return;
    const PatchMeasures opening = *asked;
    const auto at = screen.place(opening.centroid);
    if (!at) return;
    const float pad = c.ui.grid(1), line = ImGui::GetFrameHeight();
    const ScreenRect card = draw_card(c.ui, rect_of(screen), *at, kWidth, 2);
    ImGui::AlignTextToFramePadding();
    clipped_text(c.ui, opening_text(opening), c.ui.theme.text, card.width - 3 * pad - line);
    ImGui::SetCursorScreenPos({card.x + card.width - pad - line, card.y + pad});
    if (icon_button(c.ui, "role.close", icons::kClose, "Keep the role  Esc"))
        return c.core.get<OpeningsFeature>().forget_role_question();
    const float wide = (card.width - 3 * pad) / 2;
    ImGui::SetCursorScreenPos({card.x + pad, card.y + 2 * pad + line});
    std::optional<PatchKind> chosen;
    if (role_button(c.ui, opening, PatchKind::Inlet, "Inlet", wide)) chosen = PatchKind::Inlet;
    ImGui::SameLine(0, pad);
    if (role_button(c.ui, opening, PatchKind::Outlet, "Outlet", wide)) chosen = PatchKind::Outlet;
    if (!chosen) return;
    if (*chosen == opening.kind) return c.core.get<OpeningsFeature>().forget_role_question();
    c.core.get<OpeningsFeature>().give_role(*chosen);
}

}  // namespace vesselbench
