#include "meshing/remeshing/subdivide.h"

#include <cmath>
#include <numbers>

#include "geometry/kernel/edges.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/wording.h"

namespace vesselbench {

namespace {

constexpr int kMostIterations = 6;
constexpr std::size_t kMostTriangles = 40'000'000;  // about 4 GiB while it is built

struct Creases {
    std::vector<std::uint8_t> is_crease;              ///< by edge
    std::vector<std::uint32_t> count;                 ///< of crease edges, by vertex
    std::vector<std::array<VertexId, 2>> neighbours;  ///< the first two along creases, by vertex
};

Creases creases_of(const Surface& surface, const EdgeTable& table) {
    Creases creases{std::vector<std::uint8_t>(table.edges.size(), 0),
                    std::vector<std::uint32_t>(surface.vertex_count(), 0),
                    std::vector<std::array<VertexId, 2>>(surface.vertex_count())};
    const PatchLabels& labels = *surface.patch_labels;
    for (std::size_t e = 0; e < table.edges.size(); ++e) {
        const auto sides = table.half_edges.row(e);
        if (sides.size() > 2)
            throw InvalidInput("subdivide needs a manifold surface; use repair first");
        if (sides.size() == 2 && labels[sides[0] / 3] == labels[sides[1] / 3]) continue;
        creases.is_crease[e] = 1;
        const auto [a, b] = table.edges[e];
        for (const auto& [v, u] : {std::pair(a, b), std::pair(b, a)}) {
            if (creases.count[v] < 2) creases.neighbours[v][creases.count[v]] = u;
            ++creases.count[v];
        }
    }
    return creases;
}

/// Loop's weight of each neighbour of an inner vertex.
double neighbour_weight(std::size_t valence) {
    const double n = static_cast<double>(valence);
    const double c = 3.0 / 8.0 + std::cos(2.0 * std::numbers::pi / n) / 4.0;
    return (5.0 / 8.0 - c * c) / n;
}

Vec3 moved_vertex(const Surface& surface, const Creases& creases, VertexId v) {
    const Positions& points = surface.points();
    if (creases.count[v] == 2) {
        const auto [a, b] = creases.neighbours[v];
        return 0.75 * points[v] + 0.125 * (points[a] + points[b]);
    }
    const auto ring = surface.topology->rings().row(v);
    if (creases.count[v] != 0 || ring.empty()) return points[v];
    const double weight = neighbour_weight(ring.size());
    Vec3 sum = (1.0 - static_cast<double>(ring.size()) * weight) * points[v];
    for (const VertexId u : ring) sum += weight * points[u];
    return sum;
}

VertexId apex(const Surface& surface, std::uint32_t half_edge) {
    return surface.triangles()[half_edge / 3][(half_edge % 3 + 2) % 3];
}

Positions new_points(const Surface& surface, const EdgeTable& table, const Creases& creases) {
    const Positions& old = surface.points();
    Positions points;
    points.reserve(old.size() + table.edges.size());
    for (VertexId v = 0; v < old.size(); ++v) points.push_back(moved_vertex(surface, creases, v));
    for (std::size_t e = 0; e < table.edges.size(); ++e) {
        const auto [a, b] = table.edges[e];
        if (creases.is_crease[e]) {
            points.push_back(0.5 * (old[a] + old[b]));
            continue;
        }
        const auto sides = table.half_edges.row(e);
        points.push_back(0.375 * (old[a] + old[b]) +
                         0.125 * (old[apex(surface, sides[0])] + old[apex(surface, sides[1])]));
    }
    return points;
}

/// Number of the new vertex on each half-edge.
std::vector<VertexId> middles(const Surface& surface, const EdgeTable& table) {
    std::vector<VertexId> result(3 * surface.triangle_count());
    for (std::size_t e = 0; e < table.edges.size(); ++e)
        for (const std::uint32_t h : table.half_edges.row(e))
            result[h] = static_cast<VertexId>(surface.vertex_count() + e);
    return result;
}

Surface subdivided_once(const Surface& surface) {
    const EdgeTable table = edge_table(*surface.topology);
    const Creases creases = creases_of(surface, table);
    const std::vector<VertexId> middle = middles(surface, table);
    std::vector<Triangle> triangles;
    PatchLabels labels;
    triangles.reserve(4 * surface.triangle_count());
    labels.reserve(4 * surface.triangle_count());
    for (TriangleId t = 0; t < surface.triangle_count(); ++t) {
        const auto [a, b, c] = surface.triangles()[t];
        const VertexId ab = middle[3 * t], bc = middle[3 * t + 1], ca = middle[3 * t + 2];
        triangles.insert(triangles.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
        labels.insert(labels.end(), 4, (*surface.patch_labels)[t]);
    }
    Surface result = make_surface(new_points(surface, table, creases), std::move(triangles),
                                  std::move(labels), surface.patches);
    for (const auto& [name, field] : surface.attributes) {
        std::vector<double> values = *field;
        for (const auto& [a, b] : table.edges) values.push_back(0.5 * ((*field)[a] + (*field)[b]));
        result.attributes[name] = std::make_shared<const std::vector<double>>(std::move(values));
    }
    return result;
}

}  // namespace

Surface subdivide(const Surface& surface, int iterations, const Progress& progress) {
    if (surface.empty()) throw InvalidInput("there is no surface to subdivide");
    if (iterations < 1 || iterations > kMostIterations)
        throw InvalidInput("iterations = " + std::to_string(iterations) + " is not in [1, 6]");
    if (surface.triangle_count() > kMostTriangles >> (2 * iterations))
        throw InvalidInput("subdividing " + std::to_string(surface.triangle_count()) +
                           " triangles " + counted(static_cast<std::size_t>(iterations), "time") +
                           " makes more than 40 million; use fewer iterations");
    Surface result = surface;
    for (int i = 0; i < iterations; ++i) {
        progress.report(static_cast<double>(i) / iterations, "subdividing");
        result = subdivided_once(result);
    }
    return result;
}

}  // namespace vesselbench
