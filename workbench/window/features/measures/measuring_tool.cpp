#include "workbench/window/features/measures/measuring_tool.h"

#include <utility>

#include <imgui.h>

#include "geometry/kernel/errors.h"
#include "workbench/report/measure_table.h"
#include "workbench/window/core/core.h"
#include "workbench/window/core/shown.h"
#include "workbench/window/features/colours/colours_feature.h"
#include "workbench/window/features/measures/measures_feature.h"
#include "workbench/window/style/icons.h"
#include "workbench/window/widgets/controls.h"
#include "workbench/window/widgets/ui.h"

namespace vesselbench {

namespace {

VesselDiameter diameter_or_throw(const Surface& surface, const CenterlineGraph& graph,
                                 const Vec3& point) {
    const auto found = vessel_diameter(surface, graph, point);
    if (!found) throw AlgorithmFailure("there is no centerline to measure at");
    return *found;
}

}  // namespace

MeasuringTool::MeasuringTool(Renderer& renderer, std::function<void()> wake)
    : clicks_(renderer, wake), search_(std::move(wake)) {}

void MeasuringTool::forget() {
    clicks_.forget();
    places_.clear();
    search_.forget();
}

void MeasuringTool::update(PanelContext& c, const SeenModel& seen) {
    const Document& document = c.core.document;
    if (tool_ != c.core.view.tool || seen_scenes_ != document.scene_changes()) forget();
    tool_ = c.core.view.tool;
    seen_scenes_ = document.scene_changes();
    if (search_.poll())
        if (const auto found = search_.take())
            c.core.get<MeasuresFeature>().measures().add(
                *found, c.core.get<MeasuresFeature>().measured_model(MeasuredOn::Surface));
    const bool takes = c.core.has_click_tool() && is_measuring(tool_);
    if (takes && seen.surface != nullptr && seen.clicked) clicks_.add(seen);
    if (const auto place = clicks_.update()) take(c, *place);
    search_diameter(c);
}

void MeasuringTool::take(PanelContext& c, const Vec3& place) {
    if (tool_ == ClickTool::Distance)
        c.core.get<MeasuresFeature>().measures().click(
            place, c.core.get<MeasuresFeature>().measured_model(MeasuredOn::Surface));
    if (tool_ == ClickTool::Diameter) places_.push_back(place);
}

/// Those clicked before the centerlines are known wait for them.
void MeasuringTool::search_diameter(const PanelContext& c) {
    const ViewData& data = c.core.get<ColoursFeature>().view_data();
    const Scene* scene = c.core.document.shown();
    if (places_.empty() || search_.pending() || data.finds_centerlines()) return;
    const auto& lines = data.centerlines();
    if (!lines || scene == nullptr || !scene->surface) return places_.clear();
    search_.forget();
    search_.start([surface = *scene->surface, lines, point = places_.front()](const Progress&) {
        return diameter_or_throw(surface, *lines, point);
    });
    places_.pop_front();
}

std::string MeasuringTool::words(const PanelContext& c) const {
    const ViewData& data = c.core.get<ColoursFeature>().view_data();
    if (tool_ == ClickTool::Diameter) {
        if (data.finds_centerlines()) return "Finding the centerlines";
        if (!data.centerlines_problem().empty()) return data.centerlines_problem();
        if (!search_.problem().empty()) return search_.problem();
        return "Diameter: click a vessel";
    }
    const MeasureList& measures = c.core.get<MeasuresFeature>().measures();
    if (measures.lengthens())
        return measure_text(measures.all().back()) + ": click further points, or +";
    return measures.first_point() ? "Click another point" : "Distance: click a point";
}

void MeasuringTool::draw_strip(PanelContext& c, ViewStrips& strips) {
    if (!is_measuring(tool_)) return;
    const Ui& ui = c.ui;
    const float side = ImGui::GetFrameHeight(), gap = ui.grid(0.75F);
    const float wide = strips.begin(ui, "measure", ui.em * 22);
    const float left = ImGui::GetCursorPosX();
    ImGui::SetCursorPosX(left + gap);
    ImGui::AlignTextToFramePadding();
    clipped_text(ui, words(c), ui.theme.text, wide - 3 * side - 4 * gap);
    ImGui::SameLine(left + wide - 3 * side - 2 * gap);
    MeasureList& measures = c.core.get<MeasuresFeature>().measures();
    if (icon_button(c.ui, "measure.next", icons::kPlus, "The next click begins another distance",
                    measures.lengthens()))
        measures.begin_next();
    ViewStrips::next(ui);
    if (icon_button(c.ui, "measure.clear", icons::kDelete, "Remove the last measurement",
                    measures.can_take_back()))
        measures.take_back();
    ViewStrips::next(ui);
    if (icon_button(c.ui, "measure.close", icons::kClose, "Stop measuring  Esc"))
        c.core.view.tool = ClickTool::None;
}

}  // namespace vesselbench
