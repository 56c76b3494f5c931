#include "geometry/kernel/facing_walls.h"

#include <algorithm>
#include <optional>

#include <tbb/parallel_for.h>

#include "geometry/kernel/measure.h"
#include "geometry/kernel/reached_distances.h"
#include "geometry/kernel/shortest_paths.h"
#include "geometry/kernel/vertex_normals.h"

namespace vesselbench {

namespace {

// Facing: the normals differ by more than 120 degrees.
constexpr double kFacing = -0.5;
// A half circle's arc is 1.57 times its opening: the bottom of a fold. Two branches are farther
// apart.
constexpr double kDetour = 3.0;

std::vector<std::uint8_t> on_openings(const Surface& surface) {
    std::vector<std::uint8_t> flags(surface.vertex_count(), 0);
    for (TriangleId t = 0; t < surface.triangle_count(); ++t)
        if (surface.patch_of(t).kind != PatchKind::Wall)
            for (const VertexId v : surface.triangles()[t]) flags[v] = 1;
    return flags;
}

}  // namespace

std::vector<FacingWall> facing_walls(const Surface& surface, const SurfaceDistance& search,
                                     FacingSide side, double reach) {
    const double sign = side == FacingSide::Lumen ? -1.0 : 1.0;
    const Positions normals = vertex_normals(surface);
    const auto skipped = on_openings(surface);
    const double lift =
        1e-6 * bounds(surface).diagonal();  // away from the triangles at the vertex itself
    std::vector<std::optional<FacingWall>> found(surface.vertex_count());
    tbb::parallel_for(std::size_t{0}, found.size(), [&](std::size_t v) {
        if (skipped[v] != 0 || normals[v].squaredNorm() < 0.5) return;
        const Vec3 direction = sign * normals[v], start = surface.points()[v] + lift * direction;
        const auto hit = search.first_hit(start, direction, reach);
        if (!hit || surface.patch_of(hit->triangle).kind != PatchKind::Wall) return;
        const Vec3 normal =
            area_normal(surface.points(), surface.triangles()[hit->triangle]).normalized();
        if (normal.dot(normals[v]) > kFacing) return;
        found[v] =
            FacingWall{hit->distance + lift, static_cast<VertexId>(v), hit->point, hit->triangle};
    });
    std::vector<FacingWall> walls;
    for (const auto& facing : found)
        if (facing) walls.push_back(*facing);
    std::ranges::stable_sort(walls, {}, &FacingWall::distance);
    return walls;
}

bool is_fold(const Surface& surface, const FacingWall& facing, double crease) {
    const Triangle& target = surface.triangles()[facing.triangle];
    const double reach = std::max(kDetour * facing.distance, crease);
    ReachedDistances distances;
    ShortestPaths paths(distances);
    paths.lower(facing.from, 0.0);
    while (const auto at = paths.next()) {
        if (std::ranges::find(target, at->vertex) != target.end()) return true;
        for (const VertexId u : surface.topology->rings().row(at->vertex)) {
            const double way =
                at->distance + (surface.points()[u] - surface.points()[at->vertex]).norm();
            if (way <= reach) paths.lower(u, way);
        }
    }
    return false;
}

}  // namespace vesselbench
