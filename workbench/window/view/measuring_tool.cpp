#include "workbench/window/view/measuring_tool.h"

#include <algorithm>
#include <utility>

#include <imgui.h>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/wording.h"
#include "workbench/window/style/icons.h"
#include "workbench/window/view/model_drawing.h"
#include "workbench/window/widgets/controls.h"

namespace vesselbench {

namespace {

VesselDiameter diameter_or_throw(const Surface& surface, const CenterlineGraph& graph,
                                 const Vec3& point) {
    const auto found = vessel_diameter(surface, graph, point);
    if (!found) throw AlgorithmFailure("there is no centerline to measure at");
    return *found;
}

std::string diameter_text(const VesselDiameter& diameter) {
    std::string text = formatted(diameter.inscribed, "\u00F8 %.2f mm inscribed");
    if (!diameter.outline.empty())
        text += formatted(diameter.equivalent, ", \u00F8 %.2f mm by area") +
                formatted(diameter.area, " (%.1f mm\u00B2)");
    return text;
}

/// The points that are before the eye, as a line of the window.
std::vector<ImVec2> line_of(const PixelView& screen, const Positions& points) {
    std::vector<ImVec2> line;
    for (const Vec3& point : points)
        if (const auto at = screen.place(point))
            line.emplace_back(static_cast<float>(at->x()), static_cast<float>(at->y()));
    return line;
}

void draw_line(const Ui& ui, const std::vector<ImVec2>& line, bool closed) {
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const float thick = std::max(1.5F, ui.em / 8);
    const auto count = static_cast<int>(line.size());
    const ImDrawFlags flags = closed ? ImDrawFlags_Closed : ImDrawFlags_None;
    draw.AddPolyline(line.data(), count, paint(0x101418, 160), flags, 2 * thick);
    draw.AddPolyline(line.data(), count, paint(0xFFFFFF), flags, thick);
}

}  // namespace

MeasuringTool::MeasuringTool(Renderer& renderer, std::function<void()> wake)
    : picker_(renderer), wake_(wake), search_(std::move(wake)) {}

void MeasuringTool::forget() {
    points_.clear();
    diameters_.clear();
    clicks_.clear();
    places_.clear();
    picker_.forget();
    search_.forget();
}

void MeasuringTool::update(const PanelContext& c, const SeenModel& seen) {
    const Document& document = c.place.document;
    if (tool_ != c.place.view.tool || seen_scenes_ != document.scene_changes()) forget();
    tool_ = c.place.view.tool;
    seen_scenes_ = document.scene_changes();
    static_cast<void>(search_.poll());
    if (const auto found = search_.take()) diameters_.push_back(*found);
    if (const auto picked = picker_.result()) take(*picked);
    const bool measures = tool_ != MeasureTool::None && c.place.armed().empty();
    if (measures && seen.surface != nullptr && seen.clicked) add_click(seen);
    search_click();
    search_diameter(c);
    if (picker_.pending() && wake_) wake_();
}

void MeasuringTool::add_click(const SeenModel& seen) {
    clicks_.push_back({seen.view, seen.layers, seen.screen.device_pixel(mouse_pixel())});
}

/// One after the other: a request would forget the one before.
void MeasuringTool::search_click() {
    if (clicks_.empty() || picker_.pending()) return;
    const Click& click = clicks_.front();
    picker_.request(click.view, click.layers, click.pixel.x(), click.pixel.y());
    clicks_.pop_front();
}

void MeasuringTool::take(const Picked& picked) {
    if (picked.layer != kModelLayer) return;
    if (tool_ == MeasureTool::Distance) points_.push_back(picked.point);
    if (tool_ == MeasureTool::Diameter) places_.push_back(picked.point);
}

/// Those clicked before the centerlines are known wait for them.
void MeasuringTool::search_diameter(const PanelContext& c) {
    const ViewData& data = c.place.view_data();
    const Scene* scene = c.place.document.shown();
    if (places_.empty() || search_.pending() || data.finds_centerlines()) return;
    const auto& lines = data.centerlines();
    if (!lines || scene == nullptr || !scene->surface) return places_.clear();
    search_.forget();
    search_.start([surface = *scene->surface, lines, point = places_.front()](const Progress&) {
        return diameter_or_throw(surface, *lines, point);
    });
    places_.pop_front();
}

void MeasuringTool::draw_distance(const Ui& ui, const PixelView& screen) const {
    if (points_.empty()) return;
    draw_line(ui, line_of(screen, points_), false);
    for (std::size_t i = 0; i < points_.size(); ++i) {
        const auto at = screen.place(points_[i]);
        if (!at) continue;
        const std::string length =
            i == 0 ? "" : formatted((points_[i] - points_[i - 1]).norm(), "%.2f mm");
        draw_mark(ui, *at, MarkLook::Picked, length);
    }
}

void MeasuringTool::draw_diameter(const Ui& ui, const PixelView& screen,
                                  const VesselDiameter& diameter) const {
    draw_line(ui, line_of(screen, diameter.outline), true);
    if (const auto at = screen.place(diameter.centre))
        draw_mark(ui, *at, MarkLook::Picked, diameter_text(diameter));
}

void MeasuringTool::draw(PanelContext& c, const PixelView& screen) const {
    draw_distance(c.ui, screen);
    for (std::size_t i = 0; i < diameters_.size(); ++i) {
        draw_diameter(c.ui, screen, diameters_[i]);
        if (const auto at = screen.place(diameters_[i].centre))
            c.ui.item("measure.diameter." + std::to_string(i), spot_rect(*at));
    }
}

std::string MeasuringTool::words(const PanelContext& c) const {
    const ViewData& data = c.place.view_data();
    if (tool_ == MeasureTool::Diameter) {
        if (data.finds_centerlines()) return "Finding the centerlines";
        if (!data.centerlines_problem().empty()) return data.centerlines_problem();
        if (!search_.problem().empty()) return search_.problem();
        return "Diameter: click a vessel";
    }
    if (points_.size() < 2)
        return points_.empty() ? "Distance: click a point" : "Click another point";
    return formatted(path_length(points_), "%.2f mm") +
           (points_.size() > 2 ? " along " + counted(points_.size() - 1, "segment") : "");
}

void MeasuringTool::draw_strip(PanelContext& c, ViewStrips& strips) {
    if (tool_ == MeasureTool::None) return;
    const Ui& ui = c.ui;
    const float side = ImGui::GetFrameHeight(), gap = ui.grid(0.75F);
    const float wide = strips.begin(ui, "measure", ui.em * 22);
    const float left = ImGui::GetCursorPosX();
    ImGui::SetCursorPosX(left + gap);
    ImGui::AlignTextToFramePadding();
    clipped_text(ui, words(c), ui.theme.text, wide - 2 * side - 3 * gap);
    ImGui::SameLine(left + wide - 2 * side - gap);
    const bool any = !points_.empty() || !diameters_.empty();
    if (icon_button(c.ui, "measure.clear", icons::kDelete, "Clear measurements", any)) forget();
    ViewStrips::next(ui);
    if (icon_button(c.ui, "measure.close", icons::kClose, "Stop measuring  Esc"))
        c.place.view.tool = MeasureTool::None;
}

}  // namespace vesselbench
