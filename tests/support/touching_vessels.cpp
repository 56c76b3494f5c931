#include "tests/support/touching_vessels.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "geometry/kernel/measure.h"

namespace vesselbench::test {

Surface solid_of(const ImplicitShape& shape, const Eigen::AlignedBox3d& box, double cell) {
    const Surface surface = iso_surface(shape, box, cell);
    if (volume(surface) > 0.0) return surface;
    std::vector<Triangle> turned(surface.triangles().begin(), surface.triangles().end());
    for (Triangle& t : turned) std::swap(t[1], t[2]);
    return make_surface(surface.points(), std::move(turned));
}

Surface touching_vessels(double cell) {
    return solid_of(
        [](const Vec3& p) {
            return std::min({capsule(p, {-8, 0, -2.5}, {8, 0, -2.5}, kTouchingRadius),
                             capsule(p, {0, -8, 2.5}, {0, 8, 2.5}, kTouchingRadius),
                             capsule(p, {0, 0, -2}, {0, 0, 2}, kTouchingBridge)});
        },
        Eigen::AlignedBox3d(Vec3(-11, -11, -6), Vec3(11, 11, 6)), cell);
}

}  // namespace vesselbench::test
