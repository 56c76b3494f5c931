#include "smoothing/filters/new_crossings.h"

#include <catch2/catch.hpp>

#include "geometry/kernel/self_intersections.h"
#include "smoothing/filters/laplace.h"
#include "tests/support/shapes.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

Surface together(const std::vector<Surface>& parts) {
    Positions points;
    std::vector<Triangle> triangles;
    for (const Surface& part : parts) {
        const auto first = static_cast<VertexId>(points.size());
        points.insert(points.end(), part.points().begin(), part.points().end());
        for (const auto& [a, b, c] : part.triangles())
            triangles.push_back({a + first, b + first, c + first});
    }
    return make_surface(points, triangles);
}

}  // namespace

SCENARIO("Smoothing does not move walls through each other", "[smoothing][new-crossings]") {
    // The coarse outer sphere shrinks faster than the fine one inside it; a third one is far away.
    const Surface far = icosphere(5.0, 2, Vec3(30, 0, 0));
    const Surface surface = together({icosphere(5.6, 2), icosphere(4.9, 3), far});
    const Positions wanted =
        laplace(*surface.topology, surface.points(), {.lambda = 0.5}, {.iterations = 8});
    REQUIRE_FALSE(self_intersections(wanted, surface.triangles()).empty());
    Positions moved = wanted;
    const TakenBack taken = take_back_crossings(surface, moved);
    CHECK(self_intersections(moved, surface.triangles()).empty());
    CHECK(taken.crossings_left == 0);
    CHECK(taken.vertices > 0);
    CHECK(taken.place.norm() < 6.0);
    const std::size_t first_far = surface.vertex_count() - far.vertex_count();
    CHECK(std::equal(moved.begin() + static_cast<std::ptrdiff_t>(first_far), moved.end(),
                     wanted.begin() + static_cast<std::ptrdiff_t>(first_far)));
}

SCENARIO("Without new crossings the filter's result stays bit for bit",
         "[smoothing][new-crossings]") {
    const Surface apart = icosphere(5.0, 2);
    const Surface crossing = together({apart, icosphere(5.0, 2, Vec3(3, 0, 0))});
    for (const Surface& surface : {apart, crossing}) {
        const Positions wanted =
            laplace(*surface.topology, surface.points(), {.lambda = 0.5}, {.iterations = 5});
        Positions moved = wanted;
        CHECK(take_back_crossings(surface, moved).vertices == 0);
        CHECK(moved == wanted);
    }
}
