#include "meshing/layers/wall_layers.h"

#include <algorithm>
#include <cmath>

#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/parallel.h"
#include "geometry/kernel/self_intersections.h"
#include "meshing/layers/layer_directions.h"
#include "meshing/layers/opening_discs.h"
#include "meshing/layers/touching_balls.h"

namespace vesselbench {

namespace {

constexpr double kOfBall = 0.45;     // two walls then leave a tenth of the lumen between them
constexpr double kGradation = 0.4;   // steeper, and prisms lean
constexpr double kJacobian = 0.2;    // of every prism
constexpr double kOfTriangle = 0.8;  // of what the wall's own triangle allows
constexpr double kThinner = 0.8;
constexpr int kMostThinnings = 60;    // 0.8^60: nothing is left
constexpr double kLeastCosine = 0.5;  // between direction and normal: columns get twice as long

// Smallest scaled Jacobian at the corners of the prisms above and below a level; those of both are
// the same, because columns are straight.
double jacobian_at(const WallLayers& layers, const Triangle& triangle, double level) {
    constexpr double kEquilateral = 1.1547005383792515;  // as scaled_jacobian of quality.h
    double least = 1.0;
    for (int k = 0; k < 3; ++k) {
        const VertexId v = triangle[k];
        const Vec3 corner = layers.at(v, level),
                   next = layers.at(triangle[(k + 1) % 3], level) - corner,
                   previous = layers.at(triangle[(k + 2) % 3], level) - corner;
        least = std::min(least, -kEquilateral * next.cross(previous).dot(layers.directions[v]) /
                                    std::max(next.norm() * previous.norm(), 1e-300));
    }
    return least;
}

// Of all prisms below a triangle.
double worst_jacobian(const WallLayers& layers, const Triangle& triangle) {
    double least = 1.0;
    for (const double level : layers.levels)
        least = std::min(least, jacobian_at(layers, triangle, level));
    return least;
}

// What is asked of the prisms below each triangle. #T
std::vector<double> asked_jacobians(const WallLayers& layers) {
    const auto triangles = layers.wall.wall.triangles();
    std::vector<double> asked(triangles.size());
    for_each_vertex(asked.size(), [&](std::size_t t) {
        asked[t] = std::min(kJacobian, kOfTriangle * jacobian_at(layers, triangles[t], 0.0));
    });
    return asked;
}

std::vector<double> wished_lengths(const WallLayers& layers, const std::vector<double>& balls,
                                   const LayerParameters& parameters, const Progress& progress) {
    std::vector<double> wished(balls.size(), parameters.thickness_mm.value_or(0.0));
    if (parameters.first)
        std::ranges::fill(wished, *parameters.first / layers.levels[1]);
    else if (!parameters.thickness_mm)
        wished = vessel_radii(layers.wall, balls, progress);
    const double by = parameters.first || parameters.thickness_mm ? 1.0 : parameters.thickness;
    for (std::size_t v = 0; v < wished.size(); ++v) {
        const double cosine = -layers.directions[v].dot(layers.wall.normals[v]);
        wished[v] *= by / std::max(kLeastCosine, cosine);
    }
    return wished;
}

// Thins the layers until they are valid.
class Thinning {
public:
    Thinning(const Surface& surface, WallLayers& layers, const Progress& progress)
        : surface_(surface),
          layers_(layers),
          progress_(progress),
          asked_(asked_jacobians(layers)),
          columns_(surface.vertex_count(), kNone) {
        for (VertexId v = 0; v < layers.wall.origins.size(); ++v)
            columns_[layers.wall.origins[v]] = v;
    }

    void run() {
        for (int round = 0; round < kMostThinnings; ++round) {
            progress_.report(static_cast<double>(round) / kMostThinnings, "growing the layers");
            std::vector<VertexId> bad = of_bad_prisms();
            if (bad.empty()) bad = of_inner_surface();
            if (bad.empty()) return;
            thin(bad);
        }
        throw DiagnosedFailure({.code = "layers-too-thin",
                                .place = layers_.wall.wall.points()[last_],
                                .remedies = {{.arguments = {{"layers", "0"}}}}});
    }

private:
    static constexpr VertexId kNone = ~VertexId{0};

    [[nodiscard]] std::vector<VertexId> of_bad_prisms() const {
        const auto triangles = layers_.wall.wall.triangles();
        std::vector<std::uint8_t> bad(triangles.size());
        for_each_vertex(bad.size(), [&](std::size_t t) {
            bad[t] = worst_jacobian(layers_, triangles[t]) < asked_[t] ? 1 : 0;
        });
        std::vector<VertexId> vertices;
        for (std::size_t t = 0; t < bad.size(); ++t)
            if (bad[t] != 0)
                vertices.insert(vertices.end(), triangles[t].begin(), triangles[t].end());
        return vertices;
    }

    // Makes the inner surface too.
    std::vector<VertexId> of_inner_surface() {
        Positions moved = surface_.points();
        for (VertexId v = 0; v < layers_.wall.origins.size(); ++v)
            moved[layers_.wall.origins[v]] = layers_.at(v, 1.0);
        carry_openings(surface_, layers_.wall, moved);
        const auto turned = turned_openings(surface_, layers_.wall, moved);
        std::vector<VertexId> vertices;
        for (VertexId v = 0; v < layers_.wall.origins.size(); ++v)
            if (turned[layers_.wall.opening[v]] != 0) vertices.push_back(v);
        if (!vertices.empty()) return vertices;
        layers_.inner = surface_.with_positions(std::move(moved));
        for (const auto& [one, other] : self_intersections(
                 layers_.inner.points(), layers_.inner.triangles(), progress_.silent()))
            for (const TriangleId t : {one, other}) add_columns(t, vertices);
        return vertices;
    }

    // Of a triangle in an opening: of all its rim.
    void add_columns(TriangleId t, std::vector<VertexId>& vertices) const {
        const std::uint16_t patch = (*surface_.patch_labels)[t];
        if (LayeredWall::is_opening(surface_.patches[patch])) {
            for (VertexId v = 0; v < layers_.wall.opening.size(); ++v)
                if (layers_.wall.opening[v] == patch) vertices.push_back(v);
            return;
        }
        for (const VertexId v : surface_.triangles()[t]) vertices.push_back(columns_[v]);
    }

    void thin(std::vector<VertexId>& vertices) {
        last_ = vertices.front();
        std::ranges::sort(vertices);
        const auto [first, last] = std::ranges::unique(vertices);
        vertices.erase(first, last);
        for (const VertexId v : vertices) layers_.lengths[v] *= kThinner;
        layers_.lengths = graded_lengths(layers_.wall.wall, std::move(layers_.lengths));
    }

    const Surface& surface_;
    WallLayers& layers_;
    Progress progress_;
    std::vector<double> asked_;
    std::vector<VertexId> columns_;  ///< vertex of the wall, by vertex of the surface
    VertexId last_ = 0;              ///< of the wall, where layers were thinned last
};

}  // namespace

std::vector<double> layer_levels(int layers, double growth) {
    std::vector<double> levels = {0.0};
    double height = 1.0;
    for (int k = 0; k < layers; ++k, height *= growth) levels.push_back(levels.back() + height);
    for (double& level : levels) level /= std::max(levels.back(), 1.0);
    return levels;
}

std::vector<double> graded_lengths(const Surface& wall, std::vector<double> lengths) {
    const CompressedRows& rings = wall.topology->rings();
    std::vector<VertexId> changed(lengths.size()), next;
    for (VertexId v = 0; v < changed.size(); ++v) changed[v] = v;
    while (!changed.empty()) {
        next.clear();
        for (const VertexId v : changed)
            for (const VertexId u : rings.row(v)) {
                const double most =
                    lengths[v] + kGradation * (wall.points()[u] - wall.points()[v]).norm();
                if (lengths[u] <= most) continue;
                lengths[u] = most;
                next.push_back(u);
            }
        std::swap(changed, next);
    }
    return lengths;
}

WallLayers wall_layers(const Surface& surface, const LayerParameters& parameters,
                       const Progress& progress) {
    WallLayers layers{.wall = layered_wall(surface),
                      .levels = layer_levels(parameters.layers, parameters.growth)};
    layers.directions = layer_directions(layers.wall);
    progress.report(0.1, "measuring the room for layers");
    const std::vector<double> balls = touching_balls(layers.wall, progress.silent());
    layers.wished = wished_lengths(layers, balls, parameters, progress.silent());
    std::vector<double> lengths = layers.wished;
    for (std::size_t v = 0; v < lengths.size(); ++v)
        lengths[v] = std::min(lengths[v], kOfBall * balls[v]);
    layers.lengths = graded_lengths(layers.wall.wall, std::move(lengths));
    Thinning(surface, layers, progress.part(0.5, 1.0)).run();
    return layers;
}

}  // namespace vesselbench
