#include "smoothing/caps.h"

#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>

#include "geometry/errors.h"
#include "smoothing/cap_rounding.h"
#include "smoothing/laplace.h"
#include "tests/support/iso_surface.h"
#include "tests/support/shapes.h"
#include "tests/support/surface_facts.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

/// The same triangles without their patches.
Surface without_patches(const Surface& surface) {
    return make_surface(surface.points(), {surface.triangles().begin(), surface.triangles().end()});
}

/// A tube of radius 5 along z from -10 to 10 with a square plate of half width 8 around its middle,
/// as an image of cubic voxels gives it.
Surface tube_with_plate() {
    const auto shape = [](const Vec3& p) {
        const double tube = std::max(std::hypot(p.x(), p.y()) - 5.0, std::abs(p.z()) - 10.0);
        const double plate =
            std::max({std::abs(p.x()) - 8.0, std::abs(p.y()) - 8.0, std::abs(p.z()) - 2.0});
        return std::min(tube, plate);
    };
    return iso_surface(shape, {Vec3(-10, -10, -12), Vec3(10, 10, 12)}, 0.47);
}

}  // namespace

SCENARIO("The flat ends of a tube are its caps, whatever its direction", "[smoothing][caps]") {
    const Surface tube = mapped(without_patches(fine_tube(3.0, 12.0, 48)), [](const Vec3& p) {
        return Vec3(skew_rotation() * p + Vec3(4, -1, 7));
    });
    const auto caps = find_caps(tube);
    REQUIRE(caps.size() == 2);
    const Vec3 axis = skew_rotation() * Vec3(0, 0, 1);
    CHECK(std::abs(caps[0].normal.dot(axis)) == Approx(1.0));
    CHECK(caps[0].normal.dot(caps[1].normal) == Approx(-1.0));
    for (const Cap& cap : caps) {
        CHECK_FALSE(cap.from_patch);
        double area = 0.0;
        for (const TriangleId t : cap.triangles)
            area += 0.5 * area_normal(tube.points(), tube.triangles()[t]).norm();
        CHECK(area == Approx(9.0 * M_PI).epsilon(0.02));
        const double height = cap.normal.dot(tube.points()[cap.vertices.front()]);
        for (const VertexId v : cap.vertices)
            CHECK(cap.normal.dot(tube.points()[v]) == Approx(height).margin(1e-9));
    }
}

SCENARIO("Round things have no caps", "[smoothing][caps]") {
    CHECK(find_caps(icosphere(5.0, 5)).empty());
    CHECK(find_caps(open_tube(2.0, 20.0, 64, 60)).empty());
    const auto ball = [](const Vec3& p) { return p.norm() - 8.0; };
    CHECK(find_caps(iso_surface(ball, {Vec3(-10, -10, -10), Vec3(10, 10, 10)}, 0.31)).empty());
    const auto vessel = [](const Vec3& p) {
        return capsule(p, Vec3(0, 0, -10), Vec3(2, 1, 10), 3.0);
    };
    CHECK(find_caps(iso_surface(vessel, {Vec3(-5, -5, -14), Vec3(6, 6, 14)}, 0.29)).empty());
    CHECK(find_caps(make_surface({}, {})).empty());
}

SCENARIO("Treads of a staircase are no caps, also on a smoothed surface", "[smoothing][caps]") {
    const Surface raw = tube_with_plate();
    const int iterations = GENERATE(0, 5, 20, 50);
    CAPTURE(iterations);
    const Surface surface =
        raw.with_positions(laplace(*raw.topology, raw.points(), {}, {.iterations = iterations}));
    int ends = 0, sides = 0;
    for (const Cap& cap : find_caps(surface)) {
        const Vec3 place = surface.points()[cap.vertices.front()];
        const bool along = std::abs(cap.normal.z()) > 0.99;
        if (along && std::abs(place.z()) > 9.0) ++ends;
        if (!along) ++sides;  // the plate's four narrow sides are flat all around, too
        CHECK((!along || std::abs(place.z()) > 9.0));
    }
    CHECK(ends == 2);
    CHECK(sides <= 4);
}

SCENARIO("Patches other than the wall are caps by definition", "[smoothing][caps]") {
    const Surface tube = closed_tube(2.0, 10.0, 12, 8);
    const auto caps = find_caps(tube);
    REQUIRE(caps.size() == 2);
    for (const Cap& cap : caps) CHECK(cap.from_patch);
    const auto flags = cap_vertices(caps, tube.vertex_count());
    for (std::size_t v = 0; v < flags.size(); ++v) {
        const double z = tube.points()[v].z();
        CHECK((flags[v] != 0) == (z < 1e-9 || z > 10.0 - 1e-9));
    }
}

SCENARIO("A small cap-like staircase is not a cap", "[smoothing][caps]") {
    // Fig. 5.8, label II: a terrace of a few faces on a slope that ends on all sides
    const auto shape = [](const Vec3& p) {
        const double body = (p.cwiseAbs() - Vec3(8, 8, 4)).maxCoeff();
        const double terrace =
            ((p - Vec3(0, 0, 4.5)).cwiseAbs() - Vec3(1.15, 1.15, 0.6)).maxCoeff();
        return std::min(body, terrace);
    };
    const Surface surface = iso_surface(shape, {Vec3(-10, -10, -6), Vec3(10, 10, 7)}, 0.5);
    for (const Cap& cap : find_caps(surface))
        for (const VertexId v : cap.vertices) CHECK(surface.points()[v].z() < 4.9);
    const CapParameters small{.smallest_faces = 1};
    const auto with_small = find_caps(surface, small);
    CHECK(std::any_of(with_small.begin(), with_small.end(), [&](const Cap& cap) {
        return surface.points()[cap.vertices.front()].z() > 4.9;
    }));
}

SCENARIO("Cap detection takes any surface", "[smoothing][caps]") {
    const Surface odd =
        make_surface({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, -1, 0}, {9, 9, 9}},
                     {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}, {2, 2, 3}, {1, 1, 1}});
    CHECK(find_caps(odd, {.smallest_faces = 1}).size() < 5);
    CHECK_THROWS_WITH(find_caps(odd, {.smallest_faces = 0}), Catch::Contains("smallest_faces"));
    CHECK_THROWS_WITH(find_caps(odd, {.flat_angle_deg = -1.0}), Catch::Contains("flat_angle_deg"));
}

SCENARIO("Rounded caps are domes on the wall, which stays", "[smoothing][caps]") {
    const Surface tube = fine_tube(3.0, 12.0, 48);
    const auto caps = find_caps(tube);
    const Surface domed = tube.with_positions(rounded_caps(tube, caps));
    const auto flags = cap_vertices(caps, tube.vertex_count());
    double highest = 0.0;
    for (std::size_t v = 0; v < flags.size(); ++v) {
        const Vec3 &before = tube.points()[v], &after = domed.points()[v];
        if (flags[v] == 0) CHECK(after == before);
        const double z = after.z() < 6.0 ? -after.z() : after.z() - 12.0;
        if (flags[v] != 0)  // a half ball on each end
            CHECK(std::hypot(std::hypot(after.x(), after.y()), z) == Approx(3.0).epsilon(0.02));
        highest = std::max(highest, z);
    }
    CHECK(highest == Approx(3.0).epsilon(0.01));
    CHECK(enclosed_volume(domed) ==
          Approx(M_PI * 9.0 * 12.0 + 4.0 / 3.0 * M_PI * 27.0).epsilon(0.02));
    CHECK(rounded_caps(tube, {}) == tube.points());
}
