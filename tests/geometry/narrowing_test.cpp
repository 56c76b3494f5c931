#include "geometry/vessel/narrowing/narrowing.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/measure.h"
#include "geometry/kernel/self_intersections.h"
#include "geometry/vessel/centerlines/centerlines.h"
#include "geometry/vessel/narrowing/correct_narrowing.h"
#include "geometry/vessel/narrowing/expected_radii.h"
#include "geometry/vessel/narrowing/named_narrowing.h"
#include "tests/support/shapes.h"
#include "tests/support/surface_facts.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

constexpr double kRadius = 2.0, kLength = 40.0, kMiddle = 20.0, kReach = 5.0;

double bell(double z) {
    const double x = (z - kMiddle) / kReach;
    return std::abs(x) < 1.0 ? 0.5 * (1.0 + std::cos(std::numbers::pi * x)) : 0.0;
}

/// A tube along z with flat caps, of `flat` times the width along x, narrower by a share of its
/// radius around z = 20; a negative share is a bulge.
Surface narrow_tube(double share, double flat = 1.0) {
    return mapped(closed_tube(kRadius, kLength, 32, 160), [=](const Vec3& p) {
        const double width = 1.0 - share * bell(p.z());
        return Vec3(flat * width * p.x(), width * p.y(), p.z());
    });
}

std::vector<Narrowing> narrowings(const Surface& surface, double resolution = 0.1) {
    return find_narrowings(surface, *centerlines_of(surface), {.resolution = resolution});
}

CorrectedNarrowing corrected(const Surface& surface, const NarrowingCorrection& parameters = {}) {
    const NamedNarrowing named = narrowing_at(surface, {.at = Vec3(0, 0, kMiddle)});
    return correct_narrowing(surface, *named.graph, named.rings, named.narrowing, parameters);
}

/// The code with which a call is refused.
template <class Call>
std::string code_of(const Call& call) {
    try {
        call();
    } catch (const std::exception& error) {
        return diagnostics_of(error).front().code;
    }
    return "";
}

/// Largest difference of the wall from an ellipse of half axes flat * radius and radius, along z.
double largest_error(const Surface& surface, double flat) {
    double largest = 0.0;
    for (const Vec3& p : surface.points()) {
        if (p.z() < 1.0 || p.z() > kLength - 1.0) continue;
        const double radius = std::hypot(p.x() / flat, p.y());
        largest = std::max(largest, std::abs(radius - kRadius));
    }
    return largest;
}

}  // namespace

SCENARIO("A narrowing is found with its place, extent and depth", "[geometry][narrowing]") {
    const double share = GENERATE(0.25, 0.4, 0.6);
    const auto found = narrowings(narrow_tube(share));
    REQUIRE(found.size() == 1);
    CHECK(found[0].place.z() == Approx(kMiddle).margin(0.4));
    CHECK(found[0].share() == Approx(share).margin(0.02));
    CHECK(found[0].expected_radius == Approx(kRadius).epsilon(0.01));
    CHECK(found[0].found_radius == Approx((1.0 - share) * kRadius).epsilon(0.03));
    CHECK(found[0].to - found[0].from > kReach);
    CHECK(found[0].to - found[0].from < 2.0 * kReach + 0.5);
    CHECK(found[0].certainty > 0.9);
}

SCENARIO("No narrowing where none is as deep as asked", "[geometry][narrowing]") {
    CHECK(narrowings(narrow_tube(0.0)).empty());
    CHECK(narrowings(narrow_tube(0.15)).empty());
    CHECK(narrowings(narrow_tube(-0.5)).empty());
    THEN("the resolution is a depth, too") {
        CHECK(narrowings(narrow_tube(0.3), 0.5).size() == 1);
        CHECK(narrowings(narrow_tube(0.3), 0.8).empty());
    }
    THEN("a taper is none") {
        CHECK(narrowings(mapped(narrow_tube(0.0), [](const Vec3& p) {
                  const double width = std::exp(-0.01 * p.z());
                  return Vec3(width * p.x(), width * p.y(), p.z());
              })).empty());
    }
    THEN("the wall's flatness is none") {
        CHECK(narrowings(mapped(narrow_tube(0.0), [](const Vec3& p) {
                  const double flat = 1.0 + 0.5 * bell(p.z());
                  return Vec3(flat * p.x(), p.y() / flat, p.z());
              })).empty());
    }
    CHECK_THROWS_AS(find_narrowings(narrow_tube(0.0), {}, {.least_share = 0.0}), InvalidInput);
}

SCENARIO("Narrowings do not depend on the direction and the unit", "[geometry][narrowing]") {
    const Surface tube = narrow_tube(0.4);
    const Eigen::Matrix3d turn = skew_rotation();
    const auto one = narrowings(tube);
    const auto other =
        narrowings(mapped(tube, [&](const Vec3& p) -> Vec3 { return 10.0 * (turn * p); }), 1.0);
    REQUIRE(one.size() == 1);
    REQUIRE(other.size() == 1);
    CHECK(other[0].share() == Approx(one[0].share()).margin(0.01));
    CHECK((other[0].place - 10.0 * (turn * one[0].place)).norm() < 10.0 * 0.5);
}

SCENARIO("The expected radius follows the vessel's taper and not its narrowing",
         "[geometry][narrowing]") {
    std::vector<RadiusSample> samples;
    for (int i = 0; i <= 100; ++i) {
        const double s = 0.4 * i;
        const bool narrow = s > 12.0 && s < 26.0;  // a third of the vessel
        samples.push_back({s, 2.0 * std::exp(-0.005 * s) * (narrow ? 0.5 : 1.0)});
    }
    const ExpectedRadii expected = expected_radii(samples);
    REQUIRE(expected.radii.size() == samples.size());
    for (std::size_t i = 0; i < samples.size(); ++i)
        CHECK(expected.radii[i] == Approx(2.0 * std::exp(-0.005 * samples[i].along)).epsilon(0.01));
    samples.resize(3);
    CHECK(expected_radii(samples).radii.empty());
}

SCENARIO("A corrected narrowing has the radius beside it, and its section's shape",
         "[geometry][narrowing]") {
    const double flat = GENERATE(1.0, 0.7);
    const Surface tube = narrow_tube(0.5, flat);
    const CorrectedNarrowing result = corrected(tube);
    CHECK(largest_error(tube, flat) > 0.9);
    CHECK(largest_error(result.surface, flat) < 0.08);
    CHECK(result.moved > 500);
    CHECK(result.farthest == Approx(1.0).epsilon(0.15));
    CHECK(self_intersections(result.surface).empty());
    CHECK(result.surface.topology == tube.topology);
    THEN("vertices beyond the stretch and its blends are the same bits") {
        for (std::size_t v = 0; v < tube.vertex_count(); ++v)
            if (std::abs(tube.points()[v].z() - kMiddle) > kReach + 2.5)
                CHECK(result.surface.points()[v] == tube.points()[v]);
    }
}

SCENARIO("Strength and radius say how wide it becomes", "[geometry][narrowing]") {
    const Surface tube = narrow_tube(0.5);
    CHECK(corrected(tube, {.strength = 0.0}).surface.points() == tube.points());
    CHECK(corrected(tube, {.strength = 0.5}).radius == Approx(std::sqrt(2.0)).epsilon(0.03));
    CHECK(corrected(tube, {.radius = 1.5}).radius == Approx(1.5).epsilon(0.02));
    CHECK(code_of([&] { (void)corrected(tube, {.radius = 0.9}); }) == "narrowing-radius-small");
    CHECK_THROWS_AS(corrected(tube, {.strength = 1.5}), InvalidInput);
    CHECK_THROWS_AS(corrected(tube, {.blend = 0.0}), InvalidInput);
}

SCENARIO("A thread is not widened, and no thorn grows", "[geometry][narrowing]") {
    CHECK(code_of([&] { (void)corrected(narrow_tube(0.85)); }) == "narrowing-nearly-closed");
    CHECK_NOTHROW(corrected(narrow_tube(0.85), {.radius = 1.0}));
    Positions points = narrow_tube(0.5).points();
    const auto nearest = std::ranges::min_element(
        points, {}, [](const Vec3& p) { return (p - Vec3(1, 0, kMiddle)).norm(); });
    *nearest += Vec3(1.6, 0, 0);
    const Surface spiked = narrow_tube(0.5).with_positions(points);
    CHECK(code_of([&] { (void)corrected(spiked); }) == "narrowing-not-a-tube");
}

SCENARIO("A stretch that is given is widened whatever its depth", "[geometry][narrowing]") {
    const Surface tube = narrow_tube(0.1);
    CHECK(code_of([&] { (void)narrowing_at(tube, {.at = Vec3(0, 0, kMiddle)}); }) ==
          "no-narrowing-there");
    const NamedNarrowing named =
        narrowing_at(tube, {.at = Vec3(0, 0, 20), .from = Vec3(0, 0, 25), .to = Vec3(0.5, 0, 15)});
    CHECK(named.narrowing.share() == Approx(0.1).margin(0.01));
    const auto result = correct_narrowing(tube, *named.graph, named.rings, named.narrowing);
    CHECK(largest_error(result.surface, 1.0) < 0.03);
    THEN("its ends as they are stored name the same stretch") {
        const NamedNarrowing again =
            narrowing_at(tube, {.at = Vec3(0, 0, 20), .from = named.from, .to = named.to});
        CHECK(again.narrowing.from == named.narrowing.from);
        CHECK(again.narrowing.to == named.narrowing.to);
    }
}

SCENARIO("Nothing is widened into another wall, or at an end", "[geometry][narrowing]") {
    const Surface tube = narrow_tube(0.5);
    const auto beside = [&](double gap) {
        // The neighbour follows the narrowing at a distance.
        return merged(tube, mapped(closed_tube(1.0, kLength, 24, 120), [=](const Vec3& p) {
                          return Vec3(p.x() + 3.0 + gap - bell(p.z()), p.y(), p.z());
                      }));
    };
    CHECK(code_of([&] { (void)corrected(beside(0.3)); }) == "narrowing-without-room");
    CHECK_NOTHROW(corrected(beside(2.0)));
    CHECK(code_of([&] { (void)narrowing_at(tube, {.at = Vec3(0, 0, 0.2)}); }) ==
          "narrowing-at-branch-end");
    CHECK(code_of([&] { (void)narrowing_at(tube, {.at = Vec3(9, 0, kMiddle)}); }) ==
          "narrowing-off-vessel");
    CHECK(code_of([&] {
              (void)narrowing_at(
                  tube, {.at = Vec3(0, 0, 20), .from = Vec3(0, 0, 20), .to = Vec3(0, 0, 20)});
          }) == "narrowing-without-vessel");
}
