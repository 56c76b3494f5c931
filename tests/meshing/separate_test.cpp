#include "meshing/stamp/separate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>

#include <catch2/catch.hpp>

#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/measure.h"
#include "geometry/kernel/self_intersections.h"
#include "tests/support/shapes.h"
#include "tests/support/touching_vessels.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

using Box = Eigen::AlignedBox3d;

constexpr double kRadius = kTouchingRadius;

/// Two parallel vessels along x, 0.6 mm apart in z, that leave each other beyond |x| = 5 mm; a web
/// of the given half width joins them between.
Surface side_by_side(double web) {
    const auto vessel = [](const Vec3& p, double side) {
        const double z = side * (kRadius + 0.3);
        const Vec3 left(-5, 0, z), right(5, 0, z), out(6, 0, 6.0 * side);
        return std::min({capsule(p, left, right, kRadius),
                         capsule(p, right, right + 1.2 * out, kRadius),
                         capsule(p, left, left + 1.2 * Vec3(-6, 0, 6.0 * side), kRadius)});
    };
    return solid_of(
        [&](const Vec3& p) {
            return std::min(
                {vessel(p, 1.0), vessel(p, -1.0), capsule(p, {-4, 0, 0}, {4, 0, 0}, web)});
        },
        Box(Vec3(-15, -4, -13), Vec3(15, 4, 13)), 0.4);
}

struct ByPlace {
    bool operator()(const Vec3& a, const Vec3& b) const {
        return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
    }
};

Separated separated(const Surface& before, const SeparateParameters& parameters) {
    Separated after = separate(before, SurfaceDistance(before), parameters);
    const Connectivity parts = connectivity(*after.surface.topology);
    CHECK(parts.closed);
    CHECK(parts.manifold);
    CHECK(parts.oriented);
    CHECK(self_intersections(after.surface).empty());
    const std::set<Vec3, ByPlace> places(after.surface.points().begin(),
                                         after.surface.points().end());
    CHECK(std::ranges::none_of(before.points(), [&](const Vec3& p) {
        return (p - after.report.centre).norm() > after.report.influence && !places.contains(p);
    }));
    CHECK(after.report.gap >= parameters.gap);
    return after;
}

/// The code with which a separation is refused; empty: it is not.
std::string refusal(const Surface& surface, const SeparateParameters& parameters) {
    try {
        static_cast<void>(separate(surface, SurfaceDistance(surface), parameters));
    } catch (const DiagnosedFailure& failure) {
        CHECK(failure.diagnostics().front().place.has_value());
        return failure.diagnostics().front().code;
    }
    return "";
}

}  // namespace

SCENARIO("Vessels that cross and touch become two round vessels", "[meshing][separate]") {
    const Surface before = touching_vessels();
    const Separated after = separated(before, {.at = {kTouchingBridge, 0, 0}, .gap = 0.4});
    CHECK(after.report.components_before == 1);
    CHECK(after.report.components_after == 2);
    CHECK(after.report.genus_after == 0);
    CHECK(after.report.waist == Approx(kTouchingBridge / kRadius).epsilon(0.2));
    CHECK(after.report.radii[0] == Approx(kRadius).epsilon(0.02));
    CHECK(after.report.radii[1] == Approx(kRadius).epsilon(0.02));
    double largest = 0.0;
    for (const Vec3& p : after.surface.points())
        largest =
            std::max(largest, std::abs(std::min(capsule(p, {-8, 0, -2.5}, {8, 0, -2.5}, kRadius),
                                                capsule(p, {0, -8, 2.5}, {0, 8, 2.5}, kRadius))));
    CHECK(largest < 0.1);
    THEN("any place of the contact gives the same vessels") {
        const Separated other = separated(before, {.at = {0, -kTouchingBridge, 0.2}, .gap = 0.4});
        CHECK(other.report.components_after == 2);
        CHECK(volume(other.surface) == Approx(volume(after.surface)).epsilon(1e-3));
    }
    THEN("the vessels that were found, when named, give the same surface") {
        const Separated again = separated(
            before, {.at = {kTouchingBridge, 0, 0}, .gap = 0.4, .vessel = after.report.vessel});
        CHECK(again.surface.points() == after.surface.points());
        CHECK(vessel_through(before, SurfaceDistance(before),
                             {.at = {kTouchingBridge, 0, 0}, .gap = 0.4}) == after.report.vessel);
    }
}

SCENARIO("A gap wider than the vessels' distance takes both walls back", "[meshing][separate]") {
    const Surface before = touching_vessels();
    const Separated after = separated(before, {.at = {kTouchingBridge, 0, 0}, .gap = 1.6});
    CHECK(after.report.components_after == 2);
    double low = -10.0, high = 10.0;  // of the walls where they face each other
    for (const Vec3& p : after.surface.points())
        if (std::hypot(p.x(), p.y()) < 0.5) {
            if (p.z() < 0.0)
                low = std::max(low, p.z());
            else
                high = std::min(high, p.z());
        }
    CHECK(low == Approx(-0.85).margin(0.1));
    CHECK(high == Approx(0.85).margin(0.1));
}

SCENARIO("Vessels that are blended over several diameters are separated", "[meshing][separate]") {
    for (const double web : {0.8, 1.6}) {
        CAPTURE(web);
        const Surface before = side_by_side(web);
        for (const double x : {0.0, 3.0}) {
            const Separated after = separated(before, {.at = {x, web, 0}, .gap = 0.4});
            CHECK(after.report.components_after == 2);
            CHECK(after.report.genus_after == 0);
            CHECK(after.report.length > 7.0);
            CHECK(after.report.width == Approx(2.0 * web).epsilon(0.25));
            double largest = 0.0;
            for (const Vec3& p : after.surface.points())
                if (std::abs(p.x()) < 4.0)
                    largest = std::max(
                        largest,
                        std::abs(std::hypot(p.y(), std::abs(p.z()) - kRadius - 0.3) - kRadius));
            CHECK(largest < 0.3);
        }
    }
}

SCENARIO("Where no two vessels pass each other, nothing is separated", "[meshing][separate]") {
    const Surface tube = fine_tube(2.0, 30.0, 24);
    CHECK(refusal(tube, {.at = {2, 0, 15}}) == "contact-without-arms");
    CHECK(refusal(icosphere(2.0, 3), {.at = {2, 0, 0}}) == "contact-without-arms");
    GIVEN("the tip of a vessel that touches another one") {
        const Surface tip = solid_of(
            [](const Vec3& p) {
                return std::min({capsule(p, {-10, 0, -2.5}, {10, 0, -2.5}, kRadius),
                                 capsule(p, {0, 0, 2.2}, {0, 8, 2.5}, kRadius),
                                 capsule(p, {0, 0, -2}, {0, 0, 2}, kTouchingBridge)});
            },
            Box(Vec3(-13, -4, -6), Vec3(13, 11, 6)), 0.4);
        CHECK(refusal(tip, {.at = {kTouchingBridge, 0, 0}}) == "contact-without-arms");
    }
    GIVEN("four vessels that join") {
        const Surface cross = solid_of(
            [](const Vec3& p) {
                return std::min(capsule(p, {-10, 0, 0}, {10, 0, 0}, kRadius),
                                capsule(p, {0, -10, 0}, {0, 10, 0}, kRadius));
            },
            Box(Vec3(-13, -13, -3), Vec3(13, 13, 3)), 0.4);
        CHECK(refusal(cross, {.at = {0, 0, kRadius}}) == "contact-joins");
    }
}

SCENARIO("A separation that cannot be had is refused", "[meshing][separate]") {
    const Surface surface = touching_vessels();
    const Vec3 at(kTouchingBridge, 0, 0);
    CHECK(refusal(surface, {.at = at, .gap = 4.0}) == "separate-gap");
    CHECK_THROWS_AS(separate(surface, SurfaceDistance(surface), {.at = at, .gap = 0.0}),
                    InvalidInput);
    CHECK_THROWS_AS(separate(surface, SurfaceDistance(surface),
                             {.at = Vec3::Constant(std::numeric_limits<double>::infinity())}),
                    InvalidInput);
    using Places = std::array<Vec3, 2>;
    THEN("both places at one side name no vessel") {
        const Places same = {Vec3(8, 0, -2.5), Vec3(7, 0, -2.5)};
        CHECK(refusal(surface, {.at = at, .vessel = same}) == "contact-one-arm");
    }
    THEN("places of different vessels name none either") {
        const Places different = {Vec3(8, 0, -2.5), Vec3(0, 8, 2.5)};
        CHECK_FALSE(refusal(surface, {.at = at, .vessel = different}).empty());
    }
}
