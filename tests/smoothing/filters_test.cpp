#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <set>

#include <catch2/catch.hpp>
#include <tbb/global_control.h>

#include "geometry/kernel/errors.h"
#include "smoothing/filters/filter.h"
#include "smoothing/filters/laplace.h"
#include "smoothing/filters/laplace_hc.h"
#include "smoothing/filters/taubin.h"
#include "tests/support/shapes.h"
#include "tests/support/shuffled.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

Surface noisy_icosphere(double radius, double noise, int levels = 4) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> offset(-noise, noise);
    return mapped(icosphere(radius, levels),
                  [&](const Vec3& p) { return Vec3(p * (1.0 + offset(random) / radius)); });
}

double rms_radius_error(const Positions& points, double radius) {
    double sum = 0.0;
    for (const Vec3& p : points) sum += std::pow(p.norm() - radius, 2);
    return std::sqrt(sum / static_cast<double>(points.size()));
}

double enclosed(const Surface& surface, const Positions& points) {
    double six_fold = 0.0;
    for (const auto& [a, b, c] : surface.triangles())
        six_fold += points[a].dot(points[b].cross(points[c]));
    return six_fold / 6.0;
}

using Filter = std::function<Positions(const Surface&, std::span<const double>)>;

struct NamedFilter {
    std::string name;
    Filter run;
};

std::vector<NamedFilter> all_filters() {
    return {
        {"laplace", [](const Surface& s,
                       auto w) { return laplace(*s.topology, s.points(), {}, {.weights = w}); }},
        {"laplace-hc",
         [](const Surface& s, auto w) {
             return laplace_hc(*s.topology, s.points(), {}, {.weights = w});
         }},
        {"taubin", [](const Surface& s, auto w) {
             return taubin(*s.topology, s.points(), {}, {.weights = w});
         }}};
}

double largest_difference(const Positions& a, const Positions& b) {
    double largest = 0.0;
    for (std::size_t v = 0; v < a.size(); ++v) largest = std::max(largest, (a[v] - b[v]).norm());
    return largest;
}

}  // namespace

SCENARIO("Taubin smoothing removes noise without shrinking the vessel", "[smoothing][taubin]") {
    const Surface noisy = noisy_icosphere(10.0, 0.2);
    const Positions smooth = taubin(*noisy.topology, noisy.points(), {});
    CHECK(rms_radius_error(smooth, 10.0) < 0.5 * rms_radius_error(noisy.points(), 10.0));
    CHECK(enclosed(noisy, smooth) == Approx(enclosed(noisy, noisy.points())).epsilon(0.01));
}

SCENARIO("Laplace+HC removes noise and shrinks less than Laplace", "[smoothing][laplace-hc]") {
    const Surface noisy = noisy_icosphere(10.0, 0.2);
    const double before = enclosed(noisy, noisy.points());
    const Positions hc = laplace_hc(*noisy.topology, noisy.points(), {});
    const Positions plain = laplace(*noisy.topology, noisy.points(), {});
    CHECK(rms_radius_error(hc, 10.0) < 0.5 * rms_radius_error(noisy.points(), 10.0));
    CHECK(enclosed(noisy, hc) == Approx(before).epsilon(0.005));
    CHECK(before - enclosed(noisy, plain) > 2.0 * std::abs(before - enclosed(noisy, hc)));
}

SCENARIO("A filter damps a known frequency by its transfer function", "[smoothing]") {
    const Surface sphere = icosphere(1.0, 0);  // every vertex has 5 neighbours
    GIVEN("the vertices of an icosahedron, whose umbrella operator shrinks x by 1 - 1/sqrt(5)") {
        const double k = 1.0 - 1.0 / std::sqrt(5.0);
        const auto scale = [&](const Positions& moved) {
            return moved[0].norm() / sphere.points()[0].norm();
        };
        THEN("Laplace scales by (1 - lambda k)^n") {
            const auto moved =
                laplace(*sphere.topology, sphere.points(), {.lambda = 0.3}, {.iterations = 4});
            CHECK(scale(moved) == Approx(std::pow(1.0 - 0.3 * k, 4)));
        }
        THEN("Taubin scales by ((1 - lambda k)(1 - mu k))^n") {
            const auto moved = taubin(*sphere.topology, sphere.points(),
                                      {.lambda = 0.3, .mu = -0.34}, {.iterations = 4});
            CHECK(scale(moved) == Approx(std::pow((1.0 - 0.3 * k) * (1.0 + 0.34 * k), 4)));
        }
        THEN("Laplace+HC scales by (1 - (1 - beta) lambda k^2)^n") {
            const auto moved = laplace_hc(*sphere.topology, sphere.points(),
                                          {.lambda = 0.3, .beta = 0.6}, {.iterations = 4});
            CHECK(scale(moved) == Approx(std::pow(1.0 - 0.4 * 0.3 * k * k, 4)));
        }
    }
}

SCENARIO("Weights scale the final displacement of an iteration", "[smoothing][weights]") {
    const Surface noisy = noisy_icosphere(10.0, 0.2, 2);
    const std::vector<double> half(noisy.vertex_count(), 0.5);
    const auto middle = [&](const Positions& full) {
        Positions result = full;
        for (std::size_t v = 0; v < result.size(); ++v)
            result[v] = 0.5 * (noisy.points()[v] + full[v]);
        return result;
    };
    const Topology& topology = *noisy.topology;
    const auto taubin_full = taubin(topology, noisy.points(), {}, {.iterations = 1});
    const auto taubin_half =
        taubin(topology, noisy.points(), {}, {.iterations = 1, .weights = half});
    CHECK(largest_difference(taubin_half, middle(taubin_full)) < 1e-12);
    const auto hc_full = laplace_hc(topology, noisy.points(), {}, {.iterations = 1});
    const auto hc_half =
        laplace_hc(topology, noisy.points(), {}, {.iterations = 1, .weights = half});
    CHECK(largest_difference(hc_half, middle(hc_full)) < 1e-12);
}

SCENARIO("Fixed vertices stay bit for bit", "[smoothing][weights]") {
    for (const auto& [name, run] : all_filters()) {
        CAPTURE(name);
        const Surface noisy = noisy_icosphere(10.0, 0.2, 3);
        const std::vector<double> nothing(noisy.vertex_count(), 0.0);
        CHECK(run(noisy, nothing) == noisy.points());
        const Surface tube = open_tube(2.0, 10.0, 16, 12);
        const Positions moved = run(tube, {});
        for (const auto& loop : tube.topology->boundary_loops())
            for (const VertexId v : loop) CHECK(moved[v] == tube.points()[v]);
    }
}

SCENARIO("Smoothing does not depend on threads, place, direction or unit", "[smoothing]") {
    const Surface noisy = noisy_icosphere(10.0, 0.2, 4);
    const Eigen::Matrix3d turn = skew_rotation();
    const auto map = [&](const Vec3& p) { return Vec3(1e-3 * (turn * p) + Vec3(5, -3, 2)); };
    const Surface other = mapped(noisy, map);
    for (const auto& [name, run] : all_filters()) {
        CAPTURE(name);
        const Positions smooth = run(noisy, {});
        {
            const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
            CHECK(run(noisy, {}) == smooth);
        }
        const Positions turned = run(other, {});
        Positions expected = smooth;
        for (Vec3& p : expected) p = map(p);
        CHECK(largest_difference(turned, expected) < 1e-12);
    }
}

SCENARIO("Parameters out of range are refused by name", "[smoothing]") {
    const Surface sphere = icosphere(1.0, 1);
    const Topology& topology = *sphere.topology;
    const Positions& points = sphere.points();
    CHECK_THROWS_WITH(laplace(topology, points, {.lambda = 1.5}), Catch::Contains("lambda"));
    CHECK_THROWS_WITH(taubin(topology, points, {.mu = 0.52}), Catch::Contains("mu = 0.52"));
    CHECK_THROWS_WITH(laplace_hc(topology, points, {.beta = -0.1}), Catch::Contains("beta"));
    CHECK_THROWS_AS(laplace(topology, points, {}, {.iterations = -1}), InvalidInput);
    CHECK_THROWS_AS(laplace(topology, points, {}, {.rings = 3}), InvalidInput);
    const std::vector<double> few(3, 1.0), large(42, 2.0);
    CHECK_THROWS_AS(laplace(topology, points, {}, {.weights = few}), InvalidInput);
    CHECK_THROWS_AS(laplace(topology, points, {}, {.weights = large}), InvalidInput);
    Positions broken = points;
    broken[5].y() = std::nan("");
    CHECK_THROWS_WITH(laplace(topology, broken), Catch::Contains("vertex 5"));
}

SCENARIO("Parameter sets that amplify are recognised", "[smoothing]") {
    CHECK_FALSE(amplifies(LaplaceHcParameters{}));
    CHECK(amplifies(LaplaceHcParameters{.lambda = 1.0, .beta = 0.0}));
    CHECK_FALSE(amplifies(TaubinParameters{}));
    CHECK(amplifies(TaubinParameters{.lambda = 1.0}));
}

SCENARIO("A filter that diverges is ended with a text", "[smoothing][bad-input]") {
    const Surface sphere = mapped(icosphere(5.0, 4), [](const Vec3& p) {
        return Vec3(p * (1.0 + 0.02 * std::sin(9.0 * p.x()) * std::cos(7.0 * p.y())));
    });
    for (const int iterations : {30, 3000})
        CHECK_THROWS_WITH(
            apply_filter(*sphere.topology, sphere.points(),
                         TaubinParameters{.lambda = 1.0, .mu = -2.0}, {.iterations = iterations}),
            Catch::Contains("the filter diverges"));
}

namespace {

/// Eq. 3.1 as printed, on any neighbourhood.
Positions laplace_as_printed(const CompressedRows& rows, Positions x, double lambda,
                             int iterations) {
    for (int iteration = 0; iteration < iterations; ++iteration) {
        Positions next = x;
        for (std::size_t v = 0; v < x.size(); ++v) {
            Vec3 sum = Vec3::Zero();
            for (const VertexId u : rows.row(v)) sum += x[u] - x[v];
            if (!rows.row(v).empty())
                next[v] += lambda * sum / static_cast<double>(rows.row(v).size());
        }
        x = next;
    }
    return x;
}

}  // namespace

SCENARIO("Laplace is Eq. 3.1 on surfaces of every size and numbering", "[smoothing][laplace]") {
    for (const int levels : {1, 4, 6, 7}) {
        CAPTURE(levels);
        const Surface noisy = noisy_icosphere(10.0, 0.05, levels);
        const Positions expected =
            laplace_as_printed(noisy.topology->rings(), noisy.points(), 0.7, 7);
        const Positions smooth =
            laplace(*noisy.topology, noisy.points(), {.lambda = 0.7}, {.iterations = 7});
        CHECK(largest_difference(smooth, expected) < 1e-12);
        std::vector<VertexId> numbers;
        const Surface mixed = shuffled(noisy, numbers);
        const Positions other =
            laplace(*mixed.topology, mixed.points(), {.lambda = 0.7}, {.iterations = 7});
        double largest = 0.0;
        for (std::size_t v = 0; v < numbers.size(); ++v)
            largest = std::max(largest, (other[numbers[v]] - expected[v]).norm());
        CHECK(largest < 1e-12);
    }
}

SCENARIO("Two rings smooth more than one", "[smoothing]") {
    const Surface noisy = noisy_icosphere(10.0, 0.2, 3);
    CompressedRows wide;
    wide.offsets.push_back(0);
    for (VertexId v = 0; v < noisy.vertex_count(); ++v) {
        std::set<VertexId> around;
        for (const VertexId u : noisy.topology->rings().row(v)) {
            around.insert(u);
            for (const VertexId w : noisy.topology->rings().row(u)) around.insert(w);
        }
        around.erase(v);
        wide.values.insert(wide.values.end(), around.begin(), around.end());
        wide.offsets.push_back(static_cast<std::uint32_t>(wide.values.size()));
    }
    const Positions smooth =
        laplace(*noisy.topology, noisy.points(), {}, {.iterations = 3, .rings = 2});
    const Positions expected = laplace_as_printed(wide, noisy.points(), 0.5, 3);
    CHECK(largest_difference(smooth, expected) < 1e-12);
}

SCENARIO("Weights of a filter on several threads give the same bits", "[smoothing][weights]") {
    const Surface noisy = noisy_icosphere(10.0, 0.1, 6);
    std::mt19937 random(5);
    std::uniform_real_distribution<double> any(0.0, 1.0);
    std::vector<double> weights(noisy.vertex_count());
    for (double& weight : weights) weight = any(random);
    for (const auto& [name, run] : all_filters()) {
        CAPTURE(name);
        const Positions smooth = run(noisy, weights);
        for (const int threads : {1, 3}) {
            const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                            static_cast<std::size_t>(threads));
            CHECK(run(noisy, weights) == smooth);
        }
    }
}

SCENARIO("No vertex leaves the cell of a position constraint", "[smoothing][constraint]") {
    const Surface noisy = noisy_icosphere(10.0, 0.5, 3);
    const Eigen::Matrix3d axes = skew_rotation();
    const Vec3 size(0.3, 0.2, 0.6);
    for (const auto cell : {PositionConstraint::Cell::Voxel, PositionConstraint::Cell::Diamond}) {
        const Positions smooth =
            laplace(*noisy.topology, noisy.points(), {.lambda = 1.0},
                    {.iterations = 30, .constraint = PositionConstraint{cell, axes, size}});
        double largest = 0.0;
        for (std::size_t v = 0; v < smooth.size(); ++v) {
            const Vec3 inside = (axes.transpose() * (smooth[v] - noisy.points()[v]))
                                    .cwiseAbs()
                                    .cwiseQuotient(0.5 * size);
            largest = std::max(largest, cell == PositionConstraint::Cell::Voxel ? inside.maxCoeff()
                                                                                : inside.sum());
        }
        CHECK(largest == Approx(1.0));  // reached, and not left
    }
    GIVEN("a cell that no vertex wants to leave") {
        const PositionConstraint wide{.size = Vec3(50.0, 50.0, 50.0)};
        THEN("the filter does what it does without") {
            const auto free = taubin(*noisy.topology, noisy.points());
            CHECK(taubin(*noisy.topology, noisy.points(), {}, {.constraint = wide}) == free);
        }
    }
    const PositionConstraint flat{.size = Vec3(1.0, 0.0, 1.0)};
    CHECK_THROWS_AS(laplace(*noisy.topology, noisy.points(), {}, {.constraint = flat}),
                    InvalidInput);
}

SCENARIO("No filter reads memory that it has not written", "[smoothing]") {
    const Surface sphere = icosphere(1.0, 4);
    {  // leaves NaN in freed memory
        std::vector<std::vector<double>> rubbish;
        for (int i = 0; i < 40; ++i) rubbish.emplace_back(4 * 2562 + 8 * i, std::nan(""));
    }
    for (const auto& [name, run] : all_filters()) {
        CAPTURE(name);
        for (const Vec3& p : run(sphere, {})) REQUIRE(p.allFinite());
    }
}

SCENARIO("Triangles that are degenerate, alone or not manifold do no harm", "[smoothing]") {
    Positions points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, -1, 0}, {9, 9, 9}};
    const Surface odd = make_surface(
        points, {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}, {2, 2, 3}, {1, 1, 1}});  // 5 is alone
    for (const auto& [name, run] : all_filters()) {
        CAPTURE(name);
        const Positions moved = run(odd, {});
        for (const Vec3& p : moved) CHECK(p.allFinite());
        CHECK(moved[5] == points[5]);
        CHECK(run(make_surface({}, {}), {}).empty());
    }
}
