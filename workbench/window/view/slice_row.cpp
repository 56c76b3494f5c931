#include "workbench/window/view/slice_row.h"

#include <cmath>
#include <cstdlib>

#include <imgui.h>

#include "geometry/kernel/wording.h"
#include "workbench/window/panels/panel_frame.h"
#include "workbench/window/style/icons.h"
#include "workbench/window/widgets/controls.h"

namespace vesselbench {

namespace {

constexpr float kShare = 0.52F;  ///< of the view's height
constexpr float kField = 4.6F;   ///< width of a number [em]

std::string place_words(const Vec3& point) {
    std::string words;
    for (int axis = 0; axis < 3; ++axis) {
        const std::string text = position_text(axis, point[axis]);
        words += (axis > 0 ? ", " : "") + text.substr(0, text.find(" mm"));
    }
    return words + " mm";
}

/// "L 1.0, P 2.0, S 3.0 mm: 103, label 2"
std::string pointed_words(const ImageSlices& slices, const Vec3& point) {
    const auto value = slices.value_at(point);
    if (!value) return "";
    const auto label = slices.label_at(point);
    std::string words = place_words(point) + ":  ";
    if (!slices.shows_labels()) words += formatted(*value, "%.5g");
    if (slices.has_mask() && label) words += ", ";
    if (label) words += "label " + std::to_string(*label);
    if (slices.shows_labels() && !label) words += "no label";
    return words;
}

void toggle(PanelContext& c, const std::string& name, const char* icon, const std::string& help,
            bool& on) {
    if (icon_button(c.ui, name, icon, help, true, on)) on = !on;
}

}  // namespace

ScreenRect slice_row_rect(const ScreenRect& view) {
    const float height = std::round(view.height * kShare);
    return {view.x, view.y + view.height - height, view.width, height};
}

std::optional<double> SliceRow::edit(PanelContext& c, const std::string& name, Typed& number,
                                     double value) {
    if (!number.typing) number.text = formatted(value, "%.4g");
    const bool changed = text_field(c.ui, name, number.text, {.width = c.ui.em * kField});
    number.typing = ImGui::IsItemActive();
    if (!changed) return std::nullopt;
    char* end = nullptr;
    const double typed = std::strtod(number.text.c_str(), &end);
    const bool whole = end != number.text.c_str() && *end == '\0';
    return whole ? std::optional(typed) : std::nullopt;
}

void SliceRow::draw_grey(PanelContext& c) {
    ImageSlices& slices = c.place.slices();
    const GreyWindow grey = slices.grey();
    ImGui::AlignTextToFramePadding();
    text(c.ui, "Window", c.ui.theme.muted);
    help_on_hover(c.ui, "Values from black to white; drag with the right button in a slice");
    ImGui::SameLine();
    if (const auto window = edit(c, "slices.window", window_, grey.window))
        slices.set_grey({*window, grey.level});
    ImGui::SameLine();
    text(c.ui, "Level", c.ui.theme.muted);
    help_on_hover(c.ui, "The value in the middle of the window");
    ImGui::SameLine();
    if (const auto level = edit(c, "slices.level", level_, grey.level))
        slices.set_grey({grey.window, *level});
    ImGui::SameLine();
    if (button(c.ui, "slices.auto", "Auto", {.help = "From the image's values"}))
        slices.reset_grey();
}

void SliceRow::draw_toggles(PanelContext& c) const {
    ImageSlices& slices = c.place.slices();
    ImGui::SameLine(0, c.ui.grid(2));
    toggle(c, "slices.outline", icons::kVessel, "The surface's outline", slices.outline_shown);
    if (!slices.has_mask()) return;
    ImGui::SameLine(0, c.ui.grid(0.25F));
    toggle(c, "slices.mask", icons::kPalette, "The mask in colour", slices.mask_shown);
}

/// The place under the cursor, right-aligned.
void SliceRow::draw_pointed(PanelContext& c, float right) const {
    std::string words;
    for (const SlicePane& pane : panes_)
        if (pane.pointed()) words = pointed_words(c.place.slices(), *pane.pointed());
    if (words.empty()) return;
    ImGui::SameLine();
    ImGui::PushFont(c.ui.fonts.small);
    const float room = right - ImGui::GetCursorScreenPos().x;
    const std::string shown = fitted(words, room);
    ImGui::SetCursorScreenPos({right - ImGui::CalcTextSize(shown.c_str()).x,
                               ImGui::GetCursorScreenPos().y + c.ui.em * 0.07F});
    text(c.ui, shown, c.ui.theme.text);
    ImGui::PopFont();
}

void SliceRow::draw_header(PanelContext& c, const ScreenRect& rect) {
    const float pad = c.ui.grid(0.5F), side = ImGui::GetFrameHeight();
    begin_frame(c.ui, "slices", rect, {.padding = pad, .scrolls = false});
    ImGui::SetCursorPosX(c.ui.grid(1));
    if (c.place.slices().shows_labels()) {
        ImGui::AlignTextToFramePadding();
        text(c.ui, "Labels", c.ui.theme.muted);
    } else {
        draw_grey(c);
    }
    draw_toggles(c);
    const float right = rect.x + rect.width - pad - side;
    draw_pointed(c, right - c.ui.grid(1));
    ImGui::SetCursorScreenPos({right, rect.y + pad});
    if (icon_button(c.ui, "slices.close", icons::kClose, "Close the slices  I"))
        c.place.slices().show_row(false);
    end_frame();
}

void SliceRow::draw(PanelContext& c, const PaneSource& source, const ScreenRect& rect) {
    const float head = ImGui::GetFrameHeight() + c.ui.grid(1), line = 1.0F;
    const auto count = static_cast<float>(panes_.size());
    const float wide = std::floor((rect.width - (count - 1) * line) / count);
    draw_header(c, {rect.x, rect.y, rect.width, head});
    float left = rect.x;
    for (SlicePane& pane : panes_) {
        const float right = &pane == &panes_.back() ? rect.x + rect.width : left + wide;
        pane.draw(c, source, {left, rect.y + head + line, right - left, rect.height - head - line});
        left = right + line;
    }
}

}  // namespace vesselbench
