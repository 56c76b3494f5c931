#include "workbench/window/features/handles/deform_handles.h"

#include <algorithm>

#include "geometry/kernel/cross_section.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/same_surface.h"
#include "geometry/kernel/wording.h"
#include "geometry/vessel/centerlines/centerlines.h"
#include "workbench/case/argument_texts.h"

namespace vesselbench {

namespace {

constexpr std::size_t kMoves = 0;    ///< index of the handle
constexpr std::size_t kRings = 12;   ///< sections that are shown
constexpr double kLeastReach = 0.1;  ///< that a drag can give [mm]

std::vector<RegionLine> rings_of(const Surface& surface, const Positions& axis) {
    std::vector<RegionLine> rings;
    const std::size_t step = std::max<std::size_t>(1, axis.size() / kRings);
    for (std::size_t i = step; i + 1 < axis.size(); i += step) {
        const Plane plane{axis[i], (axis[i + 1] - axis[i - 1]).normalized()};
        if (auto curve = cross_section_at(surface, plane); curve && curve->closed)
            rings.push_back({.points = std::move(curve->points), .closed = true, .in_front = true});
    }
    return rings;
}

BranchPreview preview_of(const DeformedBranch& deformed, const Vec3& at) {
    return {.at = at,
            .axis = deformed.axis,
            .from = deformed.from,
            .reach = deformed.reach,
            .rings = rings_of(deformed.surface, deformed.axis.bent),
            .problem = {}};
}

/// Arc length of the axis' point that is nearest to a place [mm].
double abscissa_of(const Positions& axis, const Vec3& place) {
    double along = 0.0, found = 0.0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < axis.size(); ++i) {
        if (i > 0) along += (axis[i] - axis[i - 1]).norm();
        const double d = (axis[i] - place).squaredNorm();
        if (d >= least) continue;
        least = d;
        found = along;
    }
    return found;
}

/// The axis' point at an arc length; its ends beyond it.
Vec3 point_at(const Positions& axis, double abscissa) {
    double along = 0.0;
    for (std::size_t i = 0; i + 1 < axis.size(); ++i) {
        const double step = (axis[i + 1] - axis[i]).norm();
        if (along + step >= abscissa)
            return axis[i] + std::max(0.0, (abscissa - along) / step) * (axis[i + 1] - axis[i]);
        along += step;
    }
    return axis.back();
}

Vec3 move_in(const OperationForm& form) {
    return point_of(form, "move").value_or(Vec3::Zero());
}

}  // namespace

bool deforms_branch(const OperationForm& form) {
    return has_field(form, Meaning::Place) &&
           std::ranges::any_of(form.fields(), [](const FormField& field) {
               return field.parameter->name == "move" &&
                      field.parameter->type == ParameterType::Point;
           });
}

std::optional<BranchDeformation> deformation_in(const OperationForm& form) {
    const auto at = point_of(form, "at");
    if (!at) return std::nullopt;
    return BranchDeformation{.at = *at,
                             .move = move_in(form),
                             .straighten = number_of(form, "straighten").value_or(0.0),
                             .reach = number_of(form, "reach")};
}

BranchPreview preview_of(const Surface& surface, const BranchDeformation& deformation,
                         const Progress& progress) {
    BranchPreview preview{.at = deformation.at};
    try {
        const auto graph = centerlines_of(surface, {}, progress);
        const BranchDeformation rest{.at = deformation.at, .reach = deformation.reach};
        preview = preview_of(deform_branch(surface, *graph, rest, progress), deformation.at);
        return preview_of(deform_branch(surface, *graph, deformation, progress), deformation.at);
    } catch (const Cancelled&) {
        throw;
    } catch (const std::exception& error) {
        preview.problem = error.what();
        return preview;
    }
}

FormShape deform_shape(const OperationForm& form, const BranchPreview& preview) {
    FormShape shape;
    if (preview.axis.rest.size() < 2) return shape;
    const Vec3 move = move_in(form);
    const bool bent = preview.axis.rest != preview.axis.bent;
    shape.lines.push_back({.points = preview.axis.rest, .faint = true, .in_front = true});
    if (bent) {
        shape.lines.push_back({.points = preview.axis.bent, .in_front = true});
        shape.lines.insert(shape.lines.end(), preview.rings.begin(), preview.rings.end());
    }
    const Vec3 to = preview.from + move;
    if (move != Vec3::Zero()) {
        shape.lines.push_back({.points = {preview.from, to}, .in_front = true});
        shape.notes.push_back({to, "moved " + formatted(move.norm(), "%.2f mm")});
    }
    shape.handles.push_back({.name = "deform.move",
                             .point = to,
                             .look = HandleLook::Square,
                             .help = "Move this place of the branch in the plane of the view"});
    const double at = abscissa_of(preview.axis.rest, preview.from);
    const double reach = number_of(form, "reach").value_or(preview.reach);
    const double toward = at - reach > 0.0 ? at - reach : at + reach;
    shape.handles.push_back({.name = "deform.reach",
                             .point = point_at(preview.axis.rest, toward),
                             .path = HandlePath::Track,
                             .track = preview.axis.rest,
                             .look = HandleLook::Ring,
                             .help = "Change how far the branch bends from the place"});
    return shape;
}

std::vector<FieldText> deform_texts(const BranchPreview& preview, std::size_t handle,
                                    const Vec3& to) {
    if (preview.axis.rest.size() < 2) return {};
    if (handle == kMoves) {
        const Vec3 move = rounded_place(to - preview.from);
        return {{"move", to_text(Value(move))}};
    }
    const double at = abscissa_of(preview.axis.rest, preview.from),
                 there = abscissa_of(preview.axis.rest, to);
    return {{"reach", to_text(Value(rounded_length(std::max(kLeastReach, std::abs(at - there)))))}};
}

void DeformSearch::forget() {
    task_.forget();
    asked_.reset();
    asked_surface_ = {};
    preview_.reset();
}

void DeformSearch::update(const Surface* surface, const OperationForm* form) {
    const auto now = surface != nullptr && form != nullptr ? deformation_in(*form) : std::nullopt;
    if (!now) {
        if (asked_) forget();
        return;
    }
    if (task_.poll()) preview_ = task_.take();
    const bool same = same_surface(asked_surface_, *surface);
    if (same && asked_ == now) return;
    if (!same || !asked_ || asked_->at != now->at) {
        task_.forget();
        preview_.reset();
    }
    asked_ = now;
    asked_surface_ = *surface;
    task_.start_after([surface = *surface, deformation = *now](const Progress& progress) {
        return preview_of(surface, deformation, progress);
    });
}

}  // namespace vesselbench
