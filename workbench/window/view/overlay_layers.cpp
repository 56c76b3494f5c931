#include "workbench/window/view/overlay_layers.h"

#include "geometry/kernel/wording.h"
#include "geometry/vessel/centerlines/branch_queries.h"
#include "workbench/case/measure_json.h"
#include "workbench/window/core/shown.h"
#include "workbench/window/drawing/region_lines.h"
#include "workbench/window/view/edit_anchors.h"
#include "workbench/window/widgets/ui.h"
#include "workbench/window/workplace/workplace.h"

namespace vesselbench {

namespace {

const Colour kLine(0.95F, 0.45F, 0.02F), kCircle(0.03F, 0.45F, 0.65F);
const Colour kSourceOnDark(0.55F, 0.62F, 0.70F), kSourceOnLight(0.10F, 0.14F, 0.20F);
constexpr double kSourceOpacity = 0.45;   ///< [-]
constexpr double kThroughSurface = 0.55;  ///< opacity of lines behind the surface [-]
constexpr int kCircleCorners = 40;

Polyline circle_at(const CenterlineBranch& branch, double abscissa) {
    return {.points = circle_points(point_at(branch, abscissa), tangent_at(branch, abscissa),
                                    radius_at(branch, abscissa), kCircleCorners),
            .colour = kCircle,
            .closed = true};
}

/// The source; of a model that is smoothed live while it still is the source, that before it.
/// \return null: none
const Surface* wireframe_of(const PanelContext& c) {
    const Document& document = c.place.document;
    if (document.source()) return &*document.source();
    const Scene* scene = document.shown();
    return c.place.live().shown() && scene != nullptr && scene->surface ? &*scene->surface
                                                                        : nullptr;
}

}  // namespace

std::vector<Polyline> centerline_drawing(const CenterlineGraph& graph) {
    std::vector<Polyline> drawing;
    for (const CenterlineBranch& branch : graph.branches) {
        drawing.push_back({branch.points, kLine});
        const double length = branch_length(branch);
        for (double at = 0.5 * radius_at(branch, 0.0); at < length;) {
            const double radius = radius_at(branch, at);
            if (!(radius > 0.0)) break;
            drawing.push_back(circle_at(branch, at));
            at += radius;
        }
    }
    return drawing;
}

OverlayLayers::OverlayLayers(std::function<void()> wake) : source_search_(std::move(wake)) {}

void OverlayLayers::update(PanelContext& c) {
    update_source(c);
    update_lines(c);
    Document& document = c.place.document;
    document.want_source(c.place.settings.layers.source);
    const bool same =
        seen_snapshots_ == document.snapshot_changes() && seen_variant_ == document.variant();
    if (same || !document.snapshot()) return;
    seen_snapshots_ = document.snapshot_changes();
    seen_variant_ = document.variant();
    anchors_ = edit_anchors(*document.snapshot(), seen_variant_);
}

void OverlayLayers::forget() {
    source_search_.forget();
    asked_source_.reset();
    source_.reset();
    graph_.reset();
    lines_.reset();
    anchors_.clear();
    seen_snapshots_ = -1;
}

void OverlayLayers::update_source(const PanelContext& c) {
    const Surface* surface = wireframe_of(c);
    const bool wanted = c.place.settings.layers.source && surface != nullptr && !surface->empty();
    const auto positions = wanted ? surface->positions : nullptr;
    if (positions != asked_source_) {
        asked_source_ = positions;
        if (source_) ++version_;
        source_.reset();
        source_search_.forget();
        if (wanted)
            source_search_.start(
                [surface = *surface](const Progress&) { return prepare_drawing(surface); });
    }
    static_cast<void>(source_search_.poll());
    auto arrays = source_search_.take();
    if (!arrays) return;
    source_ = std::make_shared<DrawnSurface>(std::move(*arrays));
    ++version_;
}

void OverlayLayers::update_lines(const PanelContext& c) {
    const auto graph =
        c.place.settings.layers.centerlines ? c.place.view_data().centerlines() : nullptr;
    if (graph == graph_) return;
    graph_ = graph;
    lines_.reset();
    lines_ = graph ? std::make_shared<const DrawnLines>(centerline_drawing(*graph)) : nullptr;
    ++version_;
}

void OverlayLayers::add_to(Layers& layers, double line_width, bool dark) const {
    if (source_)
        layers.surfaces.push_back({.source = source_,
                                   .opacity = kSourceOpacity,
                                   .edges = Edges::Only,
                                   .edge_colour = dark ? kSourceOnDark : kSourceOnLight,
                                   .edge_opacity = 1.0,
                                   .edge_width = line_width});
    if (lines_)
        layers.lines.push_back(
            {.lines = lines_, .width = 2 * line_width, .hidden_opacity = kThroughSurface});
}

void OverlayLayers::draw_marks(PanelContext& c, const PixelView& screen) const {
    const ShownLayers& layers = c.place.settings.layers;
    const auto mark = [&](const std::string& item, const Vec3& point, const std::string& words) {
        const auto at = screen.place(point);
        if (!at) return;
        draw_mark(c.ui, *at, MarkLook::Offered, words);
        c.ui.item(item, spot_rect(*at));
    };
    if (layers.names)
        for (const PatchMeasures& opening : c.place.surface_places().openings)
            mark("view.name." + opening.name, opening.centroid,
                 opening.name + "  " + formatted(diameter_of_area(opening.area), "%.2f mm"));
    if (layers.anchors)
        for (std::size_t i = 0; i < anchors_.size(); ++i)
            mark("view.anchor." + std::to_string(i), anchors_[i].point, anchors_[i].name);
}

}  // namespace vesselbench
