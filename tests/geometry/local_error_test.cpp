#include "geometry/kernel/local_error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <catch2/catch.hpp>
#include <tbb/global_control.h>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/measure.h"
#include "geometry/kernel/surface_distance.h"
#include "tests/support/iso_surface.h"
#include "tests/support/shapes.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

const auto kBothForms = {LocalErrorForm::ClosestPoint, LocalErrorForm::Thesis};

LocalError error_of(const Surface& original, const Positions& moved,
                    LocalErrorForm form = LocalErrorForm::ClosestPoint) {
    return local_error(*original.topology, original.points(), moved, form);
}

/// Squares of 1 mm cut along a diagonal, in the plane z = height; side x side vertices.
void add_sheet(int side, double height, Positions& points, std::vector<Triangle>& triangles) {
    const auto first = static_cast<VertexId>(points.size());
    for (int j = 0; j < side; ++j)
        for (int i = 0; i < side; ++i) points.emplace_back(i, j, height);
    const auto at = [&](int i, int j) { return first + static_cast<VertexId>(j * side + i); };
    for (int j = 0; j + 1 < side; ++j)
        for (int i = 0; i + 1 < side; ++i) {
            triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
            triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
        }
}

Surface sheets(int side, const std::vector<double>& heights) {
    Positions points;
    std::vector<Triangle> triangles;
    for (const double height : heights) add_sheet(side, height, points, triangles);
    return make_surface(std::move(points), std::move(triangles));
}

}  // namespace

SCENARIO("A surface that did not move has no local error", "[geometry][local_error]") {
    const Surface tube = open_tube(3.0, 10.0, 24, 20);
    for (const LocalErrorForm form : kBothForms) {
        const LocalError error = error_of(tube, tube.points(), form);
        CHECK(error.values.size() == tube.vertex_count());
        CHECK(error.mean == 0.0);
        CHECK(error.largest == 0.0);
    }
}

SCENARIO("The local error of a sphere that was scaled is the change of its radius",
         "[geometry][local_error]") {
    const Surface sphere = icosphere(10.0, 4);
    const double radius = GENERATE(10.3, 9.7);
    const LocalErrorForm form = GENERATE(LocalErrorForm::ClosestPoint, LocalErrorForm::Thesis);
    const LocalError error = error_of(sphere, icosphere(radius, 4).points(), form);
    CHECK(error.mean == Approx(0.3).epsilon(0.01));
    CHECK(error.largest == Approx(0.3).epsilon(0.01));
    CHECK(*std::min_element(error.values.begin(), error.values.end()) == Approx(0.3).epsilon(0.01));
}

SCENARIO("Sliding along a surface is no error", "[geometry][local_error]") {
    GIVEN("a plane whose inner vertices slide by several edges") {
        const Surface plane = sheets(20, {0.0});
        Positions moved = plane.points();
        for (Vec3& p : moved)
            if ((p - Vec3(10, 10, 0)).cwiseAbs().maxCoeff() < 6.0) p += Vec3(2.3, -1.6, 0.0);
        for (const LocalErrorForm form : kBothForms)
            CHECK(error_of(plane, moved, form).largest < 1e-12);
        THEN("and a lift of the sliding vertices is found again") {
            for (std::size_t v = 0; v < moved.size(); ++v)
                if (moved[v] != plane.points()[v]) moved[v].z() = -0.4;
            CHECK(error_of(plane, moved).largest == Approx(0.4));
        }
    }
    GIVEN("a tube that turns around its axis by a third of a turn") {
        const Surface tube = open_tube(3.0, 10.0, 60, 32);
        const Eigen::AngleAxisd third(2.0 * std::numbers::pi / 3.0 + 0.05, Vec3::UnitZ());
        const Surface turned = mapped(tube, [&](const Vec3& p) { return Vec3(third * p); });
        const double sagitta = 3.0 * (1.0 - std::cos(std::numbers::pi / 60.0));
        std::vector<VertexId> references = own_references(*tube.topology);
        for (int step = 1; step <= 20; ++step) {
            const Eigen::AngleAxisd part(third.angle() * step / 20.0, Vec3::UnitZ());
            const Surface now = mapped(tube, [&](const Vec3& p) { return Vec3(part * p); });
            follow_drift(*tube.topology, tube.points(), now.points(), references);
        }
        const LocalError error =
            local_error(*tube.topology, tube.points(), turned.points(), references);
        CHECK(error.largest < 1.01 * sagitta);
        CHECK(error.mean > 0.0);
    }
}

SCENARIO("The local error is the distance from the original where little moved",
         "[geometry][local_error]") {
    const Surface sphere = icosphere(10.0, 4);
    const SurfaceDistance distance(sphere);
    GIVEN("a tenth of an edge of noise") {
        const Positions moved = with_noise(sphere, 0.1).points();
        const LocalError error = error_of(sphere, moved);
        double most = 0.0, mean = 0.0;
        for (std::size_t v = 0; v < moved.size(); ++v) {
            const double exact = distance.closest_point(moved[v]).distance;
            most = std::max(most, std::abs(error.values[v] - exact));
            mean += exact / static_cast<double>(moved.size());
        }
        CHECK(most < 1e-12);
        CHECK(error.mean == Approx(mean));
    }
    GIVEN("a raw surface with slivers, every vertex at the mean of its neighbours") {
        const Surface raw = iso_surface(
            [](const Vec3& p) { return capsule(p, Vec3(-4, -1, 0), Vec3(4, 2, 1), 3.0); },
            {Vec3(-8, -8, -8), Vec3(8, 8, 8)}, 0.4);
        Positions moved(raw.vertex_count(), Vec3::Zero());
        for (std::size_t v = 0; v < moved.size(); ++v) {
            const auto ring = raw.topology->rings().row(v);
            for (const VertexId u : ring)
                moved[v] += raw.points()[u] / static_cast<double>(ring.size());
        }
        const LocalError error = error_of(raw, moved);
        const SurfaceDistance from_raw(raw);
        double most = 0.0;
        for (std::size_t v = 0; v < moved.size(); ++v)
            most = std::max(most,
                            std::abs(error.values[v] - from_raw.closest_point(moved[v]).distance));
        CHECK(error.largest > 0.01);
        CHECK(most < 1e-12);
    }
    GIVEN("two edges of noise") {
        const Positions moved = with_noise(sphere, 2.0).points();
        const LocalError error = error_of(sphere, moved);
        std::size_t below = 0;
        for (std::size_t v = 0; v < moved.size(); ++v)
            below += error.values[v] < distance.closest_point(moved[v]).distance - 1e-12 ? 1 : 0;
        THEN("it is never below that distance") {
            CHECK(below == 0);
        }
    }
}

SCENARIO("A vertex is not compared with a branch that only passes nearby",
         "[geometry][local_error]") {
    const Surface two = sheets(9, {0.0, 2.0});
    Positions moved = two.points();
    const std::size_t middle = 4 * 9 + 4;
    moved[middle].z() = 1.9;
    CHECK(SurfaceDistance(two).closest_point(moved[middle]).distance == Approx(0.1));
    CHECK(error_of(two, moved).values[middle] == Approx(1.9));
}

SCENARIO("The printed form uses the farthest plane around an edge", "[geometry][local_error]") {
    const Surface box = cube(2.0);
    const auto corner = static_cast<std::size_t>(
        std::find(box.points().begin(), box.points().end(), Vec3(2.0, 2.0, 2.0)) -
        box.points().begin());
    REQUIRE(corner < box.vertex_count());
    Positions moved = box.points();
    SECTION("a corner that slides along a face is still on the surface") {
        moved[corner] -= Vec3(0.3, 0.2, 0.0);
        CHECK(error_of(box, moved).values[corner] < 1e-12);
        CHECK(error_of(box, moved, LocalErrorForm::Thesis).values[corner] == Approx(0.3));
    }
    SECTION("a corner that leaves outwards is farther from the corner than from any plane") {
        moved[corner] += Vec3(0.1, 0.1, 0.1);
        CHECK(error_of(box, moved).values[corner] == Approx(0.1 * std::sqrt(3.0)));
        CHECK(error_of(box, moved, LocalErrorForm::Thesis).values[corner] == Approx(0.1));
    }
}

SCENARIO("Local errors do not depend on threads or on the place in space",
         "[geometry][local_error]") {
    const Surface sphere = icosphere(10.0, 4);
    const Surface moved = with_noise(sphere, 0.5);
    const LocalError many = error_of(sphere, moved.points());
    {
        const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
        const LocalError single = error_of(sphere, moved.points());
        CHECK(single.values == many.values);
        CHECK(single.mean == many.mean);
    }
    const auto away = [](const Vec3& p) { return Vec3(skew_rotation() * p + Vec3(50, -20, 8)); };
    const LocalError elsewhere = error_of(mapped(sphere, away), mapped(moved, away).points());
    CHECK(elsewhere.mean == Approx(many.mean));
    CHECK(elsewhere.largest == Approx(many.largest));
}

SCENARIO("Broken surfaces have local errors too", "[geometry][local_error]") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    GIVEN("nothing") {
        const Topology none({}, 0);
        CHECK(local_error(none, {}, {}).mean == 0.0);
    }
    GIVEN("a vertex without triangles and a triangle without area, both moved by 1 mm") {
        const Topology topology({{0, 1, 2}}, 4);
        const Positions original = {{0, 0, 0}, {1, 0, 0}, {3, 0, 0}, {9, 9, 9}};
        Positions moved = original;
        for (Vec3& p : moved) p.z() += 1.0;
        for (const LocalErrorForm form : kBothForms) {
            const LocalError error = local_error(topology, original, moved, form);
            for (const double value : error.values) CHECK(value == Approx(1.0));
        }
    }
    GIVEN("positions that are not numbers, before or after") {
        const Surface sphere = icosphere(10.0, 2);
        Positions original = sphere.points(), moved = icosphere(10.5, 2).points();
        original[3].x() = nan;
        moved[5].y() = nan;
        moved[7].z() = std::numeric_limits<double>::infinity();
        for (const LocalErrorForm form : kBothForms) {
            const LocalError error = local_error(*sphere.topology, original, moved, form);
            CHECK(std::isfinite(error.mean));
            CHECK(error.values[5] == 0.0);
            CHECK(error.values[7] == 0.0);
            CHECK(error.values[100] == Approx(0.5).epsilon(0.05));
        }
    }
    GIVEN("arrays that do not fit the surface") {
        const Surface sphere = icosphere(1.0, 1);
        Positions few = sphere.points();
        few.pop_back();
        CHECK_THROWS_AS(error_of(sphere, few), InvalidInput);
        CHECK_THROWS_AS(local_error(*sphere.topology, few, sphere.points()), InvalidInput);
        std::vector<VertexId> references = own_references(*sphere.topology);
        references.back() = 4000;
        CHECK_THROWS_AS(
            follow_drift(*sphere.topology, sphere.points(), sphere.points(), references),
            InvalidInput);
        CHECK_THROWS_AS(local_error(*sphere.topology, sphere.points(), sphere.points(), references),
                        InvalidInput);
    }
}
