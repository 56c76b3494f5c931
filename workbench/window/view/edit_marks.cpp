#include "workbench/window/view/edit_marks.h"

#include "workbench/window/case/readable.h"
#include "workbench/window/widgets/ui.h"
#include "workbench/window/workplace/workplace.h"

namespace vesselbench {

namespace {

constexpr float kReach = 0.8F;  ///< a cursor so near to a place points at its edit [em]

/// The edit whose place is nearest to the cursor.
std::optional<EditId> edit_at(const PanelContext& c, const PixelView& screen,
                              const ViewPixel& cursor) {
    double reach = kReach * c.ui.em;
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

void draw_marks(PanelContext& c, const PixelView& screen, const RailEdit& edit) {
    std::string label = readable(edit.operation);
    for (const Vec3& place : edit.places) {
        const auto at = screen.place(place);
        if (!at) continue;
        draw_mark(c.ui, *at, MarkLook::Lit, label);
        c.ui.item("view.edit." + std::to_string(edit.id), spot_rect(*at));
        label.clear();
    }
}

}  // namespace

void draw_edit_marks(PanelContext& c, const PixelView& screen, bool over) {
    if (over)
        if (const auto edit = edit_at(c, screen, mouse_pixel())) c.place.point_at_edit(*edit);
    for (const RailStep& step : c.place.rail())
        for (const RailEdit& edit : step.edits)
            if (c.place.pointed_edit() == edit.id) draw_marks(c, screen, edit);
    if (!c.place.looked_at()) return;
    if (const auto at = screen.place(*c.place.looked_at())) {
        draw_mark(c.ui, *at, MarkLook::Lit, "here");
        c.ui.item("view.looked_at", spot_rect(*at));
    }
}

}  // namespace vesselbench
