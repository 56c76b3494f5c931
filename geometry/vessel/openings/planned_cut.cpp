#include "geometry/vessel/openings/planned_cut.h"

#include <algorithm>
#include <cmath>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/same_surface.h"
#include "geometry/vessel/centerlines/branch_queries.h"
#include "geometry/vessel/centerlines/centerlines.h"
#include "geometry/vessel/centerlines/lines_to_tip.h"
#include "geometry/vessel/openings/opening_axis.h"
#include "geometry/vessel/openings/opening_names.h"
#include "geometry/vessel/openings/openings.h"

namespace vesselbench {

namespace {

/// A point so near to a tip means it; otherwise it gets a line of its own [radii of the tip].
constexpr double kTipReach = 2.0;
/// A part of the surface so far around the tip has every place that choose_opening_place looks at
/// [radii of the tip].
constexpr double kPartReach = 20.0;
/// A cap that is kept is shown by a section just behind it [diameters].
constexpr double kBehindCap = 0.01;

std::optional<Patch> cap_at(const Surface& surface, const Vec3& tip) {
    const auto patch = nearest_opening(surface, tip);
    if (!patch || surface.patches[*patch].kind == PatchKind::Cut) return std::nullopt;
    const PatchShape shape = patch_shape(surface, *patch);
    if ((shape.plane.point - tip).norm() > kEndReach * shape.diameter()) return std::nullopt;
    return surface.patches[*patch];
}

std::shared_ptr<const CutBranch> cut_branch(const Surface& surface, const Vec3& tip,
                                            const Progress& progress) {
    auto found = std::make_shared<CutBranch>();
    found->surface = surface;
    found->asked = tip;
    found->graph = lines_for_openings(surface, tip, progress);
    const auto node_at = nearest_tip(*found->graph, tip);
    if (!node_at) throw AlgorithmFailure("the vessels have no end that could be cut");
    found->tip = *node_at;
    const CenterlineNode& node = found->graph->nodes[found->tip];
    const CenterlineBranch& branch = found->graph->branches[node.branches.front()];
    found->radius = tip_radius(*found->graph, found->tip);
    found->part = part_near(surface, node.position, kPartReach * found->radius);
    found->track = branch.points;
    if (branch.start_node != found->tip) std::ranges::reverse(found->track);
    found->length = branch_length(branch);
    found->patch = cap_at(surface, node.position);
    return found;
}

Plane chosen_plane(const CutBranch& branch, const CutQuestion& question) {
    if (question.plane) return *question.plane;
    if (question.tip) static_cast<void>(tip_to_open(*branch.graph, *question.tip));
    auto distance = question.distance;
    if (question.radii) distance = *question.radii * branch.radius;
    if (distance)
        return choose_opening_place(branch.part, *branch.graph, branch.tip, distance).plane;
    const OpeningPlan plan = plan_openings(branch.surface, *branch.graph, {.tip = question.tip});
    const PlannedOpening& opening = plan.openings.front();
    Plane plane = opening.place.plane;
    if (opening.way != OpeningWay::Cut)
        plane.point -= kBehindCap * opening.place.diameter * plane.normal;
    return plane;
}

Cut measured(Cut cut, const Plane& plane) {
    cut.plane = plane;
    cut.distance = cut.branch->distance_of(plane.point);
    cut.tilt_deg = angle_deg(plane.normal, cut.branch->outward(cut.distance));
    const auto section = cross_section_at(cut.branch->surface, plane);
    if (!section || !section->closed) {
        cut.problem = "the plane does not cut the vessel in a closed curve";
        return cut;
    }
    cut.ring = section->points;
    cut.area = std::abs(section->area);
    cut.diameter = section->diameter();
    return cut;
}

}  // namespace

std::shared_ptr<const CenterlineGraph> lines_for_openings(const Surface& surface,
                                                          const std::optional<Vec3>& tip,
                                                          const Progress& progress) {
    return tip ? lines_to_tip(surface, *tip, kTipReach, progress)
               : centerlines_of(surface, {}, progress);
}

bool CutQuestion::operator==(const CutQuestion& other) const {
    if (plane.has_value() != other.plane.has_value()) return false;
    const bool same_plane =
        !plane || (plane->point == other.plane->point && plane->normal == other.plane->normal);
    return same_plane && tip == other.tip && distance == other.distance && radii == other.radii;
}

Vec3 CutBranch::place(double distance) const {
    const std::size_t branch = branch_of_tip(*graph, tip);
    const BranchPlace at = place_from_node(*graph, branch, tip, distance);
    return point_at(graph->branches[branch], at.abscissa);
}

Vec3 CutBranch::outward(double distance) const {
    return outward_direction(*graph, tip, std::clamp(distance, 0.0, length), radius);
}

double CutBranch::distance_of(const Vec3& point) const {
    const std::size_t branch = branch_of_tip(*graph, tip);
    const auto nearest = nearest_place(*graph, branch, point);
    return nearest ? distance_from_node(*graph, nearest->place, tip) : 0.0;
}

Cut find_cut(const Surface& surface, const CutQuestion& question,
             const std::shared_ptr<const CutBranch>& known, const Progress& progress) {
    Cut cut;
    try {
        const Vec3 tip =
            question.tip.value_or(question.plane ? question.plane->point : Vec3(Vec3::Zero()));
        const bool same = known && same_surface(known->surface, surface) && known->asked == tip;
        cut.branch = same ? known : cut_branch(surface, tip, progress);
        return measured(cut, chosen_plane(*cut.branch, question));
    } catch (const Cancelled&) {
        throw;
    } catch (const std::exception& error) {
        cut.problem = error.what();
    }
    return cut;
}

}  // namespace vesselbench
