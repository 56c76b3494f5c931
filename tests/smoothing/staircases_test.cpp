#include "smoothing/context/staircases.h"

#include <cmath>
#include <deque>
#include <random>

#include <catch2/catch.hpp>

#include "geometry/kernel/errors.h"
#include "smoothing/context/staircase_weights.h"
#include "smoothing/filters/laplace.h"
#include "tests/support/iso_surface.h"
#include "tests/support/shapes.h"
#include "tests/support/surface_facts.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

const Vec3 kAlongZ(0, 0, 1);

std::vector<double> weights_of(const Surface& surface, const Vec3& axis,
                               const StaircaseParameters& parameters) {
    const auto change = orientation_change(*surface.topology, surface.points(), axis);
    return staircase_weights(*surface.topology, surface.points(), change, parameters);
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
    REQUIRE(a.size() == b.size());
    double largest = 0.0;
    for (std::size_t v = 0; v < a.size(); ++v) largest = std::max(largest, std::abs(a[v] - b[v]));
    return largest;
}

/// A sheet folded along lines parallel to y: `profile` gives (x, z) of the lines, 2 mm apart in y.
Surface folded_sheet(const std::vector<std::pair<double, double>>& profile, int rows) {
    Positions points;
    std::vector<Triangle> triangles;
    const auto columns = static_cast<VertexId>(profile.size());
    for (int j = 0; j < rows; ++j)
        for (const auto& [x, z] : profile) points.emplace_back(x, 2.0 * j, z);
    for (VertexId j = 0; j + 1 < static_cast<VertexId>(rows); ++j)
        for (VertexId i = 0; i + 1 < columns; ++i) {
            const VertexId a = j * columns + i;
            triangles.push_back({a, a + 1, a + columns + 1});
            triangles.push_back({a, a + columns + 1, a + columns});
        }
    return make_surface(std::move(points), std::move(triangles));
}

/// A ball in slices 3 mm apart, as extracted from a binary mask.
Surface terraced_ball(double radius) {
    const auto shape = [&](const Vec3& p) {
        const double z = 3.0 * std::round(p.z() / 3.0);
        return std::max(Vec3(p.x(), p.y(), z).norm() - radius, std::abs(p.z()) - radius);
    };
    const double edge = radius + 2.0;
    return iso_surface(shape, {Vec3(-edge, -edge, -edge), Vec3(edge, edge, edge)}, 0.83);
}

}  // namespace

SCENARIO("Weights of a 20-vertex step match those computed by hand", "[smoothing][staircases]") {
    // Side view, z over x [mm], 4 lines along y make 5 columns of 4 vertices:
    //
    //                  3-----4      z = 3
    //                  |
    //      0-----1-----2            z = 0
    //      x=0   2     4     6
    //
    // The tread's faces have theta 0, the riser's (between lines 2 and 3) 1: lines 2 and 3 are the
    // staircase, theta' = 1. Line 1 is 2 mm from line 2, line 0 4 mm; line 4 is 2 mm from line 3.
    const Surface step = folded_sheet({{0, 0}, {2, 0}, {4, 0}, {4, 3}, {6, 3}}, 4);
    REQUIRE(step.vertex_count() == 20);
    const std::vector<double> change = orientation_change(*step.topology, step.points(), kAlongZ);
    const double expected_change[5] = {0, 0, 1, 1, 0};
    // tau_max = 3: w = 1 - d / 3, and with beta_min = 0.1 w' = 0.9 w + 0.1
    const double expected[5] = {0.1, 0.4, 1.0, 1.0, 0.4};
    const auto weights = weights_of(step, kAlongZ, {.beta_min = 0.1});
    // thesis scaling: the largest distance within tau_max is 2, so that lines 1 and 4 get 0
    const auto printed = weights_of(step, kAlongZ, {.scaling = StaircaseScaling::Thesis});
    const double expected_printed[5] = {0, 0, 1, 1, 0};
    for (std::size_t v = 0; v < 20; ++v) {
        CAPTURE(v);
        CHECK(change[v] == Approx(expected_change[v % 5]).margin(1e-12));
        CHECK(weights[v] == Approx(expected[v % 5]).margin(1e-12));
        CHECK(printed[v] == Approx(expected_printed[v % 5]).margin(1e-12));
    }
}

SCENARIO("Random staircase vertices on folded sheets: exact where sheets come close",
         "[smoothing][staircases]") {
    // a narrow hairpin: its legs are 0.7 mm apart
    std::vector<std::pair<double, double>> hairpin;
    for (int i = 0; i <= 20; ++i) hairpin.emplace_back(i, 0.0);
    for (int i = 20; i >= 0; --i) hairpin.emplace_back(i, 0.7);
    const Surface sheet = folded_sheet(hairpin, 15);
    std::mt19937 random(4);
    std::bernoulli_distribution chosen(0.05);
    std::vector<double> change(sheet.vertex_count());
    for (double& value : change) value = chosen(random) ? 1.0 : 0.0;
    const auto distances = staircase_distances(*sheet.topology, sheet.points(), change);
    for (VertexId v = 0; v < change.size(); ++v) {
        double expected = std::numeric_limits<double>::infinity();
        for (VertexId s = 0; s < change.size(); ++s) {
            if (change[s] == 0.0) continue;
            std::vector<bool> seen(change.size(), false);
            std::deque<VertexId> queue{s};
            seen[s] = true;
            while (!queue.empty()) {
                const VertexId at = queue.front();
                queue.pop_front();
                if (at == v) {
                    expected = std::min(expected, (sheet.points()[v] - sheet.points()[s]).norm());
                    break;
                }
                for (const VertexId u : sheet.topology->rings().row(at))
                    if (!seen[u] && (sheet.points()[u] - sheet.points()[s]).norm() <= 3.0) {
                        seen[u] = true;
                        queue.push_back(u);
                    }
            }
        }
        CHECK(distances[v] == expected);
    }
}

SCENARIO("A staircase does not reach a wall that only passes it", "[smoothing][staircases]") {
    const Surface step = folded_sheet({{0, 0}, {2, 0}, {4, 0}, {4, 3}, {6, 3}}, 4);
    const Surface beside = mapped(folded_sheet({{0, 0}, {2, 0}, {4, 0}}, 4),
                                  [](const Vec3& p) { return Vec3(p + Vec3(1.0, 0.0, -0.5)); });
    const auto weights = weights_of(merged(step, beside), kAlongZ, {});
    for (std::size_t v = 20; v < weights.size(); ++v) CHECK(weights[v] == 0.0);
}

SCENARIO("Staircase awareness moves nothing without staircases and all with them everywhere",
         "[smoothing][staircases]") {
    const Surface ball = terraced_ball(9.0);
    const Topology& topology = *ball.topology;
    const std::vector<double> none(ball.vertex_count(), 0.0), all(ball.vertex_count(), 1.0);
    const auto smooth_with = [&](const std::vector<double>& change) {
        const auto weights = staircase_weights(topology, ball.points(), change);
        return laplace(topology, ball.points(), {}, {.weights = weights});
    };
    CHECK(smooth_with(none) == ball.points());
    CHECK(smooth_with(all) == laplace(topology, ball.points()));
    GIVEN("a smooth sphere") {
        const Surface sphere = icosphere(5.0, 3);
        for (const double weight : weights_of(sphere, kAlongZ, {})) CHECK(weight == 0.0);
        for (const double weight : weights_of(sphere, kAlongZ, {.beta_min = 0.2}))
            CHECK(weight == 0.2);
    }
}

SCENARIO("Orientation change does not depend on the axis' sign or length, nor on the place",
         "[smoothing][staircases]") {
    const Surface ball = terraced_ball(9.0);
    const auto change = orientation_change(*ball.topology, ball.points(), kAlongZ);
    CHECK(largest_difference(
              change, orientation_change(*ball.topology, ball.points(), -5.0 * kAlongZ)) < 1e-12);
    const Eigen::Matrix3d turn = skew_rotation();
    const Surface turned =
        mapped(ball, [&](const Vec3& p) { return Vec3(turn * p + Vec3(3, -2, 8)); });
    CHECK(largest_difference(change, orientation_change(*turned.topology, turned.points(),
                                                        turn * kAlongZ)) < 1e-9);
}

SCENARIO("Caps are no staircases", "[smoothing][staircases]") {
    const Surface step = folded_sheet({{0, 0}, {2, 0}, {4, 0}, {4, 3}, {6, 3}}, 4);
    std::vector<std::uint8_t> caps(20, 0);
    for (std::size_t v = 3; v < 20; v += 5) caps[v] = caps[v + 1] = 1;  // the upper tread
    const auto weights = weights_of(step, kAlongZ, {.beta_min = 0.1, .caps = caps});
    const double expected[5] = {0.1, 0.4, 1.0, 0.0, 0.0};
    for (std::size_t v = 0; v < 20; ++v) CHECK(weights[v] == Approx(expected[v % 5]));
}

SCENARIO("Staircase parameters without sense are refused by name", "[smoothing][staircases]") {
    const Surface step = folded_sheet({{0, 0}, {2, 0}, {4, 0}, {4, 3}, {6, 3}}, 4);
    const auto refused = [&](const Vec3& axis, const StaircaseParameters& p, const char* name) {
        CHECK_THROWS_WITH(weights_of(step, axis, p), Catch::Contains(name));
    };
    refused(Vec3::Zero(), {}, "stack_axis");
    refused(Vec3(0, std::nan(""), 1), {}, "stack_axis");
    refused(kAlongZ, {.tau_max = 0.0}, "tau_max");
    refused(kAlongZ, {.tau_max = std::nan("")}, "tau_max");
    refused(kAlongZ, {.tau_theta = 1.5}, "tau_theta");
    refused(kAlongZ, {.beta_min = -0.1}, "beta_min");
    GIVEN("degenerate, lonely and non-manifold parts") {
        const Surface odd =
            make_surface({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, -1, 0}, {9, 9, 9}},
                         {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}, {2, 2, 3}, {1, 1, 1}});
        for (const double weight : weights_of(odd, kAlongZ, {})) CHECK(std::isfinite(weight));
        CHECK(weights_of(make_surface({}, {}), kAlongZ, {}).empty());
    }
}
