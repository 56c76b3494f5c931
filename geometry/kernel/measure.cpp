#include "geometry/kernel/measure.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>

#include "geometry/kernel/edges.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/mean_curvature.h"
#include "geometry/kernel/self_intersections.h"
#include "geometry/kernel/surface_key.h"
#include "geometry/kernel/triangle_shape.h"

namespace vesselbench {

namespace {

Spread edge_lengths(const Surface& surface, const EdgeTable& table) {
    SpreadBuilder lengths;
    for (const auto& [a, b] : table.edges)
        lengths.add((surface.points()[a] - surface.points()[b]).norm());
    return lengths.result();
}

Connectivity connectivity(const Topology& topology, const EdgeTable& table) {
    Connectivity result;
    const ManifoldDefects defects = manifold_defects(topology, table);
    result.components = connected_components(topology).count();
    result.boundary_loops = topology.boundary_loops().size();
    result.non_manifold_edges = defects.edges.size();
    result.non_manifold_vertices = defects.vertices.size();
    result.inconsistent_edges = defects.inconsistent_edges.size();
    result.closed = true;
    for (std::size_t e = 0; e < table.edges.size() && result.closed; ++e)
        result.closed = table.half_edges.row(e).size() > 1;
    result.manifold =
        defects.edges.empty() && defects.vertices.empty() && defects.degenerate.empty();
    result.oriented = result.manifold && defects.inconsistent_edges.empty();
    if (result.oriented) {
        const auto& rings = topology.rings();
        int used = 0;
        for (std::size_t v = 0; v < topology.vertex_count(); ++v)
            used += rings.row(v).empty() ? 0 : 1;
        const int euler = used - static_cast<int>(table.edges.size()) +
                          static_cast<int>(topology.triangle_count());
        result.genus = (2 * static_cast<int>(result.components) -
                        static_cast<int>(result.boundary_loops) - euler) /
                       2;
    }
    return result;
}

struct BestPlane {
    Vec3 centre = Vec3::Zero();
    Vec3 normal = Vec3::Zero();
};

BestPlane best_plane(const Positions& points) {
    BestPlane plane;
    for (const Vec3& p : points) plane.centre += p;
    plane.centre /= static_cast<double>(points.size());
    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
    for (const Vec3& p : points) spread += (p - plane.centre) * (p - plane.centre).transpose();
    plane.normal = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread).eigenvectors().col(0);
    return plane;
}

double flatness(const Positions& points) {
    const BestPlane plane = best_plane(points);
    double largest = 0.0;
    for (const Vec3& p : points)
        largest = std::max(largest, std::abs((p - plane.centre).dot(plane.normal)));
    return largest;
}

}  // namespace

Bounds bounds(const Positions& positions) {
    if (positions.empty()) return {};
    Bounds box{positions.front(), positions.front()};
    for (const Vec3& p : positions) {
        box.min = box.min.cwiseMin(p);
        box.max = box.max.cwiseMax(p);
    }
    return box;
}

Bounds bounds(const Surface& surface) {
    return surface.positions ? bounds(surface.points()) : Bounds{};
}

double triangle_area(const Positions& positions, const Triangle& triangle) {
    return 0.5 * area_normal(positions, triangle).norm();
}

double longest_edge(const Vec3& a, const Vec3& b, const Vec3& c) {
    return std::max({(a - b).norm(), (b - c).norm(), (c - a).norm()});
}

double longest_edge(const Positions& positions, const Triangle& triangle) {
    return longest_edge(positions[triangle[0]], positions[triangle[1]], positions[triangle[2]]);
}

double area(const Surface& surface) {
    double sum = 0.0;
    for (const Triangle& t : surface.triangles()) sum += triangle_area(surface.points(), t);
    return sum;
}

double volume(const Surface& surface) {
    // Tetrahedra to a point near the surface, so that large coordinates cost no precision.
    const Positions& points = surface.points();
    const Vec3 origin = bounds(points).centre();
    double sum = 0.0;
    for (const Triangle& t : surface.triangles())
        sum += (points[t[0]] - origin).dot((points[t[1]] - origin).cross(points[t[2]] - origin));
    for (const auto& loop : surface.topology->boundary_loops()) {
        Vec3 centre = Vec3::Zero();
        for (const VertexId v : loop) centre += points[v] - origin;
        centre /= static_cast<double>(loop.size());
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const Vec3 a = points[loop[i]] - origin,
                       b = points[loop[(i + 1) % loop.size()]] - origin;
            sum += centre.dot(b.cross(a));
        }
    }
    return sum / 6.0;
}

Spread edge_lengths(const Surface& surface) {
    return edge_lengths(surface, edge_table(*surface.topology));
}

double mean_edge_length(const Surface& surface) {
    return edge_lengths(surface).mean;
}

std::vector<PatchMeasures> measure_patches(const Surface& surface) {
    std::vector<PatchMeasures> all(surface.patches.size());
    std::vector<Positions> corners(surface.patches.size());
    for (TriangleId t = 0; t < surface.triangle_count(); ++t) {
        const Triangle& triangle = surface.triangles()[t];
        const auto label = (*surface.patch_labels)[t];
        PatchMeasures& patch = all[label];
        const Vec3 normal = area_normal(surface.points(), triangle);
        const double its_area = 0.5 * normal.norm();
        ++patch.triangles;
        patch.area += its_area;
        patch.normal += normal;
        Vec3 middle = Vec3::Zero();
        for (const VertexId v : triangle) {
            middle += surface.points()[v] / 3.0;
            corners[label].push_back(surface.points()[v]);
        }
        patch.centroid += its_area * middle;
    }
    std::vector<PatchMeasures> present;
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (all[i].triangles == 0) continue;
        all[i].row = i;
        all[i].name = surface.patches[i].name;
        all[i].kind = surface.patches[i].kind;
        if (all[i].area > 0.0) all[i].centroid /= all[i].area;
        all[i].normal.normalize();
        all[i].flatness = flatness(corners[i]);
        present.push_back(std::move(all[i]));
    }
    return present;
}

Connectivity connectivity(const Topology& topology) {
    return connectivity(topology, edge_table(topology));
}

namespace {

SurfaceMeasures measured(const Surface& surface, DerivedCache& cache) {
    SurfaceMeasures result;
    result.vertices = surface.vertex_count();
    result.triangles = surface.triangle_count();
    const EdgeTable table = edge_table(*surface.topology);
    result.connectivity = connectivity(*surface.topology, table);
    result.self_intersections = self_intersections(surface, {}, cache).size();
    result.area = area(surface);
    result.volume = volume(surface);
    result.bounds = bounds(surface);
    result.edge_length = edge_lengths(surface, table);
    const TriangleShape shape = triangle_shape(surface);
    result.equiangle_skewness = shape.equiangle_skewness;
    result.radius_ratio = shape.radius_ratio;
    for (const double angle : normal_curvature(surface, cache))
        result.normal_curvature_deg += angle;
    result.normal_curvature_deg /= static_cast<double>(result.vertices);
    const std::shared_ptr<const MeanCurvature> shared = mean_curvature_of(surface, cache);
    const MeanCurvature& curvature = *shared;
    for (std::size_t v = 0; v < curvature.values.size(); ++v) {
        result.mean_curvature_integral += curvature.values[v] * curvature.areas[v];
        result.mean_curvature_integral_abs += std::abs(curvature.values[v]) * curvature.areas[v];
    }
    result.patches = measure_patches(surface);
    return result;
}

}  // namespace

SurfaceMeasures measure(const Surface& surface, DerivedCache& cache) {
    if (surface.empty()) throw InvalidInput("the surface has no triangles: nothing to measure");
    return *cache.find_or_make<SurfaceMeasures>(
        "measures", surface_key(surface, cache), [&] { return measured(surface, cache); },
        [](const SurfaceMeasures& made) {
            return sizeof made + made.patches.size() * sizeof(PatchMeasures);
        });
}

}  // namespace vesselbench
