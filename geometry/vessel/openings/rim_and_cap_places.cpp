#include "geometry/vessel/openings/rim_and_cap_places.h"

#include <algorithm>

#include "geometry/kernel/wording.h"
#include "geometry/vessel/openings/opening_axis.h"
#include "geometry/vessel/openings/rim_shape.h"

namespace vesselbench {

namespace {

/// A cap at an image's border, and any cap if ends are cut strictly, is kept if it is perpendicular
/// to its vessel within this angle [deg] and, if strict, flat to this fraction of its diameter.
constexpr double kKeptTiltDeg = 3.0;
constexpr double kStrictTiltDeg = 2.0;
constexpr double kStrictFlatness = 1e-5;
/// Least rise of the wall at a flat rim where a centerline ends [deg]; elsewhere kLeastRiseDeg.
constexpr double kLeastRiseAtTip = 30.0;
/// A rim is cut off along its own plane if it is no farther from it than this [diameters].
constexpr double kMostTorn = 0.5;
/// A rim without a whole section behind it is bent into its plane if it is no farther from it than
/// this [diameters]: more would fold the wall beside it.
constexpr double kMostBent = 0.3;
/// That cut lies behind the rim's deepest notch by this much [diameters].
constexpr double kBehindRim = 0.02;

OpeningPlace place_on(const Plane& plane, double diameter, const Vec3& tip,
                      const std::optional<OpeningAxis>& axis) {
    return {.tip = tip,
            .plane = plane,
            .diameter = diameter,
            .tilt_deg = axis ? axis->tilt_deg : 0.0,
            .bend_deg = axis ? axis->bend_deg : 0.0,
            .measured = axis.has_value()};
}

/// False for the plate that an image's border leaves where it grazes a bulge.
bool rises(const Surface& surface, std::size_t patch) {
    const auto rim = rim_shape_of_cap(surface, patch);
    return !rim || rim->rise_deg > kLeastRiseAtTip;
}

std::optional<OpeningPlace> kept_cap(const PlanDraft& draft, std::size_t e) {
    const SurfaceEnd& end = draft.ends()[e];
    const Surface& surface = draft.surface();
    const PatchShape shape = patch_shape(surface, *end.patch);
    const auto axis = axis_at_patch(surface, *end.patch);
    const double tilt = axis ? axis->tilt_deg : 90.0;
    const bool meant =
        !draft.options().border_cuts || surface.patches[*end.patch].kind != PatchKind::Cut;
    const bool good =
        draft.options().strict
            ? end.tip && shape.flatness <= kStrictFlatness * shape.diameter() &&
                  tilt <= kStrictTiltDeg
            : is_flat(shape) && (meant || (tilt <= kKeptTiltDeg && rises(surface, *end.patch)));
    if (!good) return std::nullopt;
    return place_on(shape.plane, shape.diameter(), draft.tip_place(e), axis);
}

std::optional<OpeningPlace> kept_rim(const PlanDraft& draft, std::size_t e) {
    const SurfaceEnd& end = draft.ends()[e];
    if (end.rim.empty() || draft.options().strict) return std::nullopt;
    RimShape rim = rim_shape(draft.surface(), end.rim);
    // A centerline ends there: the rim may lie in a wide mouth, such as a heart valve's.
    if (end.tip && rim.rise_deg > kLeastRiseAtTip)
        rim.rise_deg = std::max(rim.rise_deg, kLeastRiseDeg + 1.0);
    if (!rim.is_good()) return std::nullopt;
    const double diameter = rim.diameter();
    const auto axis = axis_inward(part_near(draft.surface(), rim.plane.point, 2.5 * diameter),
                                  rim.plane, diameter);
    return place_on(rim.plane, diameter, draft.tip_place(e), axis);
}

}  // namespace

std::optional<OpeningPlace> kept_place(const PlanDraft& draft, std::size_t e) {
    return draft.ends()[e].patch ? kept_cap(draft, e) : kept_rim(draft, e);
}

std::string end_problem(const PlanDraft& draft, std::size_t e) {
    const SurfaceEnd& end = draft.ends()[e];
    if (draft.is_fixed() || !end.is_visible()) return "";
    if (end.patch) {
        const PatchShape shape = patch_shape(draft.surface(), *end.patch);
        return is_flat(shape) ? "its cap is not perpendicular to the vessel"
                              : "its cap is " + formatted(shape.flatness) + " mm off its plane";
    }
    const RimShape rim = rim_shape(draft.surface(), end.rim);
    if (rim.rise_deg <= (end.tip ? kLeastRiseAtTip : kLeastRiseDeg))
        return "its wall rises by only " + formatted(rim.rise_deg, "%.0f degrees") +
               " from the rim's plane";
    return "its rim is " + formatted(rim.flatness) + " mm off its plane";
}

std::optional<OpeningPlace> oblique_cap_place(const PlanDraft& draft, std::size_t e) {
    const std::size_t patch = *draft.ends()[e].patch;
    const PatchShape shape = patch_shape(draft.surface(), patch);
    if (!is_flat(shape) || !rises(draft.surface(), patch)) return std::nullopt;
    return place_on(shape.plane, shape.diameter(), draft.tip_place(e),
                    axis_at_patch(draft.surface(), patch));
}

std::optional<OpeningPlace> place_along_rim(const PlanDraft& draft, std::size_t e) {
    const SurfaceEnd& end = draft.ends()[e];
    const Surface& surface = draft.surface();
    if (end.rim.empty()) return std::nullopt;
    const RimShape rim = rim_shape(surface, end.rim);
    if (rim.rise_deg <= kLeastRiseDeg || rim.flatness > kMostTorn * rim.diameter())
        return std::nullopt;
    double depth = 0.0;
    for (const VertexId v : end.rim)
        depth = std::max(depth, -rim.plane.distance(surface.points()[v]));
    depth += kBehindRim * rim.diameter();
    Plane plane{rim.plane.point - depth * rim.plane.normal, rim.plane.normal};
    const auto section = cross_section_at(surface, plane);
    if (!section || !section->closed) return std::nullopt;
    plane.point = section->centroid;
    OpeningPlace place = place_on(
        plane, section->diameter(), draft.tip_place(e),
        axis_inward(part_near(surface, plane.point, 2.5 * rim.diameter()), plane, rim.diameter()));
    place.distance = depth;
    return place;
}

std::optional<OpeningPlace> bent_rim_place(const PlanDraft& draft, std::size_t e) {
    const SurfaceEnd& end = draft.ends()[e];
    if (end.rim.empty()) return std::nullopt;
    const RimShape rim = rim_shape(draft.surface(), end.rim);
    if (rim.rise_deg <= kLeastRiseDeg || rim.flatness > kMostBent * rim.diameter())
        return std::nullopt;
    return place_on(rim.plane, rim.diameter(), draft.tip_place(e), std::nullopt);
}

}  // namespace vesselbench
