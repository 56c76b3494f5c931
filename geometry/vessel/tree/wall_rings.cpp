#include "geometry/vessel/tree/wall_rings.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <tbb/parallel_for.h>

#include "geometry/kernel/cross_section.h"
#include "geometry/kernel/statistics.h"
#include "geometry/kernel/surface_distance.h"
#include "geometry/vessel/centerlines/branch_queries.h"

namespace vesselbench {

namespace {

constexpr std::size_t kAngles = 32;
constexpr double kSpacing = 0.2;   ///< of rings, in median radii of the branch
constexpr double kFarthest = 4.0;  ///< what is farther from the axis is no wall [radii]
constexpr double kBulge = 1.8;     ///< a wall so many times farther than the median is a bulge
constexpr double kAtTip = 1.0;     ///< stretch at a tip that is left out [tip radii]

/// Arc length at one end of the branch that is not a vessel by itself [mm].
double left_out(const CenterlineGraph& graph, std::size_t branch, std::size_t node) {
    return graph.nodes[node].is_tip() ? kAtTip * tip_radius(graph, node)
                                      : furcation_zone_end(graph, branch, node);
}

void measure(WallRing& ring, const Surface& surface, const SurfaceDistance& wall, double reach) {
    std::vector<double> found;
    ring.distances.assign(kAngles, std::numeric_limits<double>::infinity());
    for (std::size_t k = 0; k < kAngles; ++k) {
        const auto hit = wall.first_hit(ring.centre, ring.direction(k), reach);
        if (!hit || surface.patch_of(hit->triangle).kind != PatchKind::Wall) continue;
        ring.distances[k] = hit->distance;
        found.push_back(hit->distance);
    }
    if (found.empty()) return;
    const double most = kBulge * median(found);
    std::erase_if(found, [&](double d) { return d > most; });
    double squared = 0.0;
    for (const double d : found) squared += d * d;
    const auto count = static_cast<double>(found.size());
    ring.radius = std::sqrt(squared / count);
    ring.aside = 1.0 - count / kAngles;
}

}  // namespace

Vec3 WallRing::direction(std::size_t angle) const {
    const double turn =
        2.0 * std::numbers::pi * static_cast<double>(angle) / static_cast<double>(distances.size());
    return std::cos(turn) * first + std::sin(turn) * tangent.cross(first);
}

std::vector<WallRing> wall_rings(const Surface& surface, const CenterlineGraph& graph,
                                 std::size_t branch, const Progress& progress) {
    const CenterlineBranch& line = graph.branches[branch];
    const double from = left_out(graph, branch, line.start_node);
    const double to = branch_length(line) - left_out(graph, branch, line.end_node);
    const double radius = median(line.radii);
    std::vector<WallRing> rings;
    if (!(from < to) || !(radius > 0.0)) return rings;
    const auto count = static_cast<std::size_t>(1.0 + (to - from) / (kSpacing * radius));
    rings.resize(count);
    const double reach = kFarthest * *std::ranges::max_element(line.radii);
    const SurfaceDistance wall = distance_to(surface);
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
        progress.check_cancelled();
        WallRing& ring = rings[i];
        ring.along = from + kSpacing * radius * static_cast<double>(i);
        ring.centre = point_at(line, ring.along);
        ring.tangent = tangent_at(line, ring.along, radius);
        ring.first = plane_axes(ring.tangent).first;
        measure(ring, surface, wall, reach);
    });
    return rings;
}

}  // namespace vesselbench
