#include "geometry/kernel/lumen_width.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace vesselbench {

std::optional<double> lumen_width(const SurfaceDistance& wall, const Vec3& at, const Vec3& inward,
                                  double farthest) {
    constexpr int kPairs = 3;
    constexpr double kNone = std::numeric_limits<double>::infinity();
    const double skin = 1e-6 * farthest;  // skips the wall that the ray starts on
    const double along = std::cos(std::numbers::pi / 6), across = std::sin(std::numbers::pi / 6);
    const auto length = [&](const Vec3& direction) {
        const auto hit = wall.first_hit(at + skin * direction, direction, farthest);
        return hit ? hit->distance + skin : kNone;
    };
    const Vec3 x = inward.unitOrthogonal(), y = inward.cross(x);
    double sum = 0.0;
    int count = 0;
    for (int i = 0; i < kPairs; ++i) {
        const double turn = std::numbers::pi * i / kPairs;
        const Vec3 sideways = across * (std::cos(turn) * x + std::sin(turn) * y);
        const double shorter =
            std::min(length(along * inward + sideways), length(along * inward - sideways));
        if (shorter == kNone) continue;
        sum += shorter;
        ++count;
    }
    if (count == 0) return std::nullopt;
    return sum / count;
}

}  // namespace vesselbench
