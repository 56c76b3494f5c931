#include "geometry/vessel/openings/fading_ends.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/vessel/centerlines/branch_queries.h"
#include "geometry/vessel/openings/opening_axis.h"

namespace vesselbench {

namespace {

constexpr int kSamples = 24;
/// The stretch that is looked at [radii of the tip].
constexpr double kFrom = 0.5, kTo = 6.0;
/// Gap [diameters] and angle [deg] of ends that face each other.
constexpr double kLongestGap = 3.0;
constexpr double kFacingDeg = 45.0;

double voxels_across(const Vec3& direction, const VoxelEdges& voxels) {
    double widest = 0.0;
    for (Eigen::Index i = 0; i < 3; ++i)
        widest = std::max(widest, direction.cross(voxels.col(i)).norm());
    return widest;
}

/// True if `to` lies where the vessel points that ends at the tip.
bool points_at(const CenterlineGraph& graph, std::size_t tip, const Vec3& to) {
    const Vec3 way = outward_direction(graph, tip, 0.0, 2.0 * tip_radius(graph, tip));
    return angle_deg(way, to - graph.nodes[tip].position) < kFacingDeg;
}

bool face(const CenterlineGraph& graph, const SurfaceEnd& a, const SurfaceEnd& b) {
    const Vec3 &p = graph.nodes[*a.tip].position, &q = graph.nodes[*b.tip].position;
    return (p - q).norm() < kLongestGap * 0.5 * (a.diameter + b.diameter) &&
           points_at(graph, *a.tip, q) && points_at(graph, *b.tip, p);
}

}  // namespace

VoxelWidth width_at_tip(const CenterlineGraph& graph, std::size_t tip, const VoxelEdges& voxels) {
    const std::size_t index = branch_of_tip(graph, tip);
    const CenterlineBranch& branch = graph.branches[index];
    const double zone = furcation_zone_end(graph, index, other_node(graph, index, tip));
    const double own = branch_length(branch) - zone, radius = tip_radius(graph, tip);
    const auto diameter_at = [&](double s) {
        return 2.0 * radius_at(branch, place_from_node(graph, index, tip, s).abscissa);
    };
    const auto voxels_at = [&](double s) {
        return voxels_across(outward_direction(graph, tip, s), voxels);
    };
    const double to = std::min(kTo * radius, own), from = std::min(kFrom * radius, 0.5 * to);
    VoxelWidth width;
    std::array<double, kSamples> ratios{};
    for (int i = 0; i < kSamples; ++i) {
        const double s = from + (to - from) * (i + 0.5) / kSamples;
        width.diameter += diameter_at(s) / kSamples;
        width.voxels += voxels_at(s) / kSamples;
        const double anywhere = own * (i + 0.5) / kSamples;
        ratios[i] = diameter_at(anywhere) / voxels_at(anywhere);
    }
    const auto quarter = ratios.begin() + kSamples / 4;
    std::ranges::nth_element(ratios, quarter);
    width.lower_quartile = *quarter;
    return width;
}

std::vector<std::optional<std::size_t>> facing_ends(const std::vector<SurfaceEnd>& ends,
                                                    const CenterlineGraph& graph) {
    std::vector<std::optional<std::size_t>> facing(ends.size());
    const auto is_closed = [](const SurfaceEnd& end) { return end.tip && !end.is_visible(); };
    for (std::size_t a = 0; a < ends.size(); ++a)
        for (std::size_t b = a + 1; b < ends.size(); ++b)
            if (is_closed(ends[a]) && is_closed(ends[b]) && face(graph, ends[a], ends[b])) {
                facing[a] = b;
                facing[b] = a;
            }
    return facing;
}

}  // namespace vesselbench
