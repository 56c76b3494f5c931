#include <cmath>
#include <functional>
#include <random>

#include <catch2/catch.hpp>
#include <tbb/global_control.h>

#include "geometry/errors.h"
#include "smoothing/laplace.h"
#include "smoothing/laplace_hc.h"
#include "smoothing/taubin.h"
#include "tests/support/shapes.h"

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
    return {{"laplace",
             [](const Surface& s, auto w) { return laplace(*s.topology, s.points(), w, {}); }},
            {"laplace-hc",
             [](const Surface& s, auto w) { return laplace_hc(*s.topology, s.points(), w, {}); }},
            {"taubin",
             [](const Surface& s, auto w) { return taubin(*s.topology, s.points(), w, {}); }}};
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
                laplace(*sphere.topology, sphere.points(), {}, {.lambda = 0.3, .iterations = 4});
            CHECK(scale(moved) == Approx(std::pow(1.0 - 0.3 * k, 4)));
        }
        THEN("Taubin scales by ((1 - lambda k)(1 - mu k))^n") {
            const auto moved = taubin(*sphere.topology, sphere.points(), {},
                                      {.lambda = 0.3, .mu = -0.34, .iterations = 4});
            CHECK(scale(moved) == Approx(std::pow((1.0 - 0.3 * k) * (1.0 + 0.34 * k), 4)));
        }
        THEN("Laplace+HC scales by (1 - (1 - beta) lambda k^2)^n") {
            const auto moved = laplace_hc(*sphere.topology, sphere.points(), {},
                                          {.lambda = 0.3, .beta = 0.6, .iterations = 4});
            CHECK(scale(moved) == Approx(std::pow(1.0 - 0.4 * 0.3 * k * k, 4)));
        }
    }
}

SCENARIO("Weights scale the final displacement of an iteration", "[smoothing][weights]") {
    const Surface noisy = noisy_icosphere(10.0, 0.2, 2);
    const auto one = [](auto parameters) {
        parameters.iterations = 1;
        return parameters;
    };
    const std::vector<double> half(noisy.vertex_count(), 0.5);
    const auto middle = [&](const Positions& full) {
        Positions result = full;
        for (std::size_t v = 0; v < result.size(); ++v)
            result[v] = 0.5 * (noisy.points()[v] + full[v]);
        return result;
    };
    const Topology& topology = *noisy.topology;
    const auto taubin_full = taubin(topology, noisy.points(), {}, one(TaubinParameters{}));
    const auto taubin_half = taubin(topology, noisy.points(), half, one(TaubinParameters{}));
    CHECK(largest_difference(taubin_half, middle(taubin_full)) < 1e-12);
    const auto hc_full = laplace_hc(topology, noisy.points(), {}, one(LaplaceHcParameters{}));
    const auto hc_half = laplace_hc(topology, noisy.points(), half, one(LaplaceHcParameters{}));
    CHECK(largest_difference(hc_half, middle(hc_full)) < 1e-12);
}

SCENARIO("What must stay, stays bit for bit", "[smoothing][weights]") {
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
    CHECK_THROWS_WITH(laplace(topology, points, {}, {.lambda = 1.5}), Catch::Contains("lambda"));
    CHECK_THROWS_WITH(taubin(topology, points, {}, {.mu = 0.52}), Catch::Contains("mu = 0.52"));
    CHECK_THROWS_WITH(laplace_hc(topology, points, {}, {.beta = -0.1}), Catch::Contains("beta"));
    CHECK_THROWS_AS(laplace(topology, points, {}, {.iterations = -1}), InvalidInput);
    CHECK_THROWS_AS(laplace(topology, points, std::vector<double>(3, 1.0)), InvalidInput);
    CHECK_THROWS_AS(laplace(topology, points, std::vector<double>(42, 2.0)), InvalidInput);
}

SCENARIO("Parameter sets that amplify are recognised", "[smoothing]") {
    CHECK_FALSE(amplifies(LaplaceHcParameters{}));
    CHECK(amplifies(LaplaceHcParameters{.lambda = 1.0, .beta = 0.0}));
    CHECK_FALSE(amplifies(TaubinParameters{}));
    CHECK(amplifies(TaubinParameters{.lambda = 1.0}));
}
