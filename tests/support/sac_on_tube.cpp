#include "tests/support/sac_on_tube.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/vessel/repair/repair.h"
#include "tests/support/iso_surface.h"

namespace vesselbench::test {

Surface sac_on_tube(double cell) {
    const auto shape = [](const Vec3& x) {
        return std::min(capsule(x, Vec3(-9, 0, 0), Vec3(9, 0, 0), kSacTube),
                        (x - Vec3(0, 0, kSacMiddle)).norm() - kSacRadius);
    };
    return repair(iso_surface(shape, {Vec3(-11.3, -3.1, -2.3), Vec3(11.3, 3.1, 6.9)}, cell))
        .surface;
}

Vec3 sac_dome() {
    return {0.0, 0.0, kSacMiddle + kSacRadius};
}

SphereAbove sphere_above(double z) {
    const double up = kSacMiddle - z, height = kSacRadius + up;
    return {.height = height,
            .neck_radius = std::sqrt(kSacRadius * kSacRadius - up * up),
            .dome_area = 2.0 * std::numbers::pi * kSacRadius * height,
            .volume = std::numbers::pi * height * height * (3.0 * kSacRadius - height) / 3.0};
}

}  // namespace vesselbench::test
