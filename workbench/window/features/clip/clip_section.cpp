#include "workbench/window/features/clip/clip_section.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <imgui.h>

#include "geometry/kernel/wording.h"
#include "workbench/window/core/core.h"
#include "workbench/window/core/shown.h"
#include "workbench/window/drawing/model_drawing.h"
#include "workbench/window/features/colours/colours_feature.h"
#include "workbench/window/style/icons.h"
#include "workbench/window/widgets/controls.h"
#include "workbench/window/widgets/slider.h"
#include "workbench/window/widgets/ui.h"

namespace vesselbench {

namespace {

const Colour kSection(0.86F, 0.52F, 0.40F);  ///< of a solid model
const Colour kOutline(0.02F, 0.02F, 0.02F);  ///< of cut tetrahedra
constexpr double kOutlineOpacity = 0.35;     ///< [-]

constexpr double kOutlinePull = 0.02;  ///< towards the eye, so that cells do not hide it [mm]

struct AxisName {
    ClipAxis axis;
    const char* label;
    const char* positive;  ///< patient side of larger coordinates
    const char* negative;
};

constexpr std::array<AxisName, 4> kAxes = {{{ClipAxis::Sagittal, "Sagittal", "L", "R"},
                                            {ClipAxis::Coronal, "Coronal", "P", "A"},
                                            {ClipAxis::Axial, "Axial", "S", "I"},
                                            {ClipAxis::Camera, "Camera", "nearer", "farther"}}};

const AxisName& name_of(ClipAxis axis) {
    return *std::ranges::find(kAxes, axis, &AxisName::axis);
}

}  // namespace

ClipSection::ClipSection(std::function<void()> wake) : search_(std::move(wake)) {}

/// A new plane removes the half that hides its section.
void ClipSection::choose_side(ClipChoice& choice, const ViewCamera& camera) {
    const auto now = choice.on ? std::optional(choice.axis) : std::nullopt;
    if (now && now != axis_) choice.flipped = hides_section(*now, camera.view);
    axis_ = now;
}

/// The box of the surface, from before a stroke while it is painted: the plane stays.
void ClipSection::measure(const PanelContext& c, const Surface& surface) {
    const bool painting = measured_ && c.core.document.is_painting();
    if (painting || surface.positions == measured_) return;
    measured_ = surface.positions;
    box_ = bounds(surface.points());
}

void ClipSection::update(const PanelContext& c, const Surface* surface, const ViewCamera& camera) {
    if (surface != nullptr && c.core.view.clip.on) measure(c, *surface);
    choose_side(c.core.view.clip, camera);
    std::optional<ClipPlane> now;
    if (surface != nullptr)
        if (const auto plane = clip_plane(c.core.view.clip, box_, camera.view))
            now = ClipPlane{plane->point, plane->normal};
    const bool same = now.has_value() == plane_.has_value() &&
                      (!now || (now->point == plane_->point && now->normal == plane_->normal));
    if (!same) ++version_;
    plane_ = now;
    update_cells(c);
}

void ClipSection::forget() {
    search_.forget();
    plane_.reset();
    measured_.reset();
    axis_.reset();
    asked_ = {};
    cells_.reset();
    outlines_.reset();
}

// --- the volume mesh

ClipSection::Prepared ClipSection::prepared(const VolumeMesh& mesh, const ColourValues& colours,
                                            const Plane& plane, const Progress& progress) {
    const VolumeSection section = section_of(mesh, colours.values, plane, progress);
    Prepared ready;
    if (section.cells.empty()) return ready;
    progress.check_cancelled();
    ready.arrays = prepare_drawing(section.surface());
    ready.values = section.vertex_values();
    for (const Positions& cell : section.cells) ready.outlines.push_back({cell, kOutline, true});
    return ready;
}

void ClipSection::update_cells(const PanelContext& c) {
    const auto& colours = c.core.get<ColoursFeature>().view_data().colours();
    const Scene* scene = c.core.document.shown();
    const bool wanted = plane_ && colours && colours->kind == ColouringKind::TetrahedraQuality &&
                        scene != nullptr && scene->volume_mesh &&
                        scene->volume_mesh->cell_count() == colours->values.size();
    if (!wanted) {
        if (cells_) ++version_;
        cells_.reset();
        asked_ = {};
        search_.forget();
        return;
    }
    if (range_ != c.core.view.range().value_or(colours->range)) ++version_;
    range_ = c.core.view.range().value_or(colours->range);
    if (search_.poll()) take_cells();
    const Asked now{colours, plane_->point, plane_->normal};
    if (now == asked_ || search_.pending()) return;  // a dragged plane shows what is ready
    asked_ = now;
    search_.start([mesh = scene->volume_mesh, colours,
                   plane = Plane{now.point, now.normal}](const Progress& progress) {
        return prepared(*mesh, *colours, plane, progress);
    });
}

void ClipSection::take_cells() {
    ++version_;
    cells_.reset();
    outlines_.reset();
    auto ready = search_.take();  // none: it failed
    if (!ready || ready->values.empty()) return;
    cells_ = std::make_shared<DrawnSurface>(std::move(ready->arrays));
    cells_->set_values(ready->values);
    outlines_ = std::make_shared<const DrawnLines>(ready->outlines);
}

void ClipSection::add_to(Layers& layers, double line_width) const {
    if (!plane_) return;
    if (!cells_) {
        for (SurfaceLayer& layer : layers.surfaces)
            if (layer.id == kModelLayer && layer.source->is_solid()) layer.section = kSection;
        return;
    }
    layers.surfaces.push_back({.source = cells_,
                               .colouring = Colouring::Values,
                               .map = ColourMap::Ordered,
                               .least = range_.least,
                               .most = range_.most,
                               .back_as_front = true,
                               .flat = true,
                               .clipped = false});
    layers.lines.push_back({.lines = outlines_,
                            .width = line_width,
                            .opacity = kOutlineOpacity,
                            .pull = kOutlinePull});
}

// --- the strip

std::string ClipSection::place_text(const ClipChoice& choice) const {
    const AxisName& axis = name_of(choice.axis);
    const double along =
        choice.axis == ClipAxis::Camera
            ? (plane_->point - box_.centre()).dot(plane_->normal) * (choice.flipped ? -1 : 1)
            : plane_->point[static_cast<int>(choice.axis)];
    return std::string(along < 0 ? axis.negative : axis.positive) + "  " +
           formatted(std::abs(along), "%.1f mm");
}

void ClipSection::draw_strip(PanelContext& c, ViewStrips& strips) const {
    ClipChoice& choice = c.core.view.clip;
    if (!plane_) return;
    const Ui& ui = c.ui;
    const float side = ImGui::GetFrameHeight(), gap = ui.grid(0.75F), axes = ui.em * 7;
    const float wide = strips.begin(ui, "clip", ui.em * 26);
    std::vector<std::string> labels;
    for (const AxisName& axis : kAxes) labels.emplace_back(axis.label);
    std::string chosen = name_of(choice.axis).label;
    if (vesselbench::choice(c.ui, "clip.axis", labels, chosen, axes))
        choice.axis = std::ranges::find(kAxes, chosen, &AxisName::label)->axis;
    ViewStrips::next(ui);
    slider(c.ui, "clip.place", choice.place,
           {.text = place_text(choice),
            .width = wide - axes - 2 * side - 3 * gap,
            .help = "Drag to move the section; Ctrl+wheel in the view does the same"});
    ViewStrips::next(ui);
    if (icon_button(c.ui, "clip.flip", icons::kFlip, "Show the other half", true, choice.flipped))
        choice.flipped = !choice.flipped;
    ViewStrips::next(ui);
    if (icon_button(c.ui, "clip.close", icons::kClose, "Show the whole model  C"))
        choice.on = false;
}

}  // namespace vesselbench
