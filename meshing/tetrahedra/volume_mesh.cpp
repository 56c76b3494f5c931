#include "meshing/tetrahedra/volume_mesh.h"

namespace vesselbench {

Vec3 face_normal(const Positions& points, const FaceCorners& face) {
    if (face.size() == 3) return area_normal(points, {face[0], face[1], face[2]});
    return (points[face[2]] - points[face[0]]).cross(points[face[3]] - points[face[1]]);
}

double prism_volume(const Positions& points, const Prism& prism) {
    const Vec3& origin = points[prism[0]];
    double six_fold = 0.0;
    for (const FaceCorners& face : faces_of(prism)) {
        Vec3 middle = Vec3::Zero();
        for (const VertexId v : face) middle += (points[v] - origin) / double(face.size());
        six_fold += middle.dot(face_normal(points, face));
    }
    return six_fold / 6.0;
}

Surface boundary_surface(const VolumeMesh& mesh) {
    constexpr VertexId kUnused = 0xFFFFFFFF;
    std::vector<VertexId> names(mesh.points.size(), kUnused);
    Positions points;
    std::vector<Triangle> triangles = mesh.boundary;
    PatchLabels labels = mesh.boundary_patches;
    for (std::size_t k = 0; k < mesh.boundary_sides.size(); ++k) {
        const auto& [a, b, c, d] = mesh.boundary_sides[k];
        triangles.insert(triangles.end(), {{a, b, c}, {a, c, d}});
        labels.insert(labels.end(), 2, mesh.side_patches[k]);
    }
    for (Triangle& triangle : triangles)
        for (VertexId& v : triangle) {
            if (names[v] == kUnused) {
                names[v] = static_cast<VertexId>(points.size());
                points.push_back(mesh.points[v]);
            }
            v = names[v];
        }
    return make_surface(std::move(points), std::move(triangles), std::move(labels), mesh.patches);
}

double volume(const VolumeMesh& mesh) {
    double six_fold = 0.0;
    for (const auto& [a, b, c, d] : mesh.tetrahedra) {
        const Vec3& origin = mesh.points[a];
        six_fold +=
            (mesh.points[b] - origin).cross(mesh.points[c] - origin).dot(mesh.points[d] - origin);
    }
    double prisms = 0.0;
    for (const Prism& prism : mesh.prisms) prisms += prism_volume(mesh.points, prism);
    return six_fold / 6.0 + prisms;
}

}  // namespace vesselbench
