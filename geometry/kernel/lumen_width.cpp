#include "geometry/kernel/lumen_width.h"

#include <cmath>
#include <numbers>

#include "geometry/kernel/statistics.h"

namespace vesselbench {

double lumen_width(const SurfaceDistance& wall, const Vec3& at, const Vec3& inward,
                   double farthest) {
    constexpr int kRays = 6;
    const double skin = 1e-6 * farthest;  // skips the wall that the ray starts on
    const Vec3 x = inward.unitOrthogonal(), y = inward.cross(x);
    std::vector<double> lengths;
    const auto shoot = [&](const Vec3& direction) {
        const auto hit = wall.first_hit(at + skin * direction, direction, farthest);
        if (hit) lengths.push_back(hit->distance + skin);
    };
    shoot(inward);
    for (int i = 0; i < kRays; ++i) {
        const double turn = 2.0 * std::numbers::pi * i / kRays;
        shoot((std::cos(std::numbers::pi / 6) * inward +
               std::sin(std::numbers::pi / 6) * (std::cos(turn) * x + std::sin(turn) * y))
                  .normalized());
    }
    return lengths.empty() ? 0.0 : median(std::move(lengths));
}

}  // namespace vesselbench
