#include "geometry/kernel/lumen_width.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <span>
#include <vector>

namespace vesselbench {

std::optional<double> lumen_width(const SurfaceDistance& wall, const Vec3& at, const Vec3& inward,
                                  double farthest) {
    constexpr int kRays = 12;             // with six, the width of a tube depends on their turn
    const double skin = 1e-6 * farthest;  // skips the wall that the ray starts on
    const double along = std::cos(std::numbers::pi / 6), across = std::sin(std::numbers::pi / 6);
    const Vec3 x = inward.unitOrthogonal(), y = inward.cross(x);
    std::vector<double> lengths;
    for (int i = 0; i < kRays; ++i) {
        const double turn = 2.0 * std::numbers::pi * i / kRays;
        const Vec3 direction = along * inward + across * (std::cos(turn) * x + std::sin(turn) * y);
        const auto hit = wall.first_hit(at + skin * direction, direction, farthest);
        if (hit) lengths.push_back(hit->distance + skin);
    }
    if (lengths.empty()) return std::nullopt;
    std::ranges::sort(lengths);
    const auto ends = static_cast<std::ptrdiff_t>(lengths.size() / 4);
    const std::span middle(lengths.begin() + ends, lengths.end() - ends);
    return std::accumulate(middle.begin(), middle.end(), 0.0) / static_cast<double>(middle.size());
}

}  // namespace vesselbench
