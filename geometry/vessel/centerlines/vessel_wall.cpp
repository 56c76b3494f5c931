#include "geometry/vessel/centerlines/vessel_wall.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <set>

#include "geometry/kernel/disjoint_sets.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/finite_positions.h"
#include "geometry/vessel/centerlines/flat_closures.h"

namespace vesselbench {
namespace {

/// Fraction of the directed edges that may occur twice before the orientation counts as
/// unknown.
constexpr double kOrientationDefects = 0.01;

Vec3 area_vector(const Positions& points, const Triangle& t) {
    return 0.5 * (points[t[1]] - points[t[0]]).cross(points[t[2]] - points[t[0]]);
}

Vec3 middle(const Positions& points, const Triangle& t) {
    return (points[t[0]] + points[t[1]] + points[t[2]]) / 3.0;
}

/// Centroid, normal and size of a nearly flat set of triangles; triangles that fold over count
/// negatively.
VesselEnd end_of(const Positions& points, std::span<const Triangle> triangles) {
    Vec3 sum = Vec3::Zero();
    for (const Triangle& t : triangles) sum += area_vector(points, t);
    const double area = sum.norm();
    VesselEnd end;
    if (!(area > 0.0)) {
        for (const Triangle& t : triangles) {
            end.centre += middle(points, t) / static_cast<double>(triangles.size());
        }
        return end;
    }
    end.outward = sum / area;
    for (const Triangle& t : triangles) {
        end.centre += area_vector(points, t).dot(end.outward) / area * middle(points, t);
    }
    end.radius = std::sqrt(area / std::numbers::pi);
    return end;
}

/// Closes a loop by a fan over its mean point.
void close_loop(const std::vector<VertexId>& loop, VesselWall& wall) {
    if (loop.size() < 3) return;
    Vec3 mean = Vec3::Zero();
    for (const VertexId v : loop) mean += wall.points[v] / static_cast<double>(loop.size());
    const auto centre = static_cast<VertexId>(wall.points.size());
    wall.points.push_back(mean);
    const std::size_t first = wall.closed.size();
    for (std::size_t i = 0; i < loop.size(); ++i) {
        wall.closed.push_back({loop[(i + 1) % loop.size()], loop[i], centre});
    }
    wall.ends.push_back(end_of(wall.points, std::span(wall.closed).subspan(first)));
}

void collect_patches(const Surface& surface, VesselWall& wall) {
    std::vector<std::vector<Triangle>> caps(surface.patches.size());
    for (TriangleId t = 0; t < surface.triangle_count(); ++t) {
        const Triangle& triangle = surface.triangles()[t];
        wall.closed.push_back(triangle);
        if (surface.patch_of(t).kind == PatchKind::Wall) {
            wall.wall.push_back(triangle);
        } else {
            caps[(*surface.patch_labels)[t]].push_back(triangle);
        }
    }
    for (const auto& cap : caps) {
        if (!cap.empty()) wall.ends.push_back(end_of(surface.points(), cap));
    }
}

using DirectedEdge = std::pair<VertexId, VertexId>;

std::vector<DirectedEdge> directed_edges(std::span<const Triangle> triangles) {
    std::vector<DirectedEdge> edges;
    for (const Triangle& t : triangles) {
        for (std::size_t k = 0; k < 3; ++k) edges.emplace_back(t[k], t[(k + 1) % 3]);
    }
    std::sort(edges.begin(), edges.end());
    return edges;
}

std::size_t component_count(std::size_t vertex_count, std::span<const Triangle> triangles) {
    DisjointSets sets(vertex_count);
    for (const Triangle& t : triangles) {
        sets.join(t[0], t[1]);
        sets.join(t[0], t[2]);
    }
    std::set<VertexId> roots;
    for (const Triangle& t : triangles) roots.insert(sets.root(t[0]));
    return roots.size();
}

/// Determines the inside rule, and the number of handles if the closed triangles form a manifold.
void judge_connectivity(VesselWall& wall, const Progress& cancel) {
    constexpr std::size_t kTurns = 4096;  // a few milliseconds
    const auto edges = directed_edges(wall.closed);
    std::size_t repeated = 0;
    for (std::size_t i = 1; i < edges.size(); ++i) repeated += edges[i] == edges[i - 1] ? 1 : 0;
    const double defects = static_cast<double>(repeated) / static_cast<double>(edges.size());
    wall.rule = defects > kOrientationDefects ? InsideRule::Parity : InsideRule::Winding;
    bool manifold = repeated == 0;
    for (std::size_t i = 0; manifold && i < edges.size(); ++i) {
        if (i % kTurns == 0) cancel.check_cancelled();
        manifold = std::binary_search(edges.begin(), edges.end(),
                                      DirectedEdge(edges[i].second, edges[i].first));
    }
    if (!manifold) return;
    std::vector<std::uint8_t> used(wall.points.size(), 0);
    for (const Triangle& t : wall.closed)
        for (const VertexId v : t) used[v] = 1;
    const auto euler = static_cast<long>(std::ranges::count(used, 1)) -
                       static_cast<long>(edges.size() / 2) + static_cast<long>(wall.closed.size());
    const auto components = static_cast<long>(component_count(wall.points.size(), wall.closed));
    wall.handles = static_cast<int>(components - euler / 2);
}

void turn_outside(VesselWall& wall) {
    wall.volume = -wall.volume;
    for (Triangle& t : wall.wall) std::swap(t[1], t[2]);
    for (Triangle& t : wall.closed) std::swap(t[1], t[2]);
    for (VesselEnd& end : wall.ends) end.outward = -end.outward;
}

void separate_flat_closures(VesselWall& wall) {
    const auto discs = find_flat_closures(wall.points, wall.closed, *wall.distance).closures;
    std::vector<bool> flat(wall.closed.size(), false);
    for (const auto& disc : discs) {
        std::vector<Triangle> triangles;
        for (const TriangleId t : disc) {
            flat[t] = true;
            triangles.push_back(wall.closed[t]);
        }
        wall.ends.push_back(end_of(wall.points, triangles));
    }
    if (discs.empty()) return;
    wall.wall.clear();
    for (TriangleId t = 0; t < wall.closed.size(); ++t) {
        if (!flat[t]) wall.wall.push_back(wall.closed[t]);
    }
}

void measure(VesselWall& wall) {
    const Vec3 origin = wall.points[wall.closed.front()[0]];
    for (const Triangle& t : wall.closed) {
        wall.volume += area_vector(wall.points, t).dot(wall.points[t[0]] - origin) / 3.0;
    }
    if (wall.volume < 0.0) turn_outside(wall);
    for (const Triangle& t : wall.wall) wall.area += area_vector(wall.points, t).norm();
}

}  // namespace

VesselWall vessel_wall_of(const Surface& surface, const Progress& progress) {
    if (surface.empty()) throw InvalidInput("the surface is empty");
    VesselWall wall;
    wall.points = surface.points();
    require_near(wall.points);
    for (const auto& loop : surface.topology->boundary_loops()) close_loop(loop, wall);
    collect_patches(surface, wall);
    measure(wall);
    if (!(wall.area > 0.0)) {
        throw InvalidInput("the surface has no wall; all of its triangles are flat closures");
    }
    progress.report(0.0, "analysing the wall");
    judge_connectivity(wall, progress);
    progress.check_cancelled();
    wall.distance = std::make_shared<const SurfaceDistance>(distance_to(wall.points, wall.closed));
    progress.check_cancelled();
    if (wall.ends.empty()) separate_flat_closures(wall);
    return wall;
}

double thin_radius(const VesselWall& wall, double fraction) {
    constexpr double kRays = 2000.0;
    std::vector<double> radii;
    double passed = 0.0;
    double next = 0.5 * wall.area / kRays;
    for (const Triangle& t : wall.wall) {
        const Vec3 a = area_vector(wall.points, t);
        passed += a.norm();
        if (passed < next) continue;
        while (next <= passed) next += wall.area / kRays;
        const Vec3 n = a.normalized();
        const double skin = 1e-3 * std::sqrt(a.norm());
        const Vec3 p = middle(wall.points, t);
        const auto hit = wall.distance->first_hit(p - skin * n, -n);
        if (hit && hit->distance > skin) radii.push_back(0.5 * (hit->distance + skin));
    }
    if (radii.empty()) return 2.0 * wall.volume / wall.area;
    const auto at = static_cast<std::ptrdiff_t>(fraction * static_cast<double>(radii.size()));
    std::nth_element(radii.begin(), radii.begin() + at, radii.end());
    return radii[static_cast<std::size_t>(at)];
}

}  // namespace vesselbench
