#include "workbench/window/drawing/screen_places.h"

#include <algorithm>
#include <cstdint>

#include <imgui.h>

#include "workbench/case/measure_json.h"

namespace vesselbench {

namespace {

/// Of a hint in the view's lowest line: the axes and the scale bar are there [em].
constexpr float kHintMargin = 9.0F;

/// An opening that is not round reaches farther than the circle of its area.
constexpr double kLongOpening = 1.6;

ImVec2 plate_size(const Ui& ui, const std::string& words) {
    const ImFont* font = ui.fonts.small;
    const ImVec2 text = font->CalcTextSizeA(font->FontSize, 1e6F, 0, words.c_str());
    return {text.x + 2 * ui.grid(0.75F), text.y + ui.grid(0.75F)};
}

ImVec2 corner_of(const ViewPixel& at) {
    return {static_cast<float>(at.x()), static_cast<float>(at.y())};
}

void fill(HandleLook look, ImVec2 at, float radius, Paint colour) {
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    if (look == HandleLook::Square)
        draw.AddRectFilled({at.x - radius, at.y - radius}, {at.x + radius, at.y + radius}, colour,
                           radius / 4);
    else
        draw.AddCircleFilled(at, radius, colour);
}

}  // namespace

PixelView on_screen(const ViewCamera& camera, const ScreenRect& rect) {
    return {.camera = camera,
            .width = rect.width,
            .height = rect.height,
            .left = rect.x,
            .top = rect.y};
}

ScreenRect rect_of(const PixelView& view) {
    return {static_cast<float>(view.left), static_cast<float>(view.top),
            static_cast<float>(view.width), static_cast<float>(view.height)};
}

ScreenRect spot_rect(const ViewPixel& at) {
    return {static_cast<float>(at.x()), static_cast<float>(at.y()), 1, 1};
}

ViewPixel mouse_pixel() {
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    return {mouse.x, mouse.y};
}

void draw_texture(unsigned texture, const ScreenRect& rect) {
    ImGui::GetWindowDrawList()->AddImage(
        reinterpret_cast<ImTextureID>(std::uintptr_t{texture}), {rect.x, rect.y},
        {rect.x + rect.width, rect.y + rect.height}, {0, 1}, {1, 0});
}

std::optional<std::size_t> nearest_mark(const PixelView& screen,
                                        const std::vector<NamedPlace>& places,
                                        const ViewPixel& cursor, double reach) {
    std::vector<std::optional<ViewPixel>> seen;
    for (const NamedPlace& place : places) seen.push_back(screen.place(place.point));
    return nearest_to(cursor, seen, reach);
}

bool may_be_over(const PixelView& screen, const std::vector<PatchMeasures>& openings,
                 const ViewPixel& cursor) {
    for (const PatchMeasures& opening : openings) {
        const auto at = screen.place(opening.centroid);
        const double radius = kLongOpening * diameter_of_area(opening.area) / 2;
        if (at && (*at - cursor).norm() <= screen.length(opening.centroid, radius)) return true;
    }
    return false;
}

void draw_mark(const Ui& ui, const ViewPixel& at, MarkLook look, const std::string& label) {
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const ImVec2 middle = corner_of(at);
    const float radius = ui.em * (look == MarkLook::Lit ? 0.5F : 0.36F);
    const Paint fill = look == MarkLook::Offered ? paint(0xFFFFFF) : ui.theme.accent;
    draw.AddCircleFilled(middle, radius + ui.em * 0.12F, paint(0x101418, 200));
    draw.AddCircleFilled(middle, radius, paint(0xFFFFFF));
    draw.AddCircleFilled(middle, radius - ui.em * 0.1F, fill);
    if (look == MarkLook::Offered) draw.AddCircleFilled(middle, radius * 0.45F, ui.theme.accent);
    if (label.empty()) return;
    const float gap = radius + ui.em * 0.4F;
    const float right = ImGui::GetWindowPos().x + ImGui::GetWindowWidth();
    const float wide = plate_size(ui, label).x;
    const bool fits = middle.x + gap + wide <= right;
    draw_plate(ui, {fits ? middle.x + gap : middle.x - gap - wide, middle.y}, label);
}

void draw_mark_line(const Ui& ui, const PixelView& screen, std::span<const Vec3> points,
                    bool closed) {
    std::vector<ImVec2> line;
    for (const Vec3& point : points)
        if (const auto at = screen.place(point)) line.push_back(corner_of(*at));
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const float thick = std::max(1.5F, ui.em / 8);
    const auto count = static_cast<int>(line.size());
    const ImDrawFlags flags = closed ? ImDrawFlags_Closed : ImDrawFlags_None;
    draw.AddPolyline(line.data(), count, paint(0x101418, 160), flags, 2 * thick);
    draw.AddPolyline(line.data(), count, paint(0xFFFFFF), flags, thick);
}

void draw_handle_mark(Ui& ui, const Handle& handle, const ViewPixel& at, bool lit) {
    const float radius = ui.em * (lit ? 0.48F : 0.38F);
    const ImVec2 middle = corner_of(at);
    fill(handle.look, middle, radius + ui.em * 0.1F, paint(0x101418, 200));
    fill(handle.look, middle, radius, paint(0xFFFFFF));
    fill(handle.look, middle, radius - ui.em * 0.1F, lit ? ui.theme.accent : kRegionPaint);
    if (handle.look == HandleLook::Ring) fill(handle.look, middle, radius * 0.4F, paint(0xFFFFFF));
    ui.item(handle.name, ScreenRect{middle.x - radius, middle.y - radius, 2 * radius, 2 * radius});
}

void draw_plate(const Ui& ui, const ViewPixel& at, const std::string& words) {
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const ImFont* font = ui.fonts.small;
    const ImVec2 size = plate_size(ui, words);
    const float left = ImGui::GetWindowPos().x, room = ImGui::GetWindowWidth() - size.x;
    const float x = std::clamp(corner_of(at).x, left, left + std::max(room, 0.0F));
    const float pad = ui.grid(0.75F), top = corner_of(at).y - size.y / 2;
    draw.AddRectFilled({x, top}, {x + size.x, top + size.y}, faded(ui.theme.panel, 0.88),
                       ImGui::GetStyle().FrameRounding);
    draw.AddText(font, font->FontSize, {x + pad, top + pad / 2}, ui.theme.text, words.c_str());
}

void draw_hint(const Ui& ui, const ScreenRect& view, const std::string& words) {
    const ImFont* font = ui.fonts.small;
    const float wide = font->CalcTextSizeA(font->FontSize, 1e6F, 0, words.c_str()).x;
    // Above the axes and the scale bar where it is as wide as the view.
    const bool between = wide < view.width - 2 * ui.em * kHintMargin;
    draw_plate(ui,
               {view.middle_x() - wide / 2, view.y + view.height - ui.em * (between ? 1 : 3.2F)},
               words);
}

}  // namespace vesselbench
