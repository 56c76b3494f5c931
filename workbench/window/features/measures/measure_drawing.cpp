#include "workbench/window/features/measures/measure_drawing.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <span>
#include <vector>

#include "geometry/kernel/wording.h"
#include "workbench/report/measure_table.h"
#include "workbench/window/core/core.h"
#include "workbench/window/core/shown.h"
#include "workbench/window/features/measures/measures_feature.h"
#include "workbench/window/widgets/ui.h"

namespace vesselbench {

namespace {

void draw_distance(const Ui& ui, const PixelView& screen, const KeptMeasure& measure) {
    const std::vector<Vec3>& points = measure.points;
    draw_mark_line(ui, screen, points, false);
    for (std::size_t i = 0; i < points.size(); ++i) {
        const auto at = screen.place(points[i]);
        if (!at) continue;
        const std::string label =
            i == 0 ? measure.name : formatted((points[i] - points[i - 1]).norm(), "%.2f mm");
        draw_mark(ui, *at, MarkLook::Picked, label);
    }
}

void draw_diameter(const Ui& ui, const PixelView& screen, const KeptMeasure& measure) {
    draw_mark_line(ui, screen, std::span(measure.points).subspan(1), true);
    if (const auto at = screen.place(measure.points.front()))
        draw_mark(ui, *at, MarkLook::Picked, measure.name + ": " + measure_text(measure));
}

void draw_one(PanelContext& c, const PixelView& screen, std::size_t i) {
    const KeptMeasure& measure = c.core.get<MeasuresFeature>().measures().all()[i];
    if (measure.kind == MeasureKind::Distance)
        draw_distance(c.ui, screen, measure);
    else
        draw_diameter(c.ui, screen, measure);
    if (const auto at = screen.place(measure.points.front()))
        c.ui.item("measure." + to_string(measure.kind) + "." + std::to_string(i), spot_rect(*at));
}

/// \param shown whether a point is in the picture
void draw_those(PanelContext& c, const PixelView& screen,
                const std::function<bool(const Vec3&)>& shown) {
    const MeasureList& measures = c.core.get<MeasuresFeature>().measures();
    if (!is_measuring(c.core.view.tool) && c.shown.bottom != BottomTab::Measures) return;
    for (std::size_t i = 0; i < measures.all().size(); ++i)
        if (std::ranges::all_of(measures.all()[i].points, shown)) draw_one(c, screen, i);
    if (!measures.first_point() || !shown(*measures.first_point())) return;
    if (const auto at = screen.place(*measures.first_point()))
        draw_mark(c.ui, *at, MarkLook::Picked, "");
}

}  // namespace

void draw_measures(PanelContext& c, const PixelView& screen) {
    draw_those(c, screen, [](const Vec3&) { return true; });
}

void draw_measures_in_slice(PanelContext& c, const PixelView& screen, int axis, double position,
                            double away) {
    draw_those(c, screen, [axis, position, away](const Vec3& point) {
        return std::abs(point[axis] - position) <= away;
    });
}

}  // namespace vesselbench
