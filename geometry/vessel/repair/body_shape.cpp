#include "geometry/vessel/repair/body_shape.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "geometry/kernel/cross_section.h"
#include "geometry/kernel/measure.h"
#include "geometry/kernel/surface_distance.h"

namespace vesselbench {

namespace {

constexpr int kSamples = 256;  ///< places on the body, evenly by area
constexpr int kWays = 8;       ///< directions across, half a turn
/// Largest width over depth [-] of a round section: an ellipse of 1 : 2.4 seen from its flat side.
constexpr double kRound = 2.5;
/// Rays begin so far below the surface [of the square root of its area].
constexpr double kJustInside = 1e-6;

/// Depth and widths are measured from inside.
class Probe {
public:
    explicit Probe(const Surface& body)
        : distance_(body.points(), body.triangles()), skin_(kJustInside * std::sqrt(area(body))) {}

    /// \param outward unit normal at the point
    [[nodiscard]] bool is_round_behind(const Vec3& point, const Vec3& outward) const {
        const auto depth = reach(point - skin_ * outward, -outward);
        if (!depth || !(*depth > 0.0)) return false;
        const Vec3 middle = point - 0.5 * *depth * outward;
        const auto [u, v] = plane_axes(outward);
        double narrowest = std::numeric_limits<double>::infinity();
        for (int k = 0; k < kWays; ++k) {
            const double angle = std::numbers::pi * k / kWays;
            const Vec3 way = std::cos(angle) * u + std::sin(angle) * v;
            const auto one = reach(middle, way), other = reach(middle, -way);
            if (one && other) narrowest = std::min(narrowest, *one + *other);
        }
        return narrowest <= kRound * *depth;
    }

private:
    [[nodiscard]] std::optional<double> reach(const Vec3& from, const Vec3& way) const {
        const auto hit = distance_.first_hit(from, way);
        return hit ? std::optional(hit->distance) : std::nullopt;
    }

    SurfaceDistance distance_;
    double skin_;  ///< [mm]
};

}  // namespace

BodyShape body_shape(const Surface& body) {
    const Bounds box = bounds(body);
    BodyShape shape{
        .area = area(body), .centre = 0.5 * (box.min + box.max), .size = box.max - box.min};
    if (!(shape.area > 0.0)) return shape;
    const Probe probe(body);
    const double outward = volume(body) < 0.0 ? -1.0 : 1.0;
    const double step = shape.area / kSamples;
    double passed = 0.0, next = 0.5 * step;
    int round = 0, samples = 0;
    for (const Triangle& corners : body.triangles()) {
        const Vec3 normal = area_normal(body.points(), corners);
        passed += 0.5 * normal.norm();
        for (; next <= passed; next += step, ++samples) {
            // Places in a large triangle differ: the fractions of multiples of irrational numbers.
            const double along = std::fmod(0.7548776662466927 * samples, 1.0);
            const double root = std::sqrt(std::fmod(0.5698402909980532 * samples, 1.0));
            const Vec3 &a = body.points()[corners[0]], &b = body.points()[corners[1]],
                       &c = body.points()[corners[2]];
            const Vec3 point = (1.0 - root) * a + root * ((1.0 - along) * b + along * c);
            if (probe.is_round_behind(point, outward * normal.normalized())) ++round;
        }
    }
    shape.round = static_cast<double>(round) / std::max(1, samples);
    return shape;
}

}  // namespace vesselbench
