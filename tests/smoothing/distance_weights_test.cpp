#include "smoothing/context/distance_weights.h"

#include <cmath>

#include <catch2/catch.hpp>

#include "geometry/kernel/errors.h"
#include "smoothing/filters/laplace.h"
#include "tests/support/shapes.h"

using namespace vesselbench;
using namespace vesselbench::test;

SCENARIO("Distances to neighbours are true distances to the nearest of them",
         "[smoothing][distance]") {
    const std::vector<Surface> neighbours = {cube(1.0), icosphere(1.0, 4, Vec3(10, 0, 0))};
    const Positions points = {{0.5, 0.5, 3.0}, {0.5, 0.5, 0.5}, {5.0, 0.5, 0.5}, {7.0, 0, 0}};
    const auto distances = neighbour_distances(points, neighbours);
    CHECK(distances[0] == Approx(2.0));  // to a face, whose vertices are farther
    CHECK(distances[1] == 0.0);          // inside
    CHECK(distances[2] == Approx(4.0));
    CHECK(distances[3] == Approx(2.0).epsilon(0.01));
    GIVEN("an open neighbour, which has no inside") {
        const std::vector<Surface> tube = {open_tube(2.0, 10.0, 64, 10)};
        CHECK(neighbour_distances({{0, 0, 5.0}}, tube)[0] == Approx(2.0).epsilon(0.01));
    }
    CHECK_THROWS_AS(neighbour_distances(points, {}), InvalidInput);
    const std::vector<Surface> empty = {make_surface({}, {})};
    CHECK_THROWS_AS(neighbour_distances(points, empty), InvalidInput);
}

SCENARIO("Distances become weights as in Fig. 5.3", "[smoothing][distance]") {
    const std::vector<double> distances = {1.0, 3.0, 5.0, 11.0};
    const auto close = [](const std::vector<double>& a, const std::vector<double>& b) {
        for (std::size_t i = 0; i < a.size(); ++i) CHECK(a[i] == Approx(b[i]).margin(1e-12));
    };
    close(distance_weights(distances), {0.0, 0.2, 0.4, 1.0});
    close(distance_weights(distances, {DistanceScaling::Margin, 5.0}), {0.0, 0.0, 0.0, 1.0});
    close(distance_weights(distances, {DistanceScaling::Margin, 2.0}),
          {0.0, 1.0 / 9.0, 3.0 / 9.0, 1.0});
    const double omega = 0.06;
    const auto printed = [&](double d) {
        return (std::exp(omega * d) - std::exp(omega * 1.0)) /
               (std::exp(omega * 11.0) - std::exp(omega * 1.0));
    };
    close(distance_weights(distances, {DistanceScaling::Exponential}),
          {0.0, printed(3.0), printed(5.0), 1.0});
    GIVEN("an exponent that would overflow") {
        const auto steep = distance_weights(distances, {DistanceScaling::Exponential, 0.0, 1000.0});
        close(steep, {0.0, 0.0, 0.0, 1.0});
    }
    GIVEN("distances that do not differ, or a margin beyond all of them") {
        close(distance_weights(std::vector<double>{2.0, 2.0}), {0.0, 0.0});
        close(distance_weights(distances, {DistanceScaling::Margin, 20.0}), {0, 0, 0, 0});
    }
    CHECK_THROWS_WITH(distance_weights(distances, {DistanceScaling::Margin, -1.0}),
                      Catch::Contains("margin"));
    CHECK_THROWS_WITH(distance_weights(distances, {DistanceScaling::Exponential, 0.0, 0.0}),
                      Catch::Contains("omega"));
    CHECK_THROWS_AS(distance_weights(std::vector<double>{std::nan("")}), InvalidInput);
}

SCENARIO("Vertices nearest to a neighbour do not move", "[smoothing][distance]") {
    const Surface sphere = icosphere(5.0, 4);
    const std::vector<Surface> neighbours = {icosphere(3.0, 3, Vec3(9.0, 0, 0))};
    const auto before = neighbour_distances(sphere.points(), neighbours);
    const auto nearest = [](const std::vector<double>& d) {
        return *std::min_element(d.begin(), d.end());
    };
    const auto gap = [&](const FilterSettings& settings) {
        const Positions moved =
            laplace(*sphere.topology, sphere.points(), {.lambda = 1.0}, settings);
        return nearest(neighbour_distances(moved, neighbours)) - nearest(before);
    };
    const auto weights = distance_weights(before);
    CHECK(gap({.iterations = 30}) > 0.2);
    CHECK(std::abs(gap({.iterations = 30, .weights = weights})) < 0.02);
}
