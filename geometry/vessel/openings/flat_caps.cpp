#include "geometry/vessel/openings/flat_caps.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "geometry/kernel/edges.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/measure.h"
#include "geometry/kernel/surface_distance.h"
#include "geometry/vessel/centerlines/flat_closures.h"
#include "geometry/vessel/centerlines/terraces.h"
#include "geometry/vessel/ends/flat_faces.h"
#include "geometry/vessel/openings/opening_axis.h"
#include "geometry/vessel/openings/opening_names.h"
#include "geometry/vessel/openings/patch_rim.h"

namespace vesselbench {

namespace {

/// With a larger share of its area in such faces, the surface is a box rather than a vessel.
constexpr double kMostFlat = 0.45;
/// A disc has at least as many triangles as a hexagon.
constexpr std::size_t kFewestOfCap = 4;

template <class T>
std::size_t count_of_different(std::vector<T>& values) {
    std::ranges::sort(values);
    return static_cast<std::size_t>(std::ranges::unique(values).begin() - values.begin());
}

/// True if the triangles, connected along edges, have one simple rim.
bool is_disc(const Surface& surface, const std::vector<TriangleId>& triangles) {
    std::vector<VertexId> vertices;
    std::vector<std::pair<VertexId, VertexId>> edges;
    for (const TriangleId t : triangles)
        for (std::size_t k = 0; k < 3; ++k) {
            const VertexId a = surface.triangles()[t][k], b = surface.triangles()[t][(k + 1) % 3];
            vertices.push_back(a);
            edges.push_back(std::minmax(a, b));
        }
    return count_of_different(vertices) + triangles.size() == count_of_different(edges) + 1;
}

enum class RimVertices { Stay, Move };

/// With the vertices inside a patch, and perhaps on its rim, moved into the plane of its rim.
Surface flattened(const Surface& surface, std::size_t patch, RimVertices rim_vertices) {
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
                if (!on_rim[v] || rim_vertices == RimVertices::Move)
                    points[v] = plane.projected(surface.points()[v]);
    return surface.with_positions(std::move(points));
}

/// With discs as patches of kind Cut.
Surface with_caps(const Surface& surface, const std::vector<std::vector<TriangleId>>& discs) {
    PatchLabels labels = *surface.patch_labels;
    std::vector<Patch> patches = surface.patches;
    for (const auto& disc : discs) {
        const auto label = static_cast<std::uint16_t>(patches.size());
        for (const TriangleId t : disc) labels[t] = label;
        patches.push_back({free_patch_name("cut", 1, patches), PatchKind::Cut});
    }
    return surface.with_patches(std::move(labels), std::move(patches));
}

bool has_one_rim(const Surface& surface, std::size_t patch) {
    try {
        return !patch_rim(surface, patch).loop.empty();
    } catch (const AlgorithmFailure&) {
        return false;
    }
}

bool is_step(const Surface& surface, std::size_t patch) {
    std::vector<Triangle> wall;
    for (TriangleId t = 0; t < surface.triangle_count(); ++t)
        if ((*surface.patch_labels)[t] == 0) wall.push_back(surface.triangles()[t]);
    return is_terrace(surface.points(), wall, patch_shape(surface, patch).plane.normal);
}

}  // namespace

Surface label_flat_caps(const Surface& surface, const Progress& progress) {
    if (surface.empty() || surface.patches.size() > 1) return surface;
    progress.report(0.0, "looking for flat caps");
    const SurfaceDistance distance = distance_to(surface);
    auto [caps, mouths] = find_flat_closures(surface.points(), surface.triangles(), distance);
    const auto is_no_disc = [&](const auto& triangles) { return !is_disc(surface, triangles); };
    std::erase_if(caps, is_no_disc);
    std::erase_if(mouths, is_no_disc);
    if (caps.empty()) return surface;
    caps.insert(caps.end(), mouths.begin(), mouths.end());
    Surface found = with_caps(surface, caps);
    for (std::size_t p = 1; p < found.patches.size(); ++p)
        found = flattened(found, p, RimVertices::Stay);
    return found;
}

Surface without_stray_labels(const Surface& surface) {
    std::vector<std::size_t> counts(surface.patches.size(), 0);
    for (const std::uint16_t label : *surface.patch_labels) ++counts[label];
    std::vector<Patch> patches;
    std::vector<std::uint16_t> now(surface.patches.size(), 0);
    for (std::size_t p = 0; p < surface.patches.size(); ++p) {
        if (p > 0 && counts[p] < kFewestOfCap) continue;
        now[p] = static_cast<std::uint16_t>(patches.size());
        patches.push_back(surface.patches[p]);
    }
    if (patches.size() == surface.patches.size()) return surface;
    PatchLabels labels = *surface.patch_labels;
    for (std::uint16_t& label : labels) label = now[label];
    return surface.with_patches(std::move(labels), std::move(patches));
}

Surface label_flat_faces(const Surface& surface, const Progress& progress) {
    if (surface.empty()) return surface;
    const std::vector<FlatFace> faces = find_flat_faces(surface, progress);
    double flat = 0.0;
    for (const FlatFace& face : faces)
        for (const TriangleId t : face.triangles)
            flat += 0.5 * area_normal(surface.points(), surface.triangles()[t]).norm();
    if (flat > kMostFlat * area(surface)) return surface;
    Surface found = surface;
    for (const FlatFace& face : faces) {
        const std::size_t patch = found.patches.size();
        const Surface labelled = with_caps(found, {face.triangles});
        if (has_one_rim(labelled, patch) && !is_step(labelled, patch))
            found = flattened(labelled, patch, RimVertices::Move);
    }
    return found;
}

}  // namespace vesselbench
