#include "meshing/layers/layered_wall.h"

#include <cmath>

#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/edges.h"
#include "geometry/kernel/measure.h"
#include "geometry/kernel/vertex_normals.h"

namespace vesselbench {

namespace {

std::vector<bool> triangles_of_wall(const Surface& surface) {
    std::vector<bool> wall(surface.triangle_count());
    for (TriangleId t = 0; t < wall.size(); ++t)
        wall[t] = !LayeredWall::is_opening(surface.patch_of(t));
    return wall;
}

// By the root of an opening's area. Files in single precision are off by less; layers end at its
// rim in one plane.
constexpr double kUneven = 3e-4;

void require_flat_openings(const Surface& surface) {
    for (const PatchMeasures& patch : measure_patches(surface))
        if (LayeredWall::is_opening({patch.name, patch.kind}) &&
            patch.flatness > kUneven * std::sqrt(patch.area))
            throw DiagnosedInput({.code = "layers-opening-not-flat",
                                  .place = patch.centroid,
                                  .figures = {{"off", patch.flatness}},
                                  .words = {{"opening", patch.name}},
                                  .remedies = {{.operation = "clip-opening", .before = true},
                                               {.arguments = {{"layers", "0"}}}}});
}

Positions planes_of_openings(const Surface& surface) {
    Positions planes(surface.patches.size(), Vec3::Zero());
    for (TriangleId t = 0; t < surface.triangle_count(); ++t)
        if (LayeredWall::is_opening(surface.patch_of(t)))
            planes[(*surface.patch_labels)[t]] +=
                area_normal(surface.points(), surface.triangles()[t]);
    for (Vec3& plane : planes) plane.stableNormalize();
    return planes;
}

// By vertex of the surface. \throw InvalidInput if a vertex is on two
std::vector<std::uint16_t> openings_of_vertices(const Surface& surface) {
    std::vector<std::uint16_t> openings(surface.vertex_count(), 0);
    for (TriangleId t = 0; t < surface.triangle_count(); ++t) {
        const std::uint16_t patch = (*surface.patch_labels)[t];
        if (!LayeredWall::is_opening(surface.patches[patch])) continue;
        for (const VertexId v : surface.triangles()[t]) {
            if (openings[v] != 0 && openings[v] != patch)
                throw DiagnosedInput({.code = "layers-between-openings",
                                      .place = surface.points()[v],
                                      .words = {{"one", surface.patches[openings[v]].name},
                                                {"other", surface.patches[patch].name}},
                                      .remedies = {{.arguments = {{"layers", "0"}}}}});
            openings[v] = patch;
        }
    }
    return openings;
}

}  // namespace

LayeredWall layered_wall(const Surface& surface) {
    require_flat_openings(surface);
    const std::vector<bool> keep = triangles_of_wall(surface);
    LayeredWall part{.wall = select_triangles(surface, keep),
                     .planes = planes_of_openings(surface)};
    if (part.wall.empty()) throw InvalidInput("layers: the surface has no wall");
    std::vector<bool> used(surface.vertex_count(), false);
    for (TriangleId t = 0; t < keep.size(); ++t) {
        if (!keep[t]) continue;
        part.triangles.push_back(t);
        for (const VertexId v : surface.triangles()[t]) used[v] = true;
    }
    const std::vector<std::uint16_t> openings = openings_of_vertices(surface);
    for (VertexId v = 0; v < used.size(); ++v) {
        if (!used[v]) continue;
        part.origins.push_back(v);
        part.opening.push_back(openings[v]);
    }
    part.normals = vertex_normals(part.wall);
    return part;
}

Vec3 in_opening(const LayeredWall& wall, VertexId v, const Vec3& vector) {
    const Vec3& plane = wall.planes[wall.opening[v]];  // zero for the wall's own patch
    return vector - plane.dot(vector) * plane;
}

}  // namespace vesselbench
