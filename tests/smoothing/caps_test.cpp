#include "smoothing/context/caps.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <catch2/catch.hpp>
#include <tbb/global_control.h>

#include "geometry/image/iso_surface.h"
#include "geometry/kernel/errors.h"
#include "geometry/phantoms/phantom.h"
#include "smoothing/context/staircases.h"
#include "smoothing/filters/laplace.h"
#include "tests/support/iso_surface.h"
#include "tests/support/shapes.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

/// The same triangles without their patches.
Surface without_patches(const Surface& surface) {
    return make_surface(surface.points(), {surface.triangles().begin(), surface.triangles().end()});
}

/// The frozen phantom cases/phantoms/cylinder-with-cuboid.json.
PhantomDescription cylinder_with_cuboid() {
    PhantomDescription description;
    description.parts = {
        {"cylinder", VesselShape{{Vec3(0, 0, -30), Vec3(0, 0, 30)}, {14, 14}, true}, 0.0},
        {"cuboid", BoxShape{Vec3(0, 0, 0), Vec3(17, 17, 7.5)}, 0.0}};
    description.surface_edge = 0.8;
    description.imaging.spacing = Vec3(1, 1, 3);
    description.imaging.margin = 6;
    description.imaging.blur.setConstant(0.6);
    return description;
}

/// Surface of the mask of one solid.
Surface mask_surface(const PhantomPart& part, const Vec3& spacing) {
    PhantomDescription description;
    description.parts = {part};
    description.surface_edge = 1.0;
    description.imaging.spacing = spacing;
    return iso_surface(make_phantom(description).mask, 0.5);
}

bool same(const std::vector<Cap>& a, const std::vector<Cap>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Cap& c, const Cap& d) {
        return c.triangles == d.triangles && c.vertices == d.vertices && c.rim == d.rim &&
               c.normal == d.normal && c.from_patch == d.from_patch;
    });
}

/// A tube of radius 5 along z from -10 to 10 with a square plate of half width 8 around its middle,
/// as extracted from an image of cubic voxels.
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
        CHECK(cap.rim.size() == 48);
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

SCENARIO("The facets of a voxel mask are no caps", "[smoothing][caps]") {
    const PhantomPart ring{"ring", TorusShape{Vec3(1, 2, 3), Vec3(0.3, 0.2, 1), 15, 4}, 0.0};
    CHECK(find_caps(mask_surface(ring, Vec3::Constant(0.5))).empty());
    const PhantomPart vessel{
        "vessel", VesselShape{{Vec3(0, 0, -25), Vec3(3, 1, 0), Vec3(0, 0, 25)}, {3, 3.5, 3}}, 0.0};
    CHECK(find_caps(mask_surface(vessel, Vec3::Constant(0.4))).empty());
    const PhantomPart ball{"ball", SphereShape{Vec3(1, 2, 3), 8}, 0.0};
    CHECK(find_caps(mask_surface(ball, Vec3::Constant(0.5))).empty());
    GIVEN("a straight tube, whose mask is a prism") {
        const PhantomPart tube{"tube", VesselShape{{Vec3(0, 0, -20), Vec3(0, 0, 20)}, {4, 4}, true},
                               0.0};
        const Surface surface = mask_surface(tube, Vec3::Constant(0.5));
        const auto caps = find_caps(surface);
        REQUIRE(caps.size() == 2);
        CHECK(std::abs(caps[0].normal.z()) == Approx(1.0));
        CHECK(std::abs(caps[1].normal.z()) == Approx(1.0));
    }
    GIVEN("thick slices, the topmost of which looks like an end") {
        const Surface surface = mask_surface(ball, Vec3(0.5, 0.5, 1.5));
        for (const Cap& cap : find_caps(surface)) CHECK(std::abs(cap.normal.z()) == Approx(1.0));
    }
}

SCENARIO("Caps are distinguished from staircases after up to 50 Laplace iterations",
         "[smoothing][caps]") {  // Fig. 5.13
    const Phantom phantom = make_phantom(cylinder_with_cuboid());
    for (const Surface& raw : {iso_surface(phantom.mask, 0.5), iso_surface(phantom.image, 500.0)})
        for (const int iterations : {0, 10, 20, 30, 40, 50}) {
            CAPTURE(iterations);
            const Surface surface = raw.with_positions(
                laplace(*raw.topology, raw.points(), {}, {.iterations = iterations}));
            const auto caps = find_caps(surface);
            std::array<int, 2> ends = {0, 0};
            for (const Cap& cap : caps) {
                if (std::abs(cap.normal.z()) < 0.9) continue;  // a side of the cuboid
                for (const VertexId v : cap.vertices)
                    REQUIRE(std::abs(surface.points()[v].z()) > 28.0);  // not a shoulder, at 7.5
                ++ends[cap.normal.z() > 0.0 ? 0 : 1];
                CHECK(cap.vertices.size() > 150);
            }
            CHECK(ends == std::array<int, 2>{1, 1});
            const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
            CHECK(same(find_caps(surface), caps));
        }
}

SCENARIO("Treads of a staircase are not caps, even on a smoothed surface", "[smoothing][caps]") {
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
    for (const Cap& cap : caps) {
        CHECK(cap.rim.size() == 12);
        CHECK(cap.vertices.size() == 13);
    }
}

SCENARIO("Areas without a bending border are not caps", "[smoothing][caps]") {
    std::vector<Triangle> triangles;
    Positions points;
    for (VertexId i = 0; i < 100; ++i) points.emplace_back(i % 10, i / 10, 0.0);
    for (VertexId i = 0; i < 90; ++i)
        if (i % 10 != 9) {
            triangles.push_back({i, i + 1, i + 11});
            triangles.push_back({i, i + 11, i + 10});
        }
    CHECK(find_caps(make_surface(points, triangles)).empty());
    for (Vec3& p : points) p.z() = p.x() < 4.5 ? 0.0 : p.x() - 4.5;  // bent at one side
    points[0].z() = std::nan("");
    const auto caps = find_caps(make_surface(points, triangles));
    for (const Cap& cap : caps) CHECK(cap.normal.allFinite());
}

SCENARIO("A small cap-like staircase is not a cap", "[smoothing][caps]") {
    // Fig. 5.8, label II: a terrace of a few faces that falls off on all sides
    const auto shape = [](const Vec3& p) {
        const double body = (p.cwiseAbs() - Vec3(8, 8, 4)).maxCoeff();
        const double terrace = ((p - Vec3(0, 0, 5)).cwiseAbs() - Vec3(1.4, 1.4, 1.6)).maxCoeff();
        return std::min(body, terrace);
    };
    const Surface surface = iso_surface(shape, {Vec3(-10, -10, -6), Vec3(10, 10, 8)}, 0.5);
    for (const Cap& cap : find_caps(surface))
        for (const VertexId v : cap.vertices) CHECK(surface.points()[v].z() < 6.3);
    const CapParameters small{.smallest_faces = 1};
    const auto with_small = find_caps(surface, small);
    CHECK(std::any_of(with_small.begin(), with_small.end(), [&](const Cap& cap) {
        return surface.points()[cap.vertices.front()].z() > 6.3;
    }));
}

SCENARIO("Cap detection accepts any surface", "[smoothing][caps]") {
    const Surface odd =
        make_surface({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, -1, 0}, {9, 9, 9}},
                     {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}, {2, 2, 3}, {1, 1, 1}});
    CHECK(find_caps(odd, {.smallest_faces = 1}).size() < 5);
    CHECK_THROWS_WITH(find_caps(odd, {.smallest_faces = 0}), Catch::Contains("smallest_faces"));
    CHECK_THROWS_WITH(find_caps(odd, {.flat_angle_deg = -1.0}), Catch::Contains("flat_angle_deg"));
}

SCENARIO("Caps and orientation changes from shared normals are the same bits",
         "[smoothing][caps]") {
    const Surface raw = tube_with_plate();
    for (const int iterations : {0, 5}) {
        CAPTURE(iterations);
        Surface surface = raw.with_positions(
            laplace(*raw.topology, raw.points(), {}, {.iterations = iterations}));
        Positions folded = surface.points();
        folded[7] = folded[8] = folded[9];  // degenerate triangles
        for (const Surface& s : {surface, surface.with_positions(folded)}) {
            const AreaNormals faces(s, AreaNormals::When::Ahead);
            CHECK(same(find_caps(faces), find_caps(s)));
            const StackAxes axes(Eigen::Matrix3d::Identity());
            CHECK(orientation_change(faces, axes) ==
                  orientation_change(*s.topology, s.points(), axes));
        }
    }
}
