#include "workbench/window/features/handles/cut_handles.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

#include "geometry/kernel/wording.h"
#include "geometry/vessel/openings/opening_names.h"
#include "workbench/case/argument_texts.h"
#include "workbench/operations/shared/opening_arguments.h"

namespace vesselbench {

namespace {

constexpr std::size_t kSlides = 0;       ///< index of the handle
constexpr double kArm = 1.0;             ///< of the tilting handle, in diameters [-]
constexpr double kSnapDeg = 2.5;         ///< a smaller tilt is none
constexpr double kMostTiltDeg = 60.0;    ///< a plane that is tilted more hardly cuts a vessel off
constexpr double kShownTiltDeg = 1.0;    ///< what follows from noise is not shown
constexpr double kLeastDistance = 0.01;  ///< from the tip and from the branch's end [mm]
constexpr double kNormalSteps = 1e9;     ///< so that a rounded normal is still unit

double radians(double degrees) {
    return degrees * std::numbers::pi / 180.0;
}

/// The only opening that the form gives as a plane.
std::optional<OpeningPlace> typed_place(const OperationForm& form) {
    const std::vector<PlannedOpening> openings = openings_in(records_of(form, "planes"));
    return openings.size() == 1 ? std::optional(openings.front().place) : std::nullopt;
}

std::optional<Plane> typed_plane(const OperationForm& form) {
    const auto place = typed_place(form);
    return place ? std::optional(place->plane) : std::nullopt;
}

std::optional<std::string> given_text(const OperationForm& form, const std::string& parameter) {
    const std::string text = text_of(form, parameter);
    return text.empty() ? std::nullopt : std::optional(text);
}

Vec3 turned(const Vec3& direction, const Vec3& from, const Vec3& to) {
    return Eigen::Quaterniond::FromTwoVectors(from, to) * direction;
}

/// The kind and name of the opening: as typed, as they are, or by size.
Patch patch_of(const OperationForm& form, const Cut& cut) {
    const auto kind = given_text(form, "kind"), name = given_text(form, "name");
    if (kind || name) return chosen_patch(cut.branch->patch, kind, name);
    if (cut.branch->patch) return *cut.branch->patch;
    const std::vector<Patch>& patches = cut.branch->surface.patches;
    const bool has_inlet = std::ranges::count(patches, PatchKind::Inlet, &Patch::kind) > 0;
    const PatchKind missing = has_inlet ? PatchKind::Outlet : PatchKind::Inlet;
    return {free_patch_name(to_string(missing), has_inlet ? 1 : 0, patches), missing};
}

std::vector<FieldText> plane_texts(const OperationForm& form, const Cut& cut, const Plane& plane) {
    const Vec3 normal = (plane.normal * kNormalSteps).array().round() / kNormalSteps + 0.0;
    const PlannedOpening opening{
        .place = {.tip = rounded_place(cut.branch->graph->nodes[cut.branch->tip].position),
                  .plane = {rounded_place(plane.point), normal}},
        .patch = patch_of(form, cut)};
    return {{"distance", ""},
            {"radii", ""},
            {"planes", to_text(Value(planes_argument({&opening, 1})))},
            {"names", to_text(Value(names_argument({&*opening.patch, 1})))}};
}

std::vector<FieldText> distance_texts(const Cut& cut, double distance) {
    const double most = std::max(cut.branch->length - kLeastDistance, kLeastDistance);
    const double kept = std::clamp(rounded_length(distance), kLeastDistance, most);
    return {{"distance", to_text(Value(kept))}, {"radii", ""}, {"planes", ""}, {"names", ""}};
}

std::vector<FieldText> slid_texts(const OperationForm& form, const Cut& cut, double distance) {
    const auto plane = typed_plane(form);
    if (!plane) return distance_texts(cut, distance);
    const CutBranch& branch = *cut.branch;
    const Vec3 before = branch.outward(branch.distance_of(plane->point));
    return plane_texts(form, cut,
                       {branch.place(distance),
                        turned(plane->normal, before, branch.outward(distance)).normalized()});
}

/// At most the largest tilt away from the perpendicular direction.
Vec3 limited(const Vec3& normal, const Vec3& perpendicular) {
    const Eigen::AngleAxisd turn(Eigen::Quaterniond::FromTwoVectors(perpendicular, normal));
    if (turn.angle() <= radians(kMostTiltDeg)) return normal;
    return Eigen::AngleAxisd(radians(kMostTiltDeg), turn.axis()) * perpendicular;
}

std::vector<FieldText> tilted_texts(const OperationForm& form, const Cut& cut, const Vec3& to) {
    const Plane plane = typed_plane(form).value_or(cut.plane);
    const double distance = cut.branch->distance_of(plane.point);
    const Vec3 perpendicular = typed_plane(form) ? cut.branch->outward(distance) : cut.plane.normal;
    const Vec3 normal = (to - plane.point).normalized();
    if (normal.dot(perpendicular) > std::cos(radians(kSnapDeg)))
        return distance_texts(cut, distance);
    return plane_texts(form, cut, {plane.point, limited(normal, perpendicular)});
}

/// Where the plane is on the centerline as the form says, which may be ahead of the found cut.
double shown_distance(const OperationForm& form, const Cut& cut) {
    if (const auto plane = typed_plane(form)) return cut.branch->distance_of(plane->point);
    return number_of(form, "distance").value_or(cut.distance);
}

std::string cut_text(const Cut& cut) {
    std::string text = "diameter " + formatted(cut.diameter, "%.2f mm, area ") +
                       formatted(cut.area, "%.1f mm\u00B2");
    if (cut.tilt_deg >= kShownTiltDeg) text += formatted(cut.tilt_deg, ", tilted %.0f\u00B0");
    return text;
}

}  // namespace

std::optional<CutQuestion> cut_question(const OperationForm& form) {
    if (!text_of(form, "planes").empty()) {
        const auto place = typed_place(form);
        if (!place) return std::nullopt;
        return CutQuestion{.tip = point_of(form, "tip").value_or(place->tip),
                           .plane = place->plane};
    }
    const auto tip = point_of(form, "tip");
    if (!tip) return std::nullopt;
    return CutQuestion{
        .tip = tip, .distance = number_of(form, "distance"), .radii = number_of(form, "radii")};
}

FormShape cut_shape(const OperationForm& form, const Cut& cut) {
    FormShape shape;
    if (!cut.branch) return shape;
    shape.lines.push_back({.points = cut.branch->track, .faint = true});
    if (!cut.ring.empty()) {
        shape.lines.push_back({.points = cut.ring, .closed = true, .in_front = true});
        shape.notes.push_back({.point = cut.plane.point, .text = cut_text(cut), .below = true});
    }
    const double distance = shown_distance(form, cut);
    shape.handles.push_back({.name = "cut.slide",
                             .point = cut.branch->place(distance),
                             .path = HandlePath::Track,
                             .track = cut.branch->track,
                             .look = HandleLook::Ring,
                             .help = "Slide the cut along the centerline"});
    if (cut.ring.empty()) return shape;
    const Plane plane = typed_plane(form).value_or(cut.plane);
    const Vec3 tilting = plane.point + kArm * cut.diameter * plane.normal;
    shape.lines.push_back({.points = {plane.point, tilting}});
    shape.handles.push_back({.name = "cut.tilt",
                             .point = tilting,
                             .path = HandlePath::Ball,
                             .pivot = plane.point,
                             .help = "Tilt the cut"});
    return shape;
}

std::vector<FieldText> cut_texts(const OperationForm& form, const Cut& cut, std::size_t handle,
                                 const Vec3& to) {
    if (!cut.branch) return {};
    if (handle == kSlides) return slid_texts(form, cut, cut.branch->distance_of(to));
    return tilted_texts(form, cut, to);
}

}  // namespace vesselbench
