#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "geometry/kernel/errors.h"
#include "geometry/vessel/repair/repair.h"
#include "geometry/vessel/sac/neck_plane.h"
#include "geometry/vessel/sac/sac_measures.h"
#include "tests/support/iso_surface.h"
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

/// The sphere of the idealised bifurcation of ../shared/data, on a straight tube along x.
constexpr double kSac = 2.502, kTube = 1.75, kMiddle = 3.75;  // [mm]

Surface sphere_on_tube(double cell) {
    const auto shape = [](const Vec3& x) {
        return std::min(capsule(x, Vec3(-9, 0, 0), Vec3(9, 0, 0), kTube),
                        (x - Vec3(0, 0, kMiddle)).norm() - kSac);
    };
    return repair(iso_surface(shape, {Vec3(-11.3, -3.1, -2.3), Vec3(11.3, 3.1, 6.9)}, cell))
        .surface;
}

const Vec3 kDome(0, 0, kMiddle + kSac);

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
    const ProposedNeck neck = propose_neck(sphere_on_tube(0.1), kDome);
    const SacMeasures m = measure_sac(neck.sac, neck.parent_diameter);
    const double up = kMiddle - kTube, radius = std::sqrt(kSac * kSac - up * up);
    const double height = kSac + up;
    CHECK(neck.sac.neck.normal.z() > std::cos(3.0 * kPi / 180.0));
    CHECK(m.neck_diameter == Approx(2.0 * radius).epsilon(0.04));
    CHECK(m.height == Approx(height).epsilon(0.02));
    CHECK(m.width == Approx(2.0 * kSac).epsilon(0.01));
    CHECK(m.volume == Approx(kPi * height * height * (3.0 * kSac - height) / 3.0).epsilon(0.02));
    CHECK(m.dome_area == Approx(2.0 * kPi * kSac * height).epsilon(0.02));
    CHECK(m.aspect_ratio == Approx(0.5 * height / radius).epsilon(0.05));
    CHECK(m.bottleneck_factor == Approx(kSac / radius).epsilon(0.05));
    CHECK(m.parent_diameter == Approx(2.0 * kTube).epsilon(0.03));
    CHECK(m.size_ratio == Approx(0.5 * height / kTube).epsilon(0.04));
}

SCENARIO("A sac's neck is not found where there is no sac", "[geometry][sac]") {
    CHECK_THROWS_AS(propose_neck(closed_tube(1.75, 18.0, 24, 60), Vec3(0, 0, 18)),
                    AlgorithmFailure);
}
