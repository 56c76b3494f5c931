#include <cmath>
#include <functional>
#include <random>

#include <catch2/catch.hpp>
#include <tbb/global_control.h>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/mean_curvature.h"
#include "geometry/kernel/measure.h"
#include "smoothing/filters/anisotropic.h"
#include "smoothing/filters/cotangents.h"
#include "smoothing/filters/curvature_triggered.h"
#include "smoothing/filters/laplace.h"
#include "smoothing/filters/mean_curvature_flow.h"
#include "tests/support/iso_surface.h"
#include "tests/support/shapes.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

using Filter = std::function<Positions(const Surface&, const FilterSettings&)>;

struct NamedFilter {
    std::string name;
    Filter run;
};

std::vector<NamedFilter> curvature_filters() {
    return {{"mean-curvature-flow",
             [](const Surface& s, const FilterSettings& f) {
                 return mean_curvature_flow(*s.topology, s.points(), {}, f);
             }},
            {"anisotropic",
             [](const Surface& s, const FilterSettings& f) {
                 return anisotropic(*s.topology, s.points(), {}, f);
             }},
            {"curvature-triggered", [](const Surface& s, const FilterSettings& f) {
                 return curvature_triggered(*s.topology, s.points(), {}, f);
             }}};
}

/// A grid of acute triangles in z = 0, its inner vertices slid along it.
Surface irregular_plane(int cells) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> slide(-0.05, 0.05);
    Positions points;
    std::vector<Triangle> triangles;
    const auto id = [&](int i, int j) { return static_cast<VertexId>(j * (cells + 1) + i); };
    for (int j = 0; j <= cells; ++j)
        for (int i = 0; i <= cells; ++i) {
            const bool inner = i > 0 && j > 0 && i < cells && j < cells;
            points.emplace_back(i + 0.5 * (j % 2) + (inner ? slide(random) : 0.0),
                                0.866 * j + (inner ? slide(random) : 0.0), 0.0);
        }
    for (int j = 0; j < cells; ++j)
        for (int i = 0; i < cells; ++i) {
            const bool odd = j % 2 == 1;
            triangles.push_back({id(i, j), id(i + 1, j), id(odd ? i + 1 : i, j + 1)});
            triangles.push_back({id(odd ? i : i + 1, j), id(i + 1, j + 1), id(i, j + 1)});
        }
    return make_surface(std::move(points), std::move(triangles));
}

/// A box's raw iso-surface with noise: sharp edges of 90 degrees.
Surface noisy_box() {
    const auto box = [](const Vec3& p) { return (p.cwiseAbs() - Vec3(8, 8, 8)).maxCoeff(); };
    return with_noise(iso_surface(box, {Vec3(-10, -10, -10), Vec3(10, 10, 10)}, 0.503), 0.05);
}

double rms(const Surface& surface, const Positions& points,
           const std::function<bool(const Vec3&)>& chosen) {
    double sum = 0.0;
    int count = 0;
    for (std::size_t v = 0; v < points.size(); ++v) {
        if (!chosen(surface.points()[v])) continue;
        sum += std::pow(points[v].cwiseAbs().maxCoeff() - 8.0, 2);
        ++count;
    }
    return std::sqrt(sum / count);
}

bool near_edge(const Vec3& p) {
    return (p.cwiseAbs().array() > 7.4).count() >= 2;
}

}  // namespace

SCENARIO("Mean curvature flow leaves a plane where it is", "[smoothing][mean-curvature-flow]") {
    GIVEN("a flat surface of irregular triangles") {
        const Surface plane = irregular_plane(12);
        const auto drift = [&](const Positions& moved) {
            double largest = 0.0;
            for (std::size_t v = 0; v < moved.size(); ++v)
                largest = std::max(largest, (moved[v] - plane.points()[v]).norm());
            return largest;
        };
        THEN("cotangent weights of acute triangles do not slide its vertices; uniform ones do") {
            const auto curvatures = vertex_curvatures(*plane.topology, plane.points());
            for (const auto& curvature : curvatures) {
                CHECK(std::abs(curvature.mean) < 1e-10);
                CHECK(std::abs(curvature.gauss) < 1e-10);
            }
            const Positions flow = mean_curvature_flow(*plane.topology, plane.points());
            const Positions uniform = laplace(*plane.topology, plane.points());
            CHECK(drift(flow) < 1e-9);
            CHECK(drift(uniform) > 0.01);
        }
    }
}

SCENARIO("Mean curvature flow shrinks a sphere and keeps it a sphere",
         "[smoothing][mean-curvature-flow]") {
    const Surface sphere = icosphere(5.0, 4);
    const Positions moved = mean_curvature_flow(*sphere.topology, sphere.points());
    double smallest = 1e9, largest = 0.0;
    for (const Vec3& p : moved) {
        smallest = std::min(smallest, p.norm());
        largest = std::max(largest, p.norm());
    }
    CHECK(largest < 5.0);
    CHECK(largest - smallest < 0.05);
    GIVEN("both curvatures of the sphere") {
        for (const auto& curvature : vertex_curvatures(*sphere.topology, sphere.points())) {
            CHECK(curvature.mean == Approx(0.2).epsilon(0.01));
            CHECK(curvature.gauss == Approx(0.04).epsilon(0.03));
        }
    }
    GIVEN("the mean curvature that measure states") {
        const auto expected = mean_curvature(sphere).values;
        const auto own = vertex_curvatures(*sphere.topology, sphere.points());
        for (std::size_t v = 0; v < own.size(); ++v)
            CHECK(own[v].mean == Approx(expected[v]).epsilon(1e-9));
    }
}

SCENARIO("Anisotropic smoothing removes noise and keeps edges", "[smoothing][anisotropic]") {
    const Surface box = noisy_box();
    const auto face = [](const Vec3& p) { return !near_edge(p); };
    const Positions sharp =
        anisotropic(*box.topology, box.points(), {.lambda = 0.3}, {.iterations = 10});
    const Positions round =
        mean_curvature_flow(*box.topology, box.points(), {.lambda = 0.3}, {.iterations = 10});
    CHECK(rms(box, sharp, face) < 0.6 * rms(box, box.points(), face));
    CHECK(rms(box, sharp, near_edge) < 0.7 * rms(box, round, near_edge));
}

SCENARIO("Curvature-triggered smoothing starts at the sharp places", "[smoothing]") {
    GIVEN("a box without noise, whose faces are flat and far from its edges") {
        const Surface box =
            iso_surface([](const Vec3& p) { return (p.cwiseAbs() - Vec3(8, 8, 8)).maxCoeff(); },
                        {Vec3(-10, -10, -10), Vec3(10, 10, 10)}, 0.503);
        const auto moved_at = [&](int iterations) {
            std::vector<bool> moved;
            const Positions after =
                curvature_triggered(*box.topology, box.points(), {}, {.iterations = iterations});
            for (std::size_t v = 0; v < after.size(); ++v)
                moved.push_back(after[v] != box.points()[v]);
            return moved;
        };
        const auto once = moved_at(1);
        THEN("only edges move at first, and one more ring with every iteration") {
            int edges = 0;
            for (std::size_t v = 0; v < once.size(); ++v) {
                if (!once[v]) continue;
                ++edges;
                CHECK(near_edge(box.points()[v]));
            }
            CHECK(edges > 100);
            const auto twice = moved_at(2);
            for (VertexId v = 0; v < once.size(); ++v) {
                bool reached = once[v];
                for (const VertexId u : box.topology->rings().row(v)) reached = reached || once[u];
                if (!reached) CHECK_FALSE(twice[v]);
            }
        }
    }
    GIVEN("a sphere, smooth everywhere") {
        const Surface sphere = icosphere(10.0, 4);
        CHECK(curvature_triggered(*sphere.topology, sphere.points()) == sphere.points());
    }
}

SCENARIO("Curvature filters keep fixed vertices and do not depend on threads", "[smoothing]") {
    const Surface box = noisy_box();
    std::vector<double> weights(box.vertex_count(), 1.0);
    for (std::size_t v = 0; v < weights.size(); v += 3) weights[v] = 0.0;
    const PositionConstraint cell{.size = Vec3(0.2, 0.2, 0.2)};
    for (const auto& [name, run] : curvature_filters()) {
        CAPTURE(name);
        const FilterSettings settings{.iterations = 5, .weights = weights, .constraint = cell};
        const Positions moved = run(box, settings);
        double largest = 0.0;
        for (std::size_t v = 0; v < weights.size(); ++v) {
            if (weights[v] == 0.0) REQUIRE(moved[v] == box.points()[v]);
            largest = std::max(largest, (moved[v] - box.points()[v]).cwiseAbs().maxCoeff());
        }
        CHECK(largest <= 0.1 + 1e-12);
        CHECK(largest > 0.0);
        const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
        CHECK(run(box, settings) == moved);
        const Surface tube = open_tube(2.0, 10.0, 16, 12);
        const Positions inner = run(tube, {});
        for (const auto& loop : tube.topology->boundary_loops())
            for (const VertexId v : loop) CHECK(inner[v] == tube.points()[v]);
        const Surface odd = make_surface(
            {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, -1, 0}, {9, 9, 9}, {1, 0, 0}},
            {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}, {2, 2, 3}, {1, 1, 1}, {0, 1, 6}});
        for (const Vec3& p : run(odd, {.keep_boundary = false})) CHECK(p.allFinite());
        CHECK(run(make_surface({}, {}), {}).empty());
    }
    CHECK_THROWS_WITH(mean_curvature_flow(*box.topology, box.points(), {}, {.rings = 2}),
                      Catch::Contains("one ring"));
    CHECK_THROWS_WITH(anisotropic(*box.topology, box.points(), {.feature_curvature = 0.0}),
                      Catch::Contains("feature_curvature"));
    CHECK_THROWS_WITH(curvature_triggered(*box.topology, box.points(), {.trigger_curvature = -1.0}),
                      Catch::Contains("trigger_curvature"));
}
