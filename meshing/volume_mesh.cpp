#include "meshing/volume_mesh.h"

namespace vesselbench {

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
