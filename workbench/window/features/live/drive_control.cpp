#include "workbench/window/features/live/drive_control.h"

#include <algorithm>

#include <imgui.h>

#include "workbench/window/case/readable.h"
#include "workbench/window/core/core.h"
#include "workbench/window/drawing/screen_places.h"
#include "workbench/window/features/live/live_feature.h"
#include "workbench/window/widgets/controls.h"
#include "workbench/window/widgets/ui.h"

namespace vesselbench {

namespace {

/// "sideways: Iterations 20, up and down: Lambda, Shift: Beta min"; values that are given
std::string movements(const DriveAxes& axes, const OperationForm& form) {
    std::string words;
    const auto add = [&](const char* how, const std::string& name) {
        if (name.empty()) return;
        words += (words.empty() ? "" : ", ") + (how + readable(name));
        const auto field = std::ranges::find_if(
            form.fields(), [&](const FormField& at) { return at.parameter->name == name; });
        if (field != form.fields().end() && !field->text.empty()) words += " " + field->text;
    };
    add("sideways: ", axes.across);
    add("up and down: ", axes.up);
    add("Shift: ", axes.shifted);
    return words;
}

}  // namespace

void DriveControl::begin(PanelContext& c) {
    c.core.get<LiveFeature>().begin_driving();
    if (!c.core.get<LiveFeature>().is_driving()) return;
    take_keyboard();  // a field that is typed in would keep its text, and Escape
    state_ = State::Driving;
    last_ = mouse_pixel();
    reach_ = {};
}

void DriveControl::follow(PanelContext& c) {
    const ViewPixel now = mouse_pixel(), by = now - last_;
    last_ = now;
    if (ImGui::GetIO().KeyShift) {
        reach_.shifted += by.x() - by.y();
    } else {
        reach_.across += by.x();
        reach_.up -= by.y();
    }
    // Also without a movement: what a parameter begins with may just have become known.
    c.core.get<LiveFeature>().drive(reach_);
}

void DriveControl::update(PanelContext& c, bool over) {
    if (state_ == State::Idle) {
        if (over && ImGui::IsMouseClicked(ImGuiMouseButton_Right)) begin(c);
        return;
    }
    if (state_ == State::Driving && !c.core.get<LiveFeature>().is_driving())
        state_ = State::Dropped;
    if (state_ == State::Driving) follow(c);
    if (ImGui::IsMouseDown(ImGuiMouseButton_Right)) return;
    if (state_ == State::Driving) c.core.end_drag();
    state_ = State::Idle;
}

void DriveControl::draw(const PanelContext& c, const ScreenRect& view, bool over) const {
    if (!c.core.form()) return;
    const std::string words = movements(c.core.get<LiveFeature>().live().axes(), *c.core.form());
    if (words.empty()) return;
    if (state_ == State::Driving)
        draw_hint(c.ui, view, words + "    Esc: restore");
    else if (over && c.core.get<LiveFeature>().can_drive() && !ImGui::IsAnyMouseDown())
        draw_hint(c.ui, view, "Hold the right button and move. " + words);
}

}  // namespace vesselbench
