// The reference of `scripts/experiments.py --only methods`, against what smoothing/ computes.

#include "tests/bench/reference_context_smoothing.h"

#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>

#include "smoothing/context/staircase_weights.h"
#include "smoothing/context/staircases.h"
#include "smoothing/filters/taubin.h"
#include "tests/support/iso_surface.h"
#include "tests/support/shapes.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

/// A ball in slices 4 mm apart, in the image's axes.
Surface terraced_ball(double radius, const Eigen::Matrix3d& axes) {
    const auto shape = [&](const Vec3& p) {
        const double z = 4.0 * std::round(p.z() / 4.0);
        return std::max(Vec3(p.x(), p.y(), z).norm() - radius, std::abs(p.z()) - radius);
    };
    const Vec3 corner = Vec3::Constant(radius + 2.0);
    return mapped(iso_surface(shape, {-corner, corner}, 0.8),
                  [&](const Vec3& p) { return Vec3(axes * p); });
}

}  // namespace

SCENARIO("The reference of InVesalius's smoothing has the weights of the thesis's definition",
         "[smoothing][reference]") {
    const Eigen::Matrix3d axes = skew_rotation();
    const Surface ball = terraced_ball(14.0, axes);
    const std::vector<double> weights = bench::context_weights(ball, axes);
    const std::vector<double> ours = staircase_weights(
        *ball.topology, ball.points(), orientation_change(*ball.topology, ball.points(), axes),
        {.tau_theta = 0.7, .tau_max = 3.0, .beta_min = 0.5});
    REQUIRE(weights.size() == ours.size());
    double largest = 0.0;
    for (std::size_t v = 0; v < ours.size(); ++v)
        largest = std::max(largest, std::abs(weights[v] - ours[v]));
    CHECK(largest < 1e-12);
    CHECK(std::ranges::count(weights, 1.0) > 100);
    CHECK(std::ranges::min(weights) < 0.6);
}

SCENARIO("With equal weights the reference of InVesalius's smoothing is Taubin's filter",
         "[smoothing][reference]") {
    const Surface ball = terraced_ball(14.0, Eigen::Matrix3d::Identity());
    const Positions moved =
        bench::context_smoothed(ball, std::vector<double>(ball.vertex_count(), 1.0), 10);
    const Positions ours =
        taubin(*ball.topology, ball.points(), {.lambda = 0.5, .mu = -0.53}, {.iterations = 10});
    double largest = 0.0, farthest = 0.0;
    for (std::size_t v = 0; v < ours.size(); ++v) {
        largest = std::max(largest, (moved[v] - ours[v]).norm());
        farthest = std::max(farthest, (moved[v] - ball.points()[v]).norm());
    }
    CHECK(largest < 1e-12);
    CHECK(farthest > 0.3);
}
