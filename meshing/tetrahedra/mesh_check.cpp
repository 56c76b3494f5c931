#include "meshing/tetrahedra/mesh_check.h"

#include <cmath>

#include "geometry/kernel/disjoint_sets.h"
#include "geometry/kernel/measure.h"

namespace vesselbench {

namespace {

std::vector<double> patch_areas(const Positions& points, std::span<const Triangle> triangles,
                                const PatchLabels& labels, std::size_t patches) {
    std::vector<double> areas(patches, 0.0);
    for (std::size_t t = 0; t < triangles.size(); ++t)
        areas[labels[t]] += triangle_area(points, triangles[t]);
    return areas;
}

std::vector<double> patch_areas(const VolumeMesh& mesh) {
    std::vector<double> areas =
        patch_areas(mesh.points, mesh.boundary, mesh.boundary_patches, mesh.patches.size());
    for (std::size_t k = 0; k < mesh.boundary_sides.size(); ++k)
        areas[mesh.side_patches[k]] +=
            0.5 * face_normal(mesh.points, mesh.boundary_sides[k]).norm();
    return areas;
}

std::vector<std::size_t> patch_counts(const PatchLabels& labels, std::size_t patches) {
    std::vector<std::size_t> counts(patches, 0);
    for (const auto label : labels) ++counts[label];
    return counts;
}

// Groups of cells connected through faces; more than one group means that the region fell apart.
std::size_t region_count(const VolumeMesh& mesh, std::span<const MeshFace> faces) {
    DisjointSets sets(mesh.cell_count());
    std::size_t regions = mesh.cell_count();
    for (const MeshFace& face : faces)
        if (face.neighbour != MeshFace::kOutside && sets.join(face.owner, face.neighbour))
            --regions;
    return regions;
}

}  // namespace

std::string mesh_loss(const VolumeMesh& mesh, std::span<const MeshFace> faces,
                      const Surface& surface, bool keeps_surface, double tolerance) {
    if (mesh.tetrahedra.empty()) return "no cells";
    const double wanted = volume(surface), got = volume(mesh);
    if (std::abs(got - wanted) > tolerance * wanted)
        return "the cells fill " + std::to_string(got) + " mm^3 of " + std::to_string(wanted);
    for (const auto& [a, b, c, d] : mesh.tetrahedra) {
        const auto& p = mesh.points;
        if ((p[b] - p[a]).cross(p[c] - p[a]).dot(p[d] - p[a]) <= 0.0) return "a cell is inverted";
    }
    for (const Prism& prism : mesh.prisms)
        if (scaled_jacobian(mesh.points, prism) <= 0.0) return "a prism is folded";
    const std::size_t patches = surface.patches.size();
    if (keeps_surface && patch_counts(mesh.boundary_patches, patches) !=
                             patch_counts(*surface.patch_labels, patches))
        return "boundary triangles were lost or divided";
    const auto before =
        patch_areas(surface.points(), surface.triangles(), *surface.patch_labels, patches);
    const auto after = patch_areas(mesh);
    for (std::size_t k = 0; k < patches; ++k)
        if (std::abs(after[k] - before[k]) > tolerance * (before[k] + 1e-12))
            return "patch " + surface.patches[k].name + " lost area";
    return region_count(mesh, faces) == 1 ? "" : "the cells form several regions";
}

}  // namespace vesselbench
