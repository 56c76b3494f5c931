#include "workbench/window/panels/live_panel.h"

#include <imgui.h>

#include "workbench/window/case/readable.h"
#include "workbench/window/features/gallery/gallery_panel.h"
#include "workbench/window/features/quality/quality_graphs.h"
#include "workbench/window/widgets/controls.h"
#include "workbench/window/widgets/ui.h"
#include "workbench/window/workplace/workplace.h"

namespace vesselbench {

namespace {

constexpr const char* kNothing = "nothing";

/// A line's label, in the width that all of them have.
void begin_line(const PanelContext& c, const std::string& label) {
    const float left = ImGui::GetCursorPosX();
    const float wide = ImGui::GetContentRegionAvail().x * 0.4F;
    ImGui::AlignTextToFramePadding();
    text(c.ui, fitted(label, wide - c.ui.grid(1)), c.ui.theme.muted);
    ImGui::SameLine(left + wide);
}

/// \return true if another parameter was chosen
bool choose_axis(PanelContext& c, const OperationForm& form, const std::string& how,
                 std::string& axis) {
    std::vector<std::string> options = {kNothing};
    for (const std::string& name : driven_parameters(form)) options.push_back(readable(name));
    begin_line(c, how);
    std::string chosen = axis.empty() ? kNothing : readable(axis);
    if (!choice(c.ui, "live." + how, options, chosen)) return false;
    axis.clear();
    for (const std::string& name : driven_parameters(form))
        if (readable(name) == chosen) axis = name;
    return true;
}

void draw_mouse(PanelContext& c, const OperationForm& form) {
    group_heading(c.ui, "Right mouse button in the view");
    space(c.ui, 0.5F);
    DriveAxes axes = c.place.live().axes();
    bool changed = choose_axis(c, form, "Sideways", axes.across);
    changed = choose_axis(c, form, "Up and down", axes.up) || changed;
    changed = choose_axis(c, form, "With Shift", axes.shifted) || changed;
    if (changed) c.place.live().set_axes(axes);
}

}  // namespace

void draw_live_panel(PanelContext& c, const OperationForm& form) {
    const LiveSmoothing& live = c.place.live();
    if (!live.can_follow())
        return wrapped(c.ui, "The model cannot be updated: " + live.why_not(), c.ui.theme.warning);
    bool on = live.follows();
    if (checkbox(c.ui, "live.follow", "Update the model as fields change", on))
        c.place.live().follow(on);
    space(c.ui, 0.5F);
    draw_gallery_panel(c);
    space(c.ui, 1);
    draw_quality(c, form);
    space(c.ui, 1);
    draw_mouse(c, form);
}

void draw_quality_panel(PanelContext& c, const OperationForm& form) {
    const QualityAnalysis& quality = c.place.quality();
    if (!quality.can_analyse())
        return wrapped(c.ui, "There are no graphs: " + quality.why_not(), c.ui.theme.warning);
    draw_quality(c, form);
}

}  // namespace vesselbench
