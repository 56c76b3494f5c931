#include "workbench/window/drawing/view_overlays.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <imgui.h>

#include "geometry/kernel/wording.h"

namespace vesselbench {

namespace {

constexpr double kBarShare = 0.22;      ///< of the view's width that the bar may take
constexpr float kOrientation = 2.3F;    ///< from its middle to its letters [em]
constexpr float kLetterRadius = 0.62F;  ///< [em]

ImDrawList& draw_list() {
    return *ImGui::GetWindowDrawList();
}

void centred_text(ImFont* font, ImVec2 middle, Paint colour, const std::string& words) {
    const ImVec2 size = font->CalcTextSizeA(font->FontSize, 1e6F, 0, words.c_str());
    draw_list().AddText(font, font->FontSize, {middle.x - size.x / 2, middle.y - size.y / 2},
                        colour, words.c_str());
}

/// An end of a patient axis.
struct AxisEnd {
    const char* letter;
    Vec3 direction;
    StandardView side;
    Paint colour;
};

const std::array<AxisEnd, 6>& axis_ends() {
    static const std::array<AxisEnd, 6> ends = {
        {{"L", {1, 0, 0}, StandardView::Left, paint(0xE06C62)},
         {"R", {-1, 0, 0}, StandardView::Right, paint(0xE06C62)},
         {"P", {0, 1, 0}, StandardView::Posterior, paint(0x5FB87A)},
         {"A", {0, -1, 0}, StandardView::Anterior, paint(0x5FB87A)},
         {"S", {0, 0, 1}, StandardView::Superior, paint(0x5B9BE0)},
         {"I", {0, 0, -1}, StandardView::Inferior, paint(0x5B9BE0)}}};
    return ends;
}

struct PlacedEnd {
    const AxisEnd* end;
    ImVec2 place;
    double depth;  ///< towards the eye
};

bool draw_end(Ui& ui, const PlacedEnd& placed, ImVec2 middle) {
    const float radius = ui.em * kLetterRadius;
    const bool front = placed.depth >= 0;
    const Paint colour = faded(placed.end->colour, front ? 1.0 : 0.55);
    if (front) draw_list().AddLine(middle, placed.place, colour, ui.em / 8);
    draw_list().AddCircleFilled(placed.place, radius,
                                front ? colour : faded(placed.end->colour, 0.25));
    centred_text(ui.fonts.small, placed.place, front ? paint(0xFFFFFF) : colour,
                 placed.end->letter);
    ImGui::SetCursorScreenPos({placed.place.x - radius, placed.place.y - radius});
    const std::string name = std::string("view.from.") + placed.end->letter;
    const bool clicked = ImGui::InvisibleButton(name.c_str(), {2 * radius, 2 * radius});
    ui.item(name);
    return clicked;
}

}  // namespace

ScaleLength scale_length(double most) {
    if (!(most > 0) || !std::isfinite(most)) return {};
    const double power = std::pow(10.0, std::floor(std::log10(most)));
    const double times = most / power;
    const double length = power * (times >= 5 ? 5 : times >= 2 ? 2 : 1);
    return {length, formatted(length, "%g mm")};
}

void draw_scale_bar(const Ui& ui, const ScreenRect& view, const ViewCamera& camera) {
    const double pixel = pixel_size(camera, static_cast<int>(view.height), camera.centre);
    const ScaleLength length = scale_length(kBarShare * view.width * pixel);
    if (length.text.empty()) return;
    const auto wide = static_cast<float>(length.millimetres / pixel);
    const float right = view.x + view.width - ui.grid(2), low = view.y + view.height - ui.grid(2);
    const float tick = ui.grid(0.75F), thick = std::max(1.5F, ui.em / 9);
    const Paint colour = faded(ui.theme.text, 0.85);
    draw_list().AddLine({right - wide, low}, {right, low}, colour, thick);
    for (const float x : {right - wide, right})
        draw_list().AddLine({x, low - tick}, {x, low + thick / 2}, colour, thick);
    centred_text(ui.fonts.small, {right - wide / 2, low - ui.em * 0.75F}, colour, length.text);
}

ScreenRect orientation_rect(const Ui& ui, const ScreenRect& view) {
    const float side = 2 * ui.em * (kOrientation + kLetterRadius);
    const float off = ui.grid(3) - ui.em * kLetterRadius;
    return {view.x + off, view.y + view.height - off - side, side, side};
}

std::optional<StandardView> draw_orientation(Ui& ui, const ScreenRect& view,
                                             const ViewCamera& camera) {
    const float reach = ui.em * kOrientation;
    const ImVec2 middle{view.x + reach + ui.grid(3), view.y + view.height - reach - ui.grid(3)};
    const Eigen::Matrix3d eye = to_eye(camera);
    std::array<PlacedEnd, 6> placed;
    for (std::size_t i = 0; i < placed.size(); ++i) {
        const Vec3 seen = eye * axis_ends()[i].direction;
        placed[i] = {&axis_ends()[i],
                     {middle.x + static_cast<float>(seen.x()) * reach,
                      middle.y - static_cast<float>(seen.y()) * reach},
                     seen.z()};
    }
    std::ranges::sort(placed, {}, &PlacedEnd::depth);
    std::optional<StandardView> clicked;
    for (const PlacedEnd& end : placed)
        if (draw_end(ui, end, middle)) clicked = end.end->side;
    return clicked;
}

ToolGrid tool_grid(const Ui& ui, const ScreenRect& view, int buttons) {
    const float pad = ui.grid(0.5F), edge = ui.grid(1.5F), gap = ui.grid(0.25F);
    const float step = ImGui::GetFrameHeight() + gap;
    const auto fitting = static_cast<int>((view.width - 2 * (pad + edge) + gap) / step);
    const int columns = std::clamp(fitting, 1, buttons);
    const int rows = (buttons + columns - 1) / columns;
    return {{view.x + edge, view.y + edge, static_cast<float>(columns) * step - gap + 2 * pad,
             static_cast<float>(rows) * step - gap + 2 * pad},
            columns};
}

ScreenRect draw_colour_legend(const Ui& ui, const ScreenRect& view, const ColourLegend& legend) {
    constexpr int kSteps = 64;
    const float wide = ui.em * 14, high = ui.em * 0.8F;
    const float left = view.x + view.width - wide - ui.grid(3), top = view.y + ui.grid(7.5F);
    const float step = wide / kSteps;
    for (int i = 0; i < kSteps; ++i) {
        const PixelColour rgb = pixel_colour(colour_at(legend.map, (i + 0.5) / kSteps));
        const float x = left + static_cast<float>(i) * step;
        draw_list().AddRectFilled({x, top}, {x + step + 1, top + high},
                                  IM_COL32(rgb[0], rgb[1], rgb[2], 255));
    }
    draw_list().AddRect({left, top}, {left + wide + 1, top + high}, faded(ui.theme.text, 0.5));
    centred_text(ui.fonts.small, {left + wide / 2, top - ui.em * 0.7F}, ui.theme.text,
                 legend.title);
    const float low = top + high + ui.em * 0.75F;
    for (const double share : {0.0, 0.5, 1.0}) {
        const double value = legend.least + share * (legend.most - legend.least);
        const bool zero = std::abs(value) < 1e-9 * (legend.most - legend.least);
        centred_text(ui.fonts.small, {left + wide * static_cast<float>(share), low}, ui.theme.text,
                     zero ? "0" : formatted(value));
    }
    if (!legend.remark.empty())
        centred_text(ui.fonts.small, {left + wide / 2, low + ui.em}, ui.theme.text, legend.remark);
    const float lines = legend.remark.empty() ? 0.6F : 1.6F;
    return {left, top - 1.3F * ui.em, wide, low + lines * ui.em - top + 1.3F * ui.em};
}

}  // namespace vesselbench
