#include <algorithm>
#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "geometry/formats/surface_file.h"
#include "geometry/kernel/errors.h"
#include "geometry/vessel/repair/repair.h"
#include "geometry/vessel/sac/likely_sacs.h"
#include "geometry/vessel/sac/neck_plane.h"
#include "geometry/vessel/sac/sac_measures.h"
#include "geometry/vessel/sac/sac_regions.h"
#include "tests/support/sac_on_tube.h"
#include "tests/support/shapes.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

constexpr double kPi = std::numbers::pi;

VertexId highest(const Surface& surface, const Vec3& up) {
    VertexId best = 0;
    for (VertexId v = 1; v < surface.vertex_count(); ++v)
        if (up.dot(surface.points()[v]) > up.dot(surface.points()[best])) best = v;
    return best;
}

/// Of what lies above the plane.
SacMeasures measured_above(const Surface& surface, const Plane& plane, double parent) {
    const auto sac = sac_above(surface, plane, highest(surface, plane.normal),
                               std::vector<std::uint8_t>(surface.vertex_count(), 0));
    REQUIRE(sac);
    return measure_sac(*sac, parent);
}

}  // namespace

SCENARIO("A sac's figures are those of its form", "[geometry][sac]") {
    const Surface ball = icosphere(3.0, 5);
    GIVEN("a hemisphere") {
        const SacMeasures m = measured_above(ball, {Vec3(0, 0, 0), Vec3::UnitZ()}, 4.0);
        THEN("every figure has its closed form") {
            CHECK(m.dome_area == Approx(18.0 * kPi).epsilon(0.005));
            CHECK(m.neck_area == Approx(9.0 * kPi).epsilon(0.005));
            CHECK(m.volume == Approx(18.0 * kPi).epsilon(0.005));
            CHECK(m.neck_diameter == Approx(6.0).epsilon(0.005));
            CHECK(m.neck_width == Approx(6.0).epsilon(0.005));
            CHECK(m.neck_hydraulic == Approx(6.0).epsilon(0.005));
            CHECK(m.height == Approx(3.0).epsilon(0.005));
            CHECK(m.length == Approx(3.0).epsilon(0.005));
            CHECK(m.diameter == Approx(6.0).epsilon(0.005));
            CHECK(m.aspect_ratio == Approx(0.5).epsilon(0.005));
            CHECK(m.size_ratio == Approx(0.75).epsilon(0.005));
            CHECK(m.bottleneck_factor == Approx(1.0).epsilon(0.005));
            CHECK(m.undulation == Approx(0.0).margin(0.003));
            CHECK(m.ellipticity == Approx(0.0).margin(0.003));
            CHECK(m.nonsphericity == Approx(0.0).margin(0.003));
        }
    }
    GIVEN("half of an ellipsoid, twice as high as a hemisphere") {
        const Surface egg =
            mapped(ball, [](const Vec3& x) { return Vec3(x.x(), x.y(), 2.0 * x.z()); });
        const SacMeasures m = measured_above(egg, {Vec3(0, 0, 0), Vec3::UnitZ()}, 4.0);
        const double e = std::sqrt(0.75), area = 9.0 * kPi * (1.0 + 2.0 / e * std::asin(e));
        THEN("it is convex, and no hemisphere") {
            CHECK(m.dome_area == Approx(area).epsilon(0.005));
            CHECK(m.volume == Approx(36.0 * kPi).epsilon(0.005));
            CHECK(m.aspect_ratio == Approx(1.0).epsilon(0.005));
            const double off = 1.0 - std::cbrt(18.0 * kPi) * std::pow(36.0 * kPi, 2.0 / 3.0) / area;
            CHECK(m.ellipticity == Approx(off).margin(0.003));
            CHECK(m.nonsphericity == Approx(off).margin(0.003));
        }
    }
    GIVEN("a sphere with a narrow neck") {
        const SacMeasures m = measured_above(ball, {Vec3(0, 0, -2.4), Vec3::UnitZ()}, 4.0);
        THEN("its widest section is wider than its neck") {
            CHECK(m.neck_diameter == Approx(3.6).epsilon(0.005));
            CHECK(m.width == Approx(6.0).epsilon(0.005));
            CHECK(m.bottleneck_factor == Approx(6.0 / 3.6).epsilon(0.005));
            CHECK(m.bulge_location == Approx(2.4 / 5.4).margin(0.02));
            CHECK(m.height == Approx(5.4).epsilon(0.005));
        }
    }
    GIVEN("the same, rotated") {
        const Eigen::Matrix3d turn = skew_rotation();
        const Surface turned = mapped(ball, [&](const Vec3& x) { return Vec3(turn * x); });
        const SacMeasures a = measured_above(ball, {Vec3(0, 0, -2.4), Vec3::UnitZ()}, 4.0);
        const SacMeasures b =
            measured_above(turned, {turn * Vec3(0, 0, -2.4), turn * Vec3::UnitZ()}, 4.0);
        THEN("the figures stay") {
            CHECK(b.volume == Approx(a.volume).epsilon(1e-9));
            CHECK(b.dome_area == Approx(a.dome_area).epsilon(1e-9));
            CHECK(b.neck_diameter == Approx(a.neck_diameter).epsilon(1e-9));
            CHECK(b.nonsphericity == Approx(a.nonsphericity).margin(1e-9));
            CHECK(b.ellipticity == Approx(a.ellipticity).margin(1e-6));
        }
    }
}

SCENARIO("A neck that is no closed ring around a sac is in doubt", "[geometry][sac]") {
    const Surface ball = icosphere(3.0, 4);
    const Plane middle{Vec3(0, 0, 0), Vec3::UnitZ()};
    CHECK_FALSE(neck_in_doubt(measured_above(ball, middle, 4.0)));
    const Surface cut_lengthwise =
        mapped(ball, [](const Vec3& x) { return Vec3(3.0 * x.x(), x.y(), 3.0 * x.z()); });
    CHECK(neck_in_doubt(measured_above(cut_lengthwise, middle, 4.0)));
    const Surface flat =
        mapped(ball, [](const Vec3& x) { return Vec3(x.x(), x.y(), 0.5 * x.z()); });
    CHECK(neck_in_doubt(measured_above(flat, middle, 4.0)));
}

SCENARIO("A plane cuts off a sac, or nothing", "[geometry][sac]") {
    const Surface ball = icosphere(3.0, 3);
    std::vector<std::uint8_t> foreign(ball.vertex_count(), 0);
    const VertexId dome = highest(ball, Vec3::UnitZ());
    THEN("a plane above the dome cuts off nothing") {
        CHECK_FALSE(sac_above(ball, {Vec3(0, 0, 4), Vec3::UnitZ()}, dome, foreign));
    }
    THEN("a plane below everything has no section") {
        CHECK_FALSE(sac_above(ball, {Vec3(0, 0, -4), Vec3::UnitZ()}, dome, foreign));
    }
    THEN("an open end beside the dome is no sac's") {
        foreign[highest(ball, Vec3::UnitX())] = 1;
        CHECK_FALSE(sac_above(ball, {Vec3(0, 0, -1), Vec3::UnitZ()}, dome, foreign));
        CHECK(sac_above(ball, {Vec3(0, 0, 1), Vec3::UnitZ()}, dome, foreign));
    }
}

SCENARIO("The neck of a sphere on a tube is where the tube begins", "[geometry][sac]") {
    const SacAtNeck neck = propose_neck(sac_on_tube(0.1), sac_dome());
    const SacMeasures m = measure_sac(neck.sac, neck.parent_diameter);
    const SphereAbove sphere = sphere_above(kSacTube);
    CHECK(neck.sac.neck.normal.z() > std::cos(3.0 * kPi / 180.0));
    CHECK(m.neck_diameter == Approx(2.0 * sphere.neck_radius).epsilon(0.04));
    CHECK(m.height == Approx(sphere.height).epsilon(0.02));
    CHECK(m.width == Approx(2.0 * kSacRadius).epsilon(0.01));
    CHECK(m.volume == Approx(sphere.volume).epsilon(0.02));
    CHECK(m.dome_area == Approx(sphere.dome_area).epsilon(0.02));
    CHECK(m.aspect_ratio == Approx(0.5 * sphere.height / sphere.neck_radius).epsilon(0.05));
    CHECK(m.bottleneck_factor == Approx(kSacRadius / sphere.neck_radius).epsilon(0.05));
    CHECK(m.parent_diameter == Approx(2.0 * kSacTube).epsilon(0.03));
    CHECK(m.size_ratio == Approx(0.5 * sphere.height / kSacTube).epsilon(0.04));
}

SCENARIO("A sac beyond a known plane has the figures of its form", "[geometry][sac]") {
    const auto file = shared_data("surfaces/v4a_ideal_bifurcation_aneurysm.stl");
    if (file.empty()) return;
    // A sphere about (0, 0, 13.51) on a T of tubes: arms along x of radius 1.5 at z = 10, a stem of
    // radius 1.75. A fillet joins them below z = 11.9. All ends are open.
    constexpr double middle = 13.51, cut = 12.0, arms = 3.0;
    const Surface surface = repair(read_surface(file).surface).surface;
    const SacNeck known{Vec3(0, 0, middle + kSacRadius), {Vec3(0, 0, cut), Vec3::UnitZ()}};
    const SacAtNeck neck = sac_beyond(surface, known);
    const SacMeasures m = measure_sac(neck.sac, neck.parent_diameter);
    const SphereAbove sphere = sphere_above(kSacMiddle + cut - middle);
    const double a = sphere.neck_radius;
    CHECK(m.dome_area == Approx(sphere.dome_area).epsilon(0.01));
    CHECK(m.neck_area == Approx(kPi * a * a).epsilon(0.01));
    CHECK(m.volume == Approx(sphere.volume).epsilon(0.01));
    CHECK(m.neck_diameter == Approx(2.0 * a).epsilon(0.01));
    CHECK(m.neck_width == Approx(2.0 * a).epsilon(0.01));
    CHECK(m.neck_hydraulic == Approx(2.0 * a).epsilon(0.01));
    CHECK(m.height == Approx(sphere.height).epsilon(0.01));
    CHECK(m.length == Approx(sphere.height).epsilon(0.01));
    CHECK(m.width == Approx(2.0 * kSacRadius).epsilon(0.01));
    CHECK(m.diameter == Approx(2.0 * kSacRadius).epsilon(0.01));
    CHECK(m.parent_diameter == Approx(arms).epsilon(0.01));
    CHECK(m.aspect_ratio == Approx(0.5 * sphere.height / a).epsilon(0.01));
    CHECK(m.size_ratio == Approx(sphere.height / arms).epsilon(0.01));
    CHECK(m.bottleneck_factor == Approx(kSacRadius / a).epsilon(0.01));
    CHECK(m.bulge_location == Approx((middle - cut) / sphere.height).epsilon(0.03));
    CHECK(m.undulation == Approx(0.0).margin(0.01));
    const double off =
        1.0 - std::cbrt(18.0 * kPi) * std::pow(sphere.volume, 2.0 / 3.0) / sphere.dome_area;
    CHECK(m.ellipticity == Approx(off).epsilon(0.01));
    CHECK(m.nonsphericity == Approx(off).epsilon(0.01));
    THEN("the stem is the parent, and the arms are its daughters") {
        const SacRegions regions = sac_regions(surface, known);
        REQUIRE(regions.vessels.size() == 3);
        CHECK(std::ranges::count(regions.vessels, SacRegion::Parent, &NeckVessel::region) == 1);
        for (const NeckVessel& vessel : regions.vessels)
            CHECK(vessel.diameter == Approx(arms).epsilon(0.06));
        for (TriangleId t = 0; t < surface.triangle_count(); ++t) {
            const Vec3 x = surface.points()[surface.triangles()[t][0]];
            if (regions.triangles[t] == SacRegion::Sac) CHECK(x.z() > cut - 0.3);
            if (x.z() > cut + 0.3) CHECK(regions.triangles[t] == SacRegion::Sac);
            if (std::abs(x.x()) > a + arms + 0.3)
                CHECK(regions.triangles[t] == SacRegion::Elsewhere);
            if (x.z() < 8.0) CHECK(regions.triangles[t] != SacRegion::Daughters);
        }
    }
    THEN("an arm that leads to the inlet is the parent") {
        const SacRegions regions =
            sac_regions(surface, known, {.reach = 1.0, .inlet = Vec3(-7.5, 0, 10)});
        for (TriangleId t = 0; t < surface.triangle_count(); ++t)
            if (regions.triangles[t] == SacRegion::Parent)
                CHECK(surface.points()[surface.triangles()[t][0]].x() < 0.5 * arms);
    }
    THEN("a plane that leaves the dome below it, or takes a vessel with it, is refused") {
        for (const double z : {middle + kSacRadius + 0.1, 10.0, -3.0})
            CHECK_THROWS_AS(sac_beyond(surface, {known.dome, {Vec3(0, 0, z), Vec3::UnitZ()}}),
                            AlgorithmFailure);
    }
}

SCENARIO("The vessel on both sides of a sac is its parent", "[geometry][sac]") {
    const Surface surface = sac_on_tube(0.15);
    const SacNeck neck{sac_dome(), {Vec3(0, 0, kSacTube), Vec3::UnitZ()}};
    const double reach = GENERATE(0.5, 1.0);
    const SacRegions regions = sac_regions(surface, neck, {.reach = reach});
    REQUIRE(regions.vessels.size() == 2);
    const double edge = 0.3, neck_radius = sphere_above(kSacTube).neck_radius;
    for (TriangleId t = 0; t < surface.triangle_count(); ++t) {
        const Vec3 x = surface.points()[surface.triangles()[t][0]];
        const double along = std::abs(x.x()) - neck_radius;
        CHECK(regions.triangles[t] != SacRegion::Daughters);
        if (x.z() > kSacTube + edge) CHECK(regions.triangles[t] == SacRegion::Sac);
        if (along > reach * 2.0 * kSacTube + edge)
            CHECK(regions.triangles[t] == SacRegion::Elsewhere);
        if (std::abs(x.y()) < edge && x.z() > 0.0 && x.z() < kSacTube + 0.01 && along > edge &&
            along < reach * 2.0 * kSacTube - edge)
            CHECK(regions.triangles[t] == SacRegion::Parent);
    }
}

SCENARIO("A sac's neck is not found where there is no sac", "[geometry][sac]") {
    CHECK_THROWS_AS(propose_neck(closed_tube(1.75, 18.0, 24, 60), Vec3(0, 0, 18)),
                    AlgorithmFailure);
    const auto tips = tips_by_sac_odds(closed_tube(1.75, 18.0, 24, 60), std::nullopt);
    CHECK(std::ranges::none_of(tips, is_likely_sac));
}

SCENARIO("The sac of a tube is the likeliest of its blind ends", "[geometry][sac]") {
    const auto tips = tips_by_sac_odds(sac_on_tube(0.15), std::nullopt);
    REQUIRE(tips.size() == 3);
    CHECK(is_likely_sac(tips[0]));
    CHECK((tips[0].tip - sac_dome()).norm() < kSacRadius);
    CHECK_FALSE(is_likely_sac(tips[1]));
}
