#include "meshing/remeshing/local_radius.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "geometry/kernel/lumen_width.h"
#include "geometry/kernel/measure.h"
#include "geometry/kernel/statistics.h"
#include "geometry/kernel/surface_distance.h"
#include "meshing/remeshing/vertex_fields.h"

namespace vesselbench {

namespace {

constexpr std::size_t kMostRayVertices = 8000;  // the others are filled in from their neighbours
constexpr double kBlindTip = 2.0;               // a tip belongs to an opening within 2 radii of it

struct LinePoint {
    Vec3 position;
    double radius;
};

struct Opening {
    Vec3 centroid;
    double radius;  ///< of the circle of the same area [mm]
};

Opening opening_of(const Positions& points, const std::vector<Triangle>& triangles) {
    Vec3 normal = Vec3::Zero(), centroid = Vec3::Zero();
    double area = 0.0;
    for (const Triangle& triangle : triangles) {
        const Vec3 n = area_normal(points, triangle);
        normal += n;
        area += n.norm();
        for (const VertexId v : triangle) centroid += n.norm() / 3.0 * points[v];
    }
    return {centroid / std::max(area, 1e-300), std::sqrt(0.5 * normal.norm() / std::numbers::pi)};
}

/// Caps and open boundaries.
std::vector<Opening> openings_of(const Surface& surface) {
    std::vector<std::vector<Triangle>> parts(surface.patches.size());
    for (TriangleId t = 0; t < surface.triangle_count(); ++t)
        if (surface.patch_of(t).kind != PatchKind::Wall)
            parts[(*surface.patch_labels)[t]].push_back(surface.triangles()[t]);
    for (const auto& loop : surface.topology->boundary_loops()) {
        parts.emplace_back();
        for (std::size_t i = 1; i + 1 < loop.size(); ++i)
            parts.back().push_back({loop[0], loop[i + 1], loop[i]});
    }
    std::vector<Opening> openings;
    for (const auto& part : parts)
        if (!part.empty()) openings.push_back(opening_of(surface.points(), part));
    return openings;
}

bool is_blind(const CenterlineNode& node, const std::vector<Opening>& openings) {
    return node.is_tip() && std::none_of(openings.begin(), openings.end(), [&](const Opening& o) {
               return (o.centroid - node.position).norm() <=
                      kBlindTip * std::max(o.radius, node.radius);
           });
}

/// Largest radius of a branch: for a blind branch (a sac) that of its parent vessel, for a vessel a
/// quarter more than its typical one, so that a bulge on it does not count either.
double branch_limit(const CenterlineGraph& lines, std::size_t b,
                    const std::vector<Opening>& openings) {
    const CenterlineBranch& branch = lines.branches[b];
    const auto usual = [&](std::size_t i) { return 1.25 * median(lines.branches[i].radii); };
    for (const auto& [tip, root] : {std::pair(branch.start_node, branch.end_node),
                                    std::pair(branch.end_node, branch.start_node)}) {
        if (!is_blind(lines.nodes[tip], openings) || openings.empty()) continue;
        double parent = 0.0;
        for (const std::size_t other : lines.nodes[root].branches)
            if (other != b && !lines.branches[other].radii.empty())
                parent = std::max(parent, usual(other));
        if (parent > 0.0) return std::min(parent, usual(b));
    }
    return usual(b);
}

std::vector<LinePoint> line_points(const CenterlineGraph& lines,
                                   const std::vector<Opening>& openings) {
    constexpr double kSpacing = 0.2;  // in radii: finer changes nothing
    std::vector<LinePoint> result;
    for (std::size_t b = 0; b < lines.branches.size(); ++b) {
        const CenterlineBranch& branch = lines.branches[b];
        if (branch.points.empty()) continue;
        const double limit = branch_limit(lines, b, openings);
        for (std::size_t i = 0; i < branch.points.size(); ++i) {
            const double radius = std::min(branch.radii[i], limit);
            const bool is_end = i == 0 || i + 1 == branch.points.size();
            if (is_end || (branch.points[i] - result.back().position).norm() >= kSpacing * radius)
                result.push_back({branch.points[i], radius});
        }
    }
    return result;
}

std::vector<double> radii_from_lines(const Surface& surface, const std::vector<LinePoint>& line,
                                     const Progress& cancel) {
    std::vector<double> radii(surface.vertex_count());
    tbb::parallel_for(std::size_t{0}, radii.size(), [&](std::size_t v) {
        cancel.check_cancelled();
        double nearest = std::numeric_limits<double>::infinity();
        for (const auto& [position, radius] : line) {
            const double distance = (surface.points()[v] - position).norm() - radius;
            if (distance >= nearest) continue;
            nearest = distance;
            radii[v] = radius;
        }
    });
    return radii;
}

std::vector<double> radii_from_rays(const Surface& surface, double limit, const Progress& cancel) {
    const SurfaceDistance search = distance_to(surface);
    cancel.check_cancelled();
    const Positions normals = wall_normals(surface);
    const double farthest = bounds(surface).diagonal();
    const std::size_t stride = surface.vertex_count() / kMostRayVertices + 1;
    std::vector<double> radii(surface.vertex_count(), 0.0);
    tbb::parallel_for(std::size_t{0}, (radii.size() + stride - 1) / stride, [&](std::size_t i) {
        cancel.check_cancelled();
        const std::size_t v = i * stride;
        const auto width = lumen_width(search, surface.points()[v], -normals[v], farthest);
        if (width) radii[v] = std::min(limit, 0.5 * *width);
    });
    fill_zeros(*surface.topology, radii);
    cancel.check_cancelled();
    average(*surface.topology, 5, radii);
    return radii;
}

/// On caps, rays and lines say nothing about the wall: the rim's mean is used.
void take_from_rims(const Surface& surface, std::vector<double>& radii) {
    const VertexCaps caps = caps_of_vertices(surface);
    std::vector<double> sum(surface.patches.size(), 0.0), count(surface.patches.size(), 0.0);
    for (std::size_t v = 0; v < radii.size(); ++v)
        if (caps.patch[v] > 0 && caps.on_rim[v]) {
            sum[caps.patch[v]] += radii[v];
            count[caps.patch[v]] += 1.0;
        }
    for (std::size_t v = 0; v < radii.size(); ++v)
        if (caps.patch[v] > 0 && count[caps.patch[v]] > 0.0)
            radii[v] = sum[caps.patch[v]] / count[caps.patch[v]];
}

}  // namespace

std::vector<double> local_radii(const Surface& surface, const CenterlineGraph* lines,
                                const Progress& progress) {
    progress.report(0.0, "measuring the vessel's radius");
    const std::vector<Opening> openings = openings_of(surface);
    double limit = openings.empty() ? std::numeric_limits<double>::infinity() : 0.0;
    for (const Opening& opening : openings) limit = std::max(limit, opening.radius);
    const auto line = lines ? line_points(*lines, openings) : std::vector<LinePoint>{};
    std::vector<double> radii = line.empty() ? radii_from_rays(surface, limit, progress)
                                             : radii_from_lines(surface, line, progress);
    progress.check_cancelled();
    take_from_rims(surface, radii);
    return radii;
}

}  // namespace vesselbench
