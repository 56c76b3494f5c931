#include "meshing/layers/layer_directions.h"

#include <algorithm>

#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/parallel.h"

namespace vesselbench {

namespace {

constexpr int kSmoothings = 8;
constexpr double kSeesWell = 0.5;    // cosine to every triangle's normal: turning may go so far
constexpr double kSeesFairly = 0.3;  // below it the most normal direction is better
constexpr double kSees = 0.05;       // below it prisms would be flat

// Inward unit normals of the wall's triangles; zero without area. #T
Positions inward_normals(const Surface& wall) {
    Positions normals(wall.triangle_count());
    for_each_vertex(normals.size(), [&](std::size_t t) {
        normals[t] = -area_normal(wall.points(), wall.triangles()[t]).stableNormalized();
    });
    return normals;
}

// The smallest cosine between a direction and the normals of the triangles at a vertex.
double sight(const CompressedRows& triangles_at, const Positions& inward, VertexId v,
             const Vec3& direction) {
    double least = 1.0;
    for (const TriangleId t : triangles_at.row(v))
        least = std::min(least, direction.dot(inward[t]));
    return least;
}

Vec3 first_direction(const LayeredWall& wall, const Positions& inward, VertexId v) {
    const CompressedRows& triangles_at = wall.wall.topology->triangles_at();
    const Vec3 usual = in_opening(wall, v, -wall.normals[v]).stableNormalized();
    const double usual_sight = sight(triangles_at, inward, v, usual);
    if (usual_sight >= kSeesFairly) return usual;
    Positions seen;
    for (const TriangleId t : triangles_at.row(v)) seen.push_back(in_opening(wall, v, inward[t]));
    const Vec3 best = most_normal(seen).stableNormalized();
    return sight(triangles_at, inward, v, best) > usual_sight ? best : usual;
}

void require_sight(const LayeredWall& wall, const Positions& inward, const Positions& directions) {
    const CompressedRows& triangles_at = wall.wall.topology->triangles_at();
    std::size_t folds = 0;
    std::optional<Vec3> place;
    for (VertexId v = 0; v < directions.size(); ++v) {
        if (sight(triangles_at, inward, v, directions[v]) >= kSees) continue;
        ++folds;
        if (!place) place = wall.wall.points()[v];
    }
    if (folds > 0)
        throw DiagnosedFailure({.code = "layers-at-fold",
                                .place = place,
                                .figures = {{"count", static_cast<double>(folds)}},
                                .remedies = {{.arguments = {{"layers", "0"}}}}});
}

}  // namespace

Vec3 most_normal(std::span<const Vec3> vectors) {
    constexpr int kSteps = 500;
    constexpr double kClose = 1e-9;  // of the squared length
    Vec3 nearest = vectors.front();
    for (int step = 0; step < kSteps; ++step) {
        const Vec3& least =
            *std::ranges::min_element(vectors, {}, [&](const Vec3& n) { return n.dot(nearest); });
        const Vec3 way = least - nearest;
        const double gain = -way.dot(nearest);
        if (gain <= kClose || way.isZero()) break;
        nearest += std::min(1.0, gain / way.squaredNorm()) * way;
    }
    const double shortest =
        std::ranges::min(vectors, {}, [&](const Vec3& n) { return n.dot(nearest); }).dot(nearest);
    return shortest > 0.0 ? nearest : Vec3(Vec3::Zero());
}

Positions layer_directions(const LayeredWall& wall) {
    const Positions inward = inward_normals(wall.wall);
    const CompressedRows& triangles_at = wall.wall.topology->triangles_at();
    const CompressedRows& rings = wall.wall.topology->rings();
    Positions directions(wall.wall.vertex_count());
    for_each_vertex(directions.size(), [&](std::size_t v) {
        directions[v] = first_direction(wall, inward, static_cast<VertexId>(v));
    });
    require_sight(wall, inward, directions);
    for (int pass = 0; pass < kSmoothings; ++pass) {
        const Positions before = directions;
        for_each_vertex(directions.size(), [&](std::size_t i) {
            const auto v = static_cast<VertexId>(i);
            Vec3 sum = Vec3::Zero();
            for (const VertexId u : rings.row(v)) sum += before[u];
            const Vec3 mean = before[v] + sum / static_cast<double>(rings.row(v).size());
            const Vec3 turned = in_opening(wall, v, mean).stableNormalized();
            const double now = sight(triangles_at, inward, v, turned);
            if (now > kSeesWell || now > sight(triangles_at, inward, v, before[v]))
                directions[v] = turned;
        });
    }
    return directions;
}

}  // namespace vesselbench
