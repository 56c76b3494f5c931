#include "meshing/tetrahedra/volume_mesh.h"

namespace vesselbench {

Surface boundary_surface(const VolumeMesh& mesh) {
    constexpr VertexId kUnused = 0xFFFFFFFF;
    std::vector<VertexId> names(mesh.points.size(), kUnused);
    Positions points;
    std::vector<Triangle> triangles = mesh.boundary;
    for (Triangle& triangle : triangles)
        for (VertexId& v : triangle) {
            if (names[v] == kUnused) {
                names[v] = static_cast<VertexId>(points.size());
                points.push_back(mesh.points[v]);
            }
            v = names[v];
        }
    return make_surface(std::move(points), std::move(triangles), mesh.boundary_patches,
                        mesh.patches);
}

double volume(const VolumeMesh& mesh) {
    double six_fold = 0.0;
    for (const auto& [a, b, c, d] : mesh.tetrahedra) {
        const Vec3& origin = mesh.points[a];
        six_fold +=
            (mesh.points[b] - origin).cross(mesh.points[c] - origin).dot(mesh.points[d] - origin);
    }
    return six_fold / 6.0;
}

}  // namespace vesselbench
