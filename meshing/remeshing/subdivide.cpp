#include "meshing/remeshing/subdivide.h"

#include <cmath>
#include <numbers>

#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/edges.h"
#include "geometry/kernel/errors.h"

namespace vesselbench {

namespace {

constexpr int kMostIterations = 6;
constexpr std::size_t kMostTriangles = 40'000'000;  // about 4 GiB while it is built

/// Cancels a loop: asks every few milliseconds.
class Turns {
public:
    explicit Turns(const Progress& progress) : progress_(progress) {}

    void next() {
        constexpr unsigned kTurns = 1U << 15U;
        if (++turns_ % kTurns == 0) progress_.check_cancelled();
    }

private:
    const Progress& progress_;
    unsigned turns_ = 0;
};

struct Creases {
    std::vector<std::uint8_t> is_crease;              ///< by edge
    std::vector<std::uint32_t> count;                 ///< of crease edges, by vertex
    std::vector<std::array<VertexId, 2>> neighbours;  ///< the first two along creases, by vertex
};

Creases creases_of(const Surface& surface, const EdgeTable& table, Turns& turns) {
    Creases creases{std::vector<std::uint8_t>(table.edges.size(), 0),
                    std::vector<std::uint32_t>(surface.vertex_count(), 0),
                    std::vector<std::array<VertexId, 2>>(surface.vertex_count())};
    const PatchLabels& labels = *surface.patch_labels;
    for (std::size_t e = 0; e < table.edges.size(); ++e) {
        turns.next();
        const auto sides = table.half_edges.row(e);
        if (sides.size() > 2)
            throw DiagnosedInput({.code = "surface-not-manifold",
                                  .operation = "subdivide",
                                  .remedies = {{.operation = "repair"}}});
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

/// The vertex without its neighbours' part, of which each has this weight.
struct OwnPart {
    Vec3 place;
    double weight = 0.0;
};

OwnPart own_part(const Positions& points, const Creases& creases, VertexId v,
                 std::uint32_t valence) {
    if (creases.count[v] == 2) {
        const auto [a, b] = creases.neighbours[v];
        return {0.75 * points[v] + 0.125 * (points[a] + points[b])};
    }
    if (creases.count[v] != 0 || valence == 0) return {points[v]};
    const double weight = neighbour_weight(valence);
    return {(1.0 - static_cast<double>(valence) * weight) * points[v], weight};
}

/// New places of the old vertices. Neighbours are added by edge: one-rings cannot be cancelled.
Positions moved_vertices(const Surface& surface, const EdgeTable& table, const Creases& creases,
                         Turns& turns) {
    const Positions& old = surface.points();
    std::vector<std::uint32_t> valence(old.size(), 0);
    for (const auto& edge : table.edges) {
        turns.next();
        for (const VertexId v : edge) ++valence[v];
    }
    Positions points;
    std::vector<double> weights(old.size(), 0.0);
    points.reserve(old.size() + table.edges.size());
    for (VertexId v = 0; v < old.size(); ++v) {
        turns.next();
        const OwnPart part = own_part(old, creases, v, valence[v]);
        points.push_back(part.place);
        weights[v] = part.weight;
    }
    for (const auto& [a, b] : table.edges) {
        turns.next();
        if (weights[a] != 0.0) points[a] += weights[a] * old[b];
        if (weights[b] != 0.0) points[b] += weights[b] * old[a];
    }
    return points;
}

VertexId apex(const Surface& surface, std::uint32_t half_edge) {
    return surface.triangles()[half_edge / 3][(half_edge % 3 + 2) % 3];
}

Positions new_points(const Surface& surface, const EdgeTable& table, const Creases& creases,
                     Turns& turns) {
    const Positions& old = surface.points();
    Positions points = moved_vertices(surface, table, creases, turns);
    for (std::size_t e = 0; e < table.edges.size(); ++e) {
        turns.next();
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
std::vector<VertexId> middles(const Surface& surface, const EdgeTable& table, Turns& turns) {
    std::vector<VertexId> result(3 * surface.triangle_count());
    for (std::size_t e = 0; e < table.edges.size(); ++e) {
        turns.next();
        for (const std::uint32_t h : table.half_edges.row(e))
            result[h] = static_cast<VertexId>(surface.vertex_count() + e);
    }
    return result;
}

/// The four triangles of each, with its label.
struct SplitTriangles {
    std::vector<Triangle> triangles;
    PatchLabels labels;
};

SplitTriangles split_triangles(const Surface& surface, const EdgeTable& table, Turns& turns) {
    const std::vector<VertexId> middle = middles(surface, table, turns);
    SplitTriangles split;
    split.triangles.reserve(4 * surface.triangle_count());
    split.labels.reserve(4 * surface.triangle_count());
    for (TriangleId t = 0; t < surface.triangle_count(); ++t) {
        turns.next();
        const auto [a, b, c] = surface.triangles()[t];
        const VertexId ab = middle[3 * t], bc = middle[3 * t + 1], ca = middle[3 * t + 2];
        split.triangles.insert(split.triangles.end(),
                               {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
        split.labels.insert(split.labels.end(), 4, (*surface.patch_labels)[t]);
    }
    return split;
}

Surface subdivided_once(const Surface& surface, const Progress& progress) {
    constexpr const char* kWhat = "subdividing";
    progress.report(0.0, kWhat);
    const EdgeTable table = edge_table(*surface.topology, progress);
    progress.report(0.5, kWhat);
    Turns turns(progress);
    Positions points = new_points(surface, table, creases_of(surface, table, turns), turns);
    progress.report(0.7, kWhat);
    SplitTriangles split = split_triangles(surface, table, turns);
    progress.report(0.9, kWhat);
    Surface result = make_surface(std::move(points), std::move(split.triangles),
                                  std::move(split.labels), surface.patches);
    for (const auto& [name, field] : surface.attributes) {
        std::vector<double> values = *field;
        values.reserve(field->size() + table.edges.size());
        for (const auto& [a, b] : table.edges) {
            turns.next();
            values.push_back(0.5 * ((*field)[a] + (*field)[b]));
        }
        result.attributes[name] = std::make_shared<const std::vector<double>>(std::move(values));
    }
    return result;
}

/// Of all work, what is done after so many of the iterations; each costs four times the last.
double done_after(int done, int iterations) {
    return (std::pow(4.0, done) - 1.0) / (std::pow(4.0, iterations) - 1.0);
}

}  // namespace

Surface subdivide(const Surface& surface, int iterations, const Progress& progress) {
    if (surface.empty()) throw InvalidInput("there is no surface to subdivide");
    if (iterations < 1 || iterations > kMostIterations)
        throw InvalidInput("iterations = " + std::to_string(iterations) + " is not in [1, 6]");
    if (surface.triangle_count() > kMostTriangles >> (2 * iterations))
        throw DiagnosedInput(
            {.code = "too-many-subdivisions",
             .operation = "subdivide",
             .figures = {{"triangles", static_cast<double>(surface.triangle_count())},
                         {"iterations", static_cast<double>(iterations)},
                         {"most_millions", static_cast<double>(kMostTriangles) / 1e6}},
             .remedies = {{.arguments = {{"iterations", ""}}}}});
    Surface result = surface;
    for (int i = 0; i < iterations; ++i)
        result = subdivided_once(
            result, progress.part(done_after(i, iterations), done_after(i + 1, iterations)));
    return result;
}

}  // namespace vesselbench
