#include "workbench/window/features/slices/slice_row.h"

#include <algorithm>
#include <cmath>

#include <imgui.h>

#include "geometry/kernel/wording.h"
#include "workbench/window/case/readable.h"
#include "workbench/window/core/core.h"
#include "workbench/window/core/shown.h"
#include "workbench/window/features/slices/slices_feature.h"
#include "workbench/window/style/icons.h"
#include "workbench/window/widgets/controls.h"
#include "workbench/window/widgets/panel_frame.h"
#include "workbench/window/widgets/ui.h"

namespace vesselbench {

namespace {

constexpr float kField = 4.6F;   ///< width of a number [em]
constexpr float kWide = 36.0F;   ///< a narrower row has no words before its fields [em]
constexpr float kLeast = 24.0F;  ///< a narrower one has no fields: the mouse sets them [em]

std::string place_words(const Vec3& point) {
    std::string words;
    for (int axis = 0; axis < 3; ++axis) {
        const std::string text = position_text(axis, point[axis]);
        words += (axis > 0 ? ", " : "") + text.substr(0, text.find(" mm"));
    }
    return words + " mm";
}

/// "103, label 2"
std::string value_words(const ImageSlices& slices, const Vec3& point) {
    const auto value = slices.value_at(point);
    if (!value) return "";
    const auto label = slices.label_at(point);
    std::string words;
    if (!slices.shows_labels()) words += formatted(*value, "%.5g");
    if (slices.has_mask() && label) words += ", ";
    if (label) words += "label " + std::to_string(*label);
    if (slices.shows_labels() && !label) words += "no label";
    return words;
}

/// The name of a field, for which there may be no room.
void label(const PanelContext& c, const std::string& words, bool narrow) {
    if (narrow) return;
    ImGui::AlignTextToFramePadding();
    text(c.ui, words, c.ui.theme.muted);
    ImGui::SameLine();
}

void toggle(PanelContext& c, const std::string& name, const char* icon, const std::string& help,
            bool& on) {
    if (icon_button(c.ui, name, icon, help, true, on)) on = !on;
}

}  // namespace

std::optional<double> SliceRow::edit(PanelContext& c, const std::string& name, Typed& number,
                                     double value) {
    if (!number.typing) number.text = formatted(value, "%.4g");
    const bool changed = text_field(c.ui, name, number.text, {.width = c.ui.em * kField});
    number.typing = ImGui::IsItemActive();
    return changed ? typed_number(number.text) : std::nullopt;
}

void SliceRow::draw_grey(PanelContext& c, float room) {
    ImageSlices& slices = c.core.get<SlicesFeature>().slices();
    if (room > c.ui.em * kLeast) draw_grey_fields(c, room);
    const std::string help = "Window and level from the image's values";
    if (room < c.ui.em * kWide ? icon_button(c.ui, "slices.auto", icons::kRefresh, help)
                               : button(c.ui, "slices.auto", "Auto", {.help = help}))
        slices.reset_grey();
}

void SliceRow::draw_grey_fields(PanelContext& c, float room) {
    ImageSlices& slices = c.core.get<SlicesFeature>().slices();
    const GreyWindow grey = slices.grey();
    const bool narrow = room < c.ui.em * kWide;
    label(c, "Window", narrow);
    if (const auto window = edit(c, "slices.window", window_, grey.window))
        slices.set_grey({*window, grey.level});
    help_on_hover(c.ui,
                  "Window: values from black to white. Drag with the right button in a slice");
    ImGui::SameLine();
    label(c, "Level", narrow);
    if (const auto level = edit(c, "slices.level", level_, grey.level))
        slices.set_grey({grey.window, *level});
    help_on_hover(c.ui, "Level: the value in the middle of the window");
    ImGui::SameLine();
}

void SliceRow::draw_toggles(PanelContext& c) const {
    ImageSlices& slices = c.core.get<SlicesFeature>().slices();
    ImGui::SameLine(0, c.ui.grid(2));
    toggle(c, "slices.outline", icons::kVessel, "The surface's outline", slices.outline_shown);
    if (!slices.has_mask()) return;
    ImGui::SameLine(0, c.ui.grid(0.25F));
    toggle(c, "slices.mask", icons::kPalette, "The mask in colour", slices.mask_shown);
}

/// The place and the value under the cursor, right-aligned; the value alone, or nothing, where
/// there is no room.
void SliceRow::draw_pointed(PanelContext& c, float right) const {
    const auto pane =
        std::ranges::find_if(panes_, [](const SlicePane& p) { return p.pointed().has_value(); });
    if (pane == panes_.end()) return;
    const Vec3 point = *pane->pointed();
    const std::string value = value_words(c.core.get<SlicesFeature>().slices(), point);
    if (value.empty()) return;
    ImGui::SameLine();
    ImGui::PushFont(c.ui.fonts.small);
    const float room = right - ImGui::GetCursorScreenPos().x;
    std::string words = place_words(point) + ":  " + value;
    if (ImGui::CalcTextSize(words.c_str()).x > room) words = value;
    const float wide = ImGui::CalcTextSize(words.c_str()).x;
    ImGui::SetCursorScreenPos({right - wide, ImGui::GetCursorScreenPos().y + c.ui.em * 0.07F});
    if (wide <= room) text(c.ui, words, c.ui.theme.text);
    ImGui::PopFont();
}

void SliceRow::draw_header(PanelContext& c, const ScreenRect& rect) {
    const float pad = c.ui.grid(0.5F), side = ImGui::GetFrameHeight();
    begin_frame(c.ui, "slices", rect, {.padding = pad, .scrolls = false});
    ImGui::SetCursorPosX(c.ui.grid(1));
    if (c.core.get<SlicesFeature>().slices().shows_labels()) {
        ImGui::AlignTextToFramePadding();
        text(c.ui, "Labels", c.ui.theme.muted);
    } else {
        draw_grey(c, rect.width);
    }
    draw_toggles(c);
    const float right = rect.x + rect.width - pad - side, before = right - side - pad;
    draw_pointed(c, before - c.ui.grid(1));
    ImGui::SetCursorScreenPos({before, rect.y + pad});
    PanelSizes& panels = c.core.settings.panels;
    toggle(c, "slices.quarters", icons::kGrid, "The model and the slices in two rows of two",
           panels.quarters);
    if (ImGui::IsItemDeactivated()) c.core.settings.save_soon();
    ImGui::SetCursorScreenPos({right, rect.y + pad});
    if (icon_button(c.ui, "slices.close", icons::kClose, "Close the slices  I"))
        c.core.get<SlicesFeature>().slices().show_row(false);
    end_frame();
}

/// The panes that are seen below the header, from left to right.
std::vector<SlicePane*> SliceRow::panes_below(const PanelContext& c, const ViewParts& parts) {
    for (SlicePane& pane : panes_)
        if (enlarged_as(pane.plane()) == c.shown.enlarged) return {&pane};
    std::vector<SlicePane*> row;
    for (SlicePane& pane : panes_)
        if (!parts.beside || &pane != &panes_.front()) row.push_back(&pane);
    return row;
}

void SliceRow::draw(PanelContext& c, const PaneSource& source, const ViewParts& parts) {
    const float head = ImGui::GetFrameHeight() + c.ui.grid(1), line = 1.0F;
    const ScreenRect& rect = parts.slices;
    draw_header(c, {rect.x, rect.y, rect.width, head});
    if (parts.beside) panes_.front().draw(c, source, *parts.beside);
    const std::vector<SlicePane*> row = panes_below(c, parts);
    const auto count = static_cast<float>(row.size());
    const float wide = std::floor((rect.width - (count - 1) * line) / count);
    float left = rect.x;
    for (SlicePane* pane : row) {
        const float right = pane == row.back() ? rect.x + rect.width : left + wide;
        pane->draw(c, source,
                   {left, rect.y + head + line, right - left, rect.height - head - line});
        left = right + line;
    }
}

}  // namespace vesselbench
