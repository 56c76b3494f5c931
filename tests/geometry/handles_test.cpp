#include "geometry/kernel/handles.h"

#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/measure.h"
#include "tests/support/iso_surface.h"
#include "tests/support/shapes.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

constexpr double kRing = 10.0, kTube = 3.0;

double torus(const Vec3& p) {
    return std::hypot(std::hypot(p.x(), p.y()) - kRing, p.z()) - kTube;
}

}  // namespace

SCENARIO("A torus is one handle, as wide as its tube", "[geometry][handles]") {
    const Surface surface = iso_surface(torus, {Vec3(-14, -14, -4), Vec3(14, 14, 4)}, 0.5);
    const auto handles = handles_of(surface);
    REQUIRE(handles.size() == 1);
    CHECK(handles[0].width == Approx(2.0 * kTube).epsilon(0.12));
    CHECK(handles[0].length > 0.95 * 2.0 * std::numbers::pi * (kRing - kTube));
    CHECK(handles[0].length < 2.0 * std::numbers::pi * kRing);
    CHECK(std::hypot(handles[0].centre.x(), handles[0].centre.y()) == Approx(kRing).epsilon(0.1));
    CHECK(handles_of(icosphere(5.0, 3)).empty());
}

SCENARIO("Handles of a surface that is not oriented are refused", "[geometry][handles]") {
    const Surface ball = icosphere(5.0, 1);
    std::vector<Triangle> triangles(ball.topology->triangles().begin(),
                                    ball.topology->triangles().end());
    std::swap(triangles.front()[0], triangles.front()[1]);
    const Surface turned = make_surface(ball.points(), triangles);
    CHECK_THROWS_AS(handles_of(turned), InvalidInput);
}

SCENARIO("A thread between two vessels is where a handle is named", "[geometry][handles]") {
    const ImplicitShape vessels = [](const Vec3& p) {
        return std::min({capsule(p, Vec3(0, 0, 0), Vec3(0, 0, 30), 2.0),
                         capsule(p, Vec3(8, 0, 0), Vec3(8, 0, 30), 2.0),
                         capsule(p, Vec3(0, 0, 0), Vec3(8, 0, 0), 1.5),
                         capsule(p, Vec3(0, 0, 22), Vec3(8, 0, 22), 0.6)});
    };
    const Surface surface = iso_surface(vessels, {Vec3(-3, -3, -3), Vec3(11, 3, 33)}, 0.35);
    REQUIRE(connectivity(*surface.topology).genus == std::optional(1));
    const auto handles = handles_of(surface);
    REQUIRE(handles.size() == 1);
    CHECK((handles[0].centre - Vec3(4, 0, 22)).norm() < 2.5);
    CHECK(handles[0].width == Approx(1.2).epsilon(0.2));
    CHECK(handles[0].length > 40.0);
}

SCENARIO("Every handle is named once", "[geometry][handles]") {
    const ImplicitShape ladder = [](const Vec3& p) {
        double distance = std::min(capsule(p, Vec3(0, 0, 0), Vec3(0, 0, 30), 1.5),
                                   capsule(p, Vec3(8, 0, 0), Vec3(8, 0, 30), 1.5));
        const std::array<double, 4> rungs = {1.2, 0.7, 1.0, 0.8};
        for (std::size_t i = 0; i < rungs.size(); ++i) {
            const double z = 3.0 + 8.0 * static_cast<double>(i);
            distance = std::min(distance, capsule(p, Vec3(0, 0, z), Vec3(8, 0, z), rungs[i]));
        }
        return distance;
    };
    const Surface surface = iso_surface(ladder, {Vec3(-3, -3, -3), Vec3(11, 3, 33)}, 0.4);
    REQUIRE(connectivity(*surface.topology).genus == std::optional(3));
    const auto handles = handles_of(surface);
    REQUIRE(handles.size() == 3);
    for (std::size_t i = 1; i < 3; ++i) CHECK(handles[i - 1].width <= handles[i].width);
    CHECK(handles[0].width == Approx(1.4).epsilon(0.2));
    CHECK(std::abs(handles[0].centre.z() - 11.0) < 1.0);
}

SCENARIO("The rims of an open vessel are no handles", "[geometry][handles]") {
    CHECK(handles_of(open_tube(2.0, 10.0, 16, 8)).empty());
}
