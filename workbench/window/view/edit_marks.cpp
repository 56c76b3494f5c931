#include "workbench/window/view/edit_marks.h"

#include <imgui.h>

#include "workbench/window/model/readable.h"

namespace vesselbench {

namespace {

constexpr float kReach = 0.8F;  ///< a cursor so near to a place points at its edit [em]

/// The edit whose place is nearest to the cursor.
std::optional<EditId> edit_at(const PanelContext& c, const OnScreen& screen,
                              const Eigen::Vector2f& cursor) {
    float reach = kReach * c.ui.em;
    std::optional<EditId> nearest;
    for (const RailStep& step : c.place.rail())
        for (const RailEdit& edit : step.edits)
            for (const Vec3& place : edit.places) {
                const auto at = screen.place(place);
                if (!at || (*at - cursor).norm() > reach) continue;
                reach = (*at - cursor).norm();
                nearest = edit.id;
            }
    return nearest;
}

void draw_marks(PanelContext& c, const OnScreen& screen, const RailEdit& edit) {
    std::string label = readable(edit.operation);
    for (const Vec3& place : edit.places) {
        const auto at = screen.place(place);
        if (!at) continue;
        draw_mark(c.ui, *at, MarkLook::Lit, label);
        c.ui.item("view.edit." + std::to_string(edit.id), ScreenRect{at->x(), at->y(), 1, 1});
        label.clear();
    }
}

}  // namespace

void draw_edit_marks(PanelContext& c, const OnScreen& screen, bool over) {
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    if (over)
        if (const auto edit = edit_at(c, screen, {mouse.x, mouse.y})) c.place.point_at_edit(*edit);
    for (const RailStep& step : c.place.rail())
        for (const RailEdit& edit : step.edits)
            if (c.place.pointed_edit() == edit.id) draw_marks(c, screen, edit);
    if (!c.place.looked_at()) return;
    if (const auto at = screen.place(*c.place.looked_at())) {
        draw_mark(c.ui, *at, MarkLook::Lit, "here");
        c.ui.item("view.looked_at", ScreenRect{at->x(), at->y(), 1, 1});
    }
}

}  // namespace vesselbench
