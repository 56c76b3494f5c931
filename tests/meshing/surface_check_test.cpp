#include "meshing/tetrahedra/surface_check.h"

#include <algorithm>

#include <catch2/catch.hpp>

#include "tests/support/shapes.h"

using namespace vesselbench;
using Kind = SurfaceProblem::Kind;

namespace {

bool finds(const Surface& surface, Kind kind) {
    const auto problems = surface_problems(surface);
    return std::any_of(problems.begin(), problems.end(),
                       [&](const SurfaceProblem& p) { return p.kind == kind; });
}

Surface joined(const Surface& a, const Surface& b) {
    Positions points = a.points();
    points.insert(points.end(), b.points().begin(), b.points().end());
    std::vector<Triangle> triangles(a.triangles().begin(), a.triangles().end());
    const auto shift = static_cast<VertexId>(a.vertex_count());
    for (const auto& [i, j, k] : b.triangles())
        triangles.push_back({i + shift, j + shift, k + shift});
    return make_surface(points, triangles);
}

}  // namespace

SCENARIO("each defect of a surface is found and placed", "[meshing][check]") {
    GIVEN("a sound tube") {
        THEN("there is nothing to report") {
            CHECK(surface_problems(test::fine_tube(1.0, 4.0, 12)).empty());
        }
    }
    GIVEN("a sphere without one triangle") {
        const Surface sphere = test::icosphere(2.0, 1);
        std::vector<Triangle> triangles(sphere.triangles().begin(), sphere.triangles().end());
        triangles.pop_back();
        const auto problems = surface_problems(make_surface(sphere.points(), triangles));
        THEN("three open edges are reported, with places on the sphere") {
            REQUIRE_FALSE(problems.empty());
            CHECK(problems[0].kind == Kind::Gap);
            CHECK(problems[0].count == 3);
            CHECK(problems[0].places.size() == 3);
            CHECK(problems[0].places[0].norm() > 1.0);
            CHECK(diagnostic_of(problems[0]).code == "surface-gap");
            CHECK(diagnostic_of(problems[0]).figures.at("count") == 3.0);
        }
    }
    GIVEN("two spheres that overlap") {
        const Surface both =
            joined(test::icosphere(1.0, 2), test::icosphere(1.0, 2, {1.2, 0.1, 0.05}));
        THEN("intersections and two parts are reported") {
            CHECK(finds(both, Kind::SelfIntersection));
            CHECK(finds(both, Kind::SeveralParts));
        }
    }
    GIVEN("a triangle turned over") {
        const Surface sphere = test::icosphere(1.0, 1);
        std::vector<Triangle> triangles(sphere.triangles().begin(), sphere.triangles().end());
        std::swap(triangles[3][0], triangles[3][1]);
        THEN("the orientation is reported") {
            CHECK(finds(make_surface(sphere.points(), triangles), Kind::Orientation));
        }
    }
    GIVEN("a vertex drawn almost onto the opposite edge") {
        Positions points = test::cube(1.0).points();
        points[0] = Vec3(0.4999, 0.4999, 0.0);  // corner of the bottom face, near its diagonal 1-2
        const Surface flat = test::cube(1.0).with_positions(points);
        THEN("a sliver is reported, and is no obstacle") {
            CHECK(finds(flat, Kind::Sliver));
            for (const auto& problem : surface_problems(flat))
                if (problem.kind == Kind::Sliver) CHECK_FALSE(is_obstacle(problem));
        }
    }
}
