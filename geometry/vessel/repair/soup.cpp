#include "geometry/vessel/repair/soup.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <tuple>

#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/edges.h"
#include "geometry/kernel/measure.h"
#include "geometry/kernel/piece_shape.h"
#include "geometry/kernel/point_welder.h"
#include "geometry/kernel/surface_distance.h"

namespace vesselbench {

namespace {

/// A surface whose largest piece has less than this fraction of the area [-] is scattered.
constexpr double kSmallestMainPart = 0.1;
/// A piece inside another one is the inner side of its wall if it has this fraction of its area
/// [-]; a calcification or a thrombus has less.
constexpr double kInnerWall = 0.3;
/// Inside is this fraction of its vertices [-]: those at open ends are in between.
constexpr double kNested = 0.8;
constexpr std::size_t kNestedSamples = 200;

std::size_t weld_equal_points(TriangleSoup& mesh) {
    PointWelder welder(mesh.points.size());
    std::vector<VertexId> first, target(mesh.points.size());
    std::size_t welded = 0;
    for (VertexId v = 0; v < mesh.points.size(); ++v) {
        const VertexId number = welder.add(mesh.points[v]);
        if (number == first.size())
            first.push_back(v);
        else
            ++welded;
        target[v] = first[number];
    }
    if (welded > 0) mesh.renumber(target);
    return welded;
}

/// Rim points close to each other, found by sorting along x: rims are small.
std::size_t weld_rims(TriangleSoup& mesh, double tolerance) {
    const Topology topology(mesh.triangles, mesh.points.size());
    const auto& boundary = topology.boundary_vertices();
    std::vector<VertexId> rim;
    for (VertexId v = 0; v < boundary.size(); ++v)
        if (boundary[v]) rim.push_back(v);
    std::sort(rim.begin(), rim.end(), [&](VertexId a, VertexId b) {
        return std::tuple(mesh.points[a].x(), a) < std::tuple(mesh.points[b].x(), b);
    });
    std::vector<VertexId> target(mesh.points.size());
    std::iota(target.begin(), target.end(), VertexId{0});
    std::size_t welded = 0;
    for (std::size_t i = 0; i < rim.size(); ++i) {
        if (target[rim[i]] != rim[i]) continue;
        for (std::size_t j = i + 1; j < rim.size(); ++j) {
            const Vec3 apart = mesh.points[rim[j]] - mesh.points[rim[i]];
            if (apart.x() > tolerance) break;
            if (target[rim[j]] != rim[j] || apart.norm() > tolerance) continue;
            target[rim[j]] = rim[i];
            ++welded;
        }
    }
    if (welded > 0) mesh.renumber(target);
    return welded;
}

/// A connected component.
struct Part {
    double area = 0.0;           ///< [mm^2]
    Vec3 centre = Vec3::Zero();  ///< weighted by area [mm^3]
    std::size_t number = 0;
};

/// The largest first.
std::vector<Part> parts_by_area(const TriangleSoup& mesh, const Components& parts) {
    std::vector<Part> order(parts.count());
    for (TriangleId t = 0; t < mesh.triangles.size(); ++t) {
        const double its = triangle_area(mesh.points, mesh.triangles[t]);
        Part& part = order[parts.of_triangle[t]];
        part.area += its;
        part.centre += its * centroid(mesh, mesh.triangles[t]);
    }
    for (std::size_t i = 0; i < order.size(); ++i) order[i].number = i;
    std::stable_sort(order.begin(), order.end(),
                     [](const Part& a, const Part& b) { return a.area > b.area; });
    return order;
}

void check_main_part(const std::vector<Part>& order, double whole) {
    if (order[0].area >= kSmallestMainPart * whole) return;
    throw DiagnosedFailure({.code = "surface-not-connected",
                            .figures = {{"pieces", static_cast<double>(order.size())},
                                        {"area_percent", 100.0 * order[0].area / whole}}});
}

/// True if a part lies inside another one, whichever way that one faces.
bool is_nested(const TriangleSoup& mesh, const Components& parts, std::size_t inner,
               std::size_t outer) {
    std::vector<Triangle> around;
    std::vector<VertexId> within;
    for (TriangleId t = 0; t < mesh.triangles.size(); ++t) {
        if (parts.of_triangle[t] == outer) around.push_back(mesh.triangles[t]);
        if (parts.of_triangle[t] == inner) within.push_back(mesh.triangles[t][0]);
    }
    const SurfaceDistance surface(mesh.points, around);
    const std::size_t step = within.size() / kNestedSamples + 1;
    std::size_t samples = 0, inside = 0;
    for (std::size_t i = 0; i < within.size(); i += step, ++samples)
        if (std::abs(surface.winding_number(mesh.points[within[i]])) > 0.5) ++inside;
    return static_cast<double>(inside) >= kNested * static_cast<double>(samples);
}

/// True if the two largest parts are the outer and the inner side of a vessel's wall.
bool are_wall_sides(const TriangleSoup& mesh, const Components& parts,
                    const std::vector<Part>& order) {
    return order[1].area >= kInnerWall * order[0].area &&
           is_nested(mesh, parts, order[1].number, order[0].number);
}

/// Of the parts behind the first `count`, the longest vessel.
void note_vessel(const TriangleSoup& mesh, const Components& parts, const std::vector<Part>& order,
                 std::size_t count, RepairReport& report) {
    std::vector<bool> kept(order.size(), false);
    for (std::size_t i = 0; i < std::min(count, order.size()); ++i) kept[order[i].number] = true;
    const auto vessel = longest_dropped_vessel(
        piece_shapes(mesh.points, mesh.triangles, parts.of_triangle, parts.count()), kept);
    if (!vessel || (report.removed_vessel && report.removed_vessel->length >= vessel->length))
        return;
    report.removed_vessel = vessel;
    const auto rank = std::ranges::find(order, vessel->piece, &Part::number) - order.begin();
    report.keeping_it = static_cast<std::size_t>(rank) + 1;
}

}  // namespace

double mean_side(const TriangleSoup& mesh) {
    double sum = 0.0;
    for (const Triangle& t : mesh.triangles)
        for (int k = 0; k < 3; ++k) sum += (mesh.points[t[k]] - mesh.points[t[(k + 1) % 3]]).norm();
    return mesh.triangles.empty() ? 0.0 : sum / (3.0 * static_cast<double>(mesh.triangles.size()));
}

double area_of(const TriangleSoup& mesh) {
    double sum = 0.0;
    for (const Triangle& t : mesh.triangles) sum += triangle_area(mesh.points, t);
    return sum;
}

Vec3 centroid(const TriangleSoup& mesh, const Triangle& triangle) {
    return (mesh.points[triangle[0]] + mesh.points[triangle[1]] + mesh.points[triangle[2]]) / 3.0;
}

void weld(TriangleSoup& mesh, double tolerance, RepairReport& report) {
    report.welded_vertices += weld_equal_points(mesh);
    report.welded_vertices += weld_rims(mesh, tolerance);
}

void remove_degenerate_and_duplicate(TriangleSoup& mesh, RepairReport& report) {
    struct Key {
        Triangle sorted;
        TriangleId triangle;
    };

    std::vector<std::uint8_t> marked(mesh.triangles.size(), 0);
    std::vector<Key> keys;
    keys.reserve(mesh.triangles.size());
    for (TriangleId t = 0; t < mesh.triangles.size(); ++t) {
        Triangle sorted = mesh.triangles[t];
        std::sort(sorted.begin(), sorted.end());
        if (names_vertex_twice(sorted)) {
            marked[t] = 1;
            ++report.degenerate_triangles;
            report.places.push_back(
                {RepairKind::Degenerate, centroid(mesh, mesh.triangles[t]), 0.0});
        } else {
            keys.push_back({sorted, t});
        }
    }
    std::sort(keys.begin(), keys.end(), [](const Key& a, const Key& b) {
        return a.sorted < b.sorted || (a.sorted == b.sorted && a.triangle < b.triangle);
    });
    for (std::size_t i = 1; i < keys.size(); ++i) {
        if (keys[i].sorted != keys[i - 1].sorted) continue;
        marked[keys[i].triangle] = 1;
        ++report.duplicate_triangles;
        report.places.push_back(
            {RepairKind::Duplicate, centroid(mesh, mesh.triangles[keys[i].triangle]), 0.0});
    }
    mesh.remove_triangles(marked);
}

void keep_largest_components(TriangleSoup& mesh, const RepairParameters& parameters,
                             RepairReport& report) {
    const std::size_t count = parameters.keep_components;
    const Components parts = connected_components(Topology(mesh.triangles, mesh.points.size()));
    if (parts.count() <= 1) return;
    std::vector<Part> order = parts_by_area(mesh, parts);
    check_main_part(order, area_of(mesh));
    const bool walls = count == 1 && are_wall_sides(mesh, parts, order);
    if (walls && !parameters.outer_wall) std::swap(order[0], order[1]);  // where the blood flows
    (parameters.outer_wall ? report.removed_inner_wall : report.removed_outer_wall) |= walls;
    note_vessel(mesh, parts, order, walls ? 2 : count, report);
    std::vector<std::uint8_t> drop(parts.count(), 0);
    for (std::size_t i = count; i < order.size(); ++i) {
        drop[order[i].number] = 1;
        ++report.removed_components;
        report.removed_component_triangles += parts.triangle_counts[order[i].number];
        const Vec3 centre =
            order[i].area > 0.0 ? Vec3(order[i].centre / order[i].area) : Vec3(Vec3::Zero());
        report.places.push_back({RepairKind::Component, centre, std::sqrt(order[i].area)});
    }
    std::vector<std::uint8_t> marked(mesh.triangles.size());
    for (TriangleId t = 0; t < marked.size(); ++t) marked[t] = drop[parts.of_triangle[t]];
    mesh.remove_triangles(marked);
}

}  // namespace vesselbench
