#include "geometry/vessel/openings/flat_caps.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "geometry/kernel/edges.h"
#include "geometry/kernel/surface_distance.h"
#include "geometry/vessel/centerlines/flat_closures.h"
#include "geometry/vessel/openings/opening_axis.h"
#include "geometry/vessel/openings/patch_rim.h"

namespace vesselbench {

namespace {

/// Cosine of 0.5 degrees. Faces of a staircase are parallel but for rounding; of a straight
/// vessel's wall at right angles to the cap, 0.6 % are so near to its direction.
constexpr double kParallel = 0.99996;
/// Staircases of voxels have 3.5 % of their wall parallel to a step, and more.
constexpr double kMostParallel = 0.02;

/// Fraction of the wall's area that is parallel to a direction.
double parallel_share(const Surface& surface, const Vec3& direction) {
    double parallel = 0.0, whole = 0.0;
    for (TriangleId t = 0; t < surface.triangle_count(); ++t) {
        if ((*surface.patch_labels)[t] != 0) continue;
        const Vec3 normal = area_normal(surface.points(), surface.triangles()[t]);
        const double size = normal.norm();
        whole += size;
        if (std::abs(normal.dot(direction)) > kParallel * size) parallel += size;
    }
    return whole > 0.0 ? parallel / whole : 1.0;
}

/// True if the triangles, connected along edges, have one simple rim.
bool is_disc(const Surface& surface, const std::vector<TriangleId>& triangles) {
    std::set<VertexId> vertices;
    std::set<std::pair<VertexId, VertexId>> edges;
    for (const TriangleId t : triangles)
        for (std::size_t k = 0; k < 3; ++k) {
            const VertexId a = surface.triangles()[t][k], b = surface.triangles()[t][(k + 1) % 3];
            vertices.insert(a);
            edges.insert(std::minmax(a, b));
        }
    return vertices.size() + triangles.size() == edges.size() + 1;
}

/// With the vertices inside a patch moved into the plane of its rim.
Surface flattened(const Surface& surface, std::size_t patch) {
    const Vec3 normal = patch_shape(surface, patch).plane.normal;
    const std::vector<VertexId> rim = patch_rim(surface, patch).loop;
    std::vector<bool> on_rim(surface.vertex_count(), false);
    Vec3 centre = Vec3::Zero();
    for (const VertexId v : rim) {
        on_rim[v] = true;
        centre += surface.points()[v] / static_cast<double>(rim.size());
    }
    const Plane plane{centre, normal};
    Positions points = surface.points();
    for (TriangleId t = 0; t < surface.triangle_count(); ++t)
        if ((*surface.patch_labels)[t] == patch)
            for (const VertexId v : surface.triangles()[t])
                if (!on_rim[v]) points[v] = plane.projected(surface.points()[v]);
    return surface.with_positions(std::move(points));
}

/// With discs as patches of kind Cut.
Surface with_caps(const Surface& surface, const std::vector<std::vector<TriangleId>>& discs) {
    PatchLabels labels(surface.triangle_count(), 0);
    std::vector<Patch> patches = surface.patches;
    for (const auto& disc : discs) {
        const auto label = static_cast<std::uint16_t>(patches.size());
        for (const TriangleId t : disc) labels[t] = label;
        patches.push_back({"cut_" + std::to_string(label), PatchKind::Cut});
    }
    return surface.with_patches(std::move(labels), std::move(patches));
}

bool is_step(const Surface& surface, std::size_t patch) {
    return parallel_share(surface, patch_shape(surface, patch).plane.normal) > kMostParallel;
}

}  // namespace

Surface label_flat_caps(const Surface& surface) {
    if (surface.empty() || surface.patches.size() > 1) return surface;
    const SurfaceDistance distance(surface);
    auto [caps, mouths] = find_flat_closures(surface.points(), surface.triangles(), distance);
    const auto is_no_disc = [&](const auto& triangles) { return !is_disc(surface, triangles); };
    std::erase_if(caps, is_no_disc);
    std::erase_if(mouths, is_no_disc);
    if (caps.empty()) return surface;
    const std::size_t closures = caps.size();
    caps.insert(caps.end(), mouths.begin(), mouths.end());
    const Surface all = with_caps(surface, caps);
    for (std::size_t p = 1; p <= closures; ++p)
        if (is_step(all, p)) return surface;
    for (std::size_t p = caps.size(); p > closures; --p)
        if (is_step(all, p)) caps.erase(caps.begin() + static_cast<std::ptrdiff_t>(p) - 1);
    Surface found = with_caps(surface, caps);
    for (std::size_t p = 1; p < found.patches.size(); ++p) found = flattened(found, p);
    return found;
}

}  // namespace vesselbench
