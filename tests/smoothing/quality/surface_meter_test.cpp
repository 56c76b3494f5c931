#include "smoothing/quality/surface_meter.h"

#include <random>

#include <catch2/catch.hpp>
#include <tbb/global_control.h>

#include "geometry/kernel/local_error.h"
#include "geometry/kernel/measure.h"
#include "geometry/kernel/statistics.h"
#include "smoothing/filters/filter.h"
#include "smoothing/filters/filter_run.h"
#include "tests/support/iso_surface.h"
#include "tests/support/shapes.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

std::vector<PackRow> packed(const Positions& positions) {
    std::vector<PackRow> packs;
    for (const Vec3& p : positions) packs.push_back({{p.x(), p.y(), p.z(), 0.0}});
    return packs;
}

/// A vessel with slivers, as extracted from an image.
Surface raw_vessel() {
    const auto shape = [](const Vec3& p) {
        return capsule(p, Vec3(0, 0, -6), Vec3(0.7, 0.4, 6), 2.1);
    };
    return with_noise(iso_surface(shape, {Vec3(-4, -4, -10), Vec3(4, 4, 10)}, 0.5), 0.1);
}

/// Eqs. 6.3 and 6.4 by the cross products that the cotangents' sum is: the gradient of the area.
double curvature_as_printed(const Surface& surface, const Positions& x) {
    Positions gradient(x.size(), Vec3::Zero()), normals(x.size(), Vec3::Zero());
    for (const Triangle& t : surface.triangles()) {
        const Vec3 n = area_normal(x, t);
        for (int k = 0; k < 3; ++k) {
            normals[t[k]] += n;
            if (n.norm() > 0.0)
                gradient[t[k]] += n.normalized().cross(x[t[(k + 2) % 3]] - x[t[(k + 1) % 3]]);
        }
    }
    double sum = 0.0;
    for (std::size_t v = 0; v < x.size(); ++v)
        if (surface.topology->boundary_vertices()[v] == 0)
            sum += 0.25 * gradient[v].dot(normals[v].normalized());
    return sum;
}

struct NamedSurface {
    std::string name;
    Surface surface;
};

std::vector<NamedSurface> surfaces() {
    const Surface ball = with_noise(icosphere(10.0, 3), 0.1);
    // Two balls that share one vertex: its triangles are no single fan.
    Positions points = ball.points();
    std::vector<Triangle> triangles(ball.triangles().begin(), ball.triangles().end());
    const auto count = static_cast<VertexId>(points.size());
    for (const Vec3& p : ball.points()) points.push_back(2.0 * ball.points()[0] - p);
    for (const auto& [a, b, c] : ball.triangles()) {
        const auto other = [&](VertexId v) { return v == 0 ? 0 : count + v; };
        triangles.push_back({other(a), other(c), other(b)});
    }
    return {{"ball", ball},
            {"open tube", with_noise(open_tube(3.0, 12.0, 18, 24), 0.1)},
            {"vessel with slivers", raw_vessel()},
            {"two balls at one vertex", make_surface(points, triangles)}};
}

}  // namespace

SCENARIO("All measures of one pass are those of geometry", "[quality][meter]") {
    for (const auto& [name, surface] : surfaces()) {
        const SurfaceMeter meter(surface.topology, surface.positions, true);
        for (const int iterations : {0, 1, 5, 20}) {
            INFO(name << ", " << iterations << " iterations");
            const Positions moved = laplace(*surface.topology, surface.points(), {.lambda = 0.8},
                                            {.iterations = iterations});
            const auto found = meter.measure(packed(moved), meter.own_references());
            const auto error = local_error(*surface.topology, surface.points(), moved);
            const auto thesis =
                local_error(*surface.topology, surface.points(), moved, LocalErrorForm::Thesis);
            const SurfaceMeasures all = measure(surface.with_positions(moved));
            CHECK(found.error == Approx(error.mean).epsilon(1e-6).margin(1e-9));
            CHECK(found.error_thesis == Approx(thesis.mean).epsilon(1e-6).margin(1e-9));
            CHECK(found.volume == Approx(all.volume).epsilon(1e-9));
            CHECK(found.curvature_abs == Approx(all.mean_curvature_integral_abs).epsilon(1e-9));
            CHECK(found.curvature == Approx(curvature_as_printed(surface, moved)).epsilon(1e-9));
        }
    }
}

SCENARIO("What is seen of a state are the figures of smoothing", "[quality][meter]") {
    for (const auto& [name, surface] : surfaces()) {
        const SurfaceMeter meter(surface.topology, surface.positions);
        for (const int iterations : {0, 1, 20}) {
            INFO(name << ", " << iterations << " iterations");
            const Positions moved = laplace(*surface.topology, surface.points(), {.lambda = 0.8},
                                            {.iterations = iterations});
            const Surface after = surface.with_positions(moved);
            const SeenMeasures seen = meter.measure_seen(packed(moved));
            const LocalError error = local_error(*surface.topology, surface.points(), moved);
            REQUIRE(seen.error.values.size() == error.values.size());
            for (std::size_t v = 0; v < error.values.size(); ++v)
                REQUIRE(seen.error.values[v] == Approx(error.values[v]).epsilon(1e-6).margin(1e-7));
            CHECK(seen.error.mean == Approx(error.mean).epsilon(1e-6).margin(1e-9));
            CHECK(seen.error.largest == Approx(error.largest).epsilon(1e-6).margin(1e-7));
            CHECK(seen.volume == Approx(volume(after)).epsilon(1e-9));
            CHECK(seen.normal_curvature_deg == Approx(mean(normal_curvature(after))).epsilon(1e-8));
        }
    }
}

SCENARIO("A sphere's measures are known", "[quality][meter]") {
    const Surface ball = icosphere(10.0, 4);
    const SurfaceMeter meter(ball.topology, ball.positions);
    const double pi = 3.14159265358979;
    CHECK(meter.original().error == 0.0);
    CHECK(meter.original().curvature == Approx(4.0 * pi * 10.0).epsilon(0.01));
    CHECK(meter.original().volume == Approx(4.0 / 3.0 * pi * 1000.0).epsilon(0.01));
    Positions smaller = ball.points();
    for (Vec3& p : smaller) p *= 0.99;
    auto references = meter.own_references();
    const auto found = meter.follow_and_measure(packed(smaller), references);
    CHECK(found.error == Approx(0.1).epsilon(0.02));
    CHECK(found.curvature == Approx(0.99 * meter.original().curvature));
    CHECK(found.volume == Approx(0.99 * 0.99 * 0.99 * meter.original().volume));
}

SCENARIO("Measures do not depend on threads or on the order in memory", "[quality][meter]") {
    const Surface surface = raw_vessel();
    const Positions moved =
        laplace(*surface.topology, surface.points(), {.lambda = 0.8}, {.iterations = 20});
    const SurfaceMeter meter(surface.topology, surface.positions);
    const auto all = meter.measure(packed(moved), meter.own_references());
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    CHECK(meter.measure(packed(moved), meter.own_references()) == all);
    std::vector<VertexId> order = own_references(*surface.topology);
    std::shuffle(order.begin(), order.end(), std::mt19937(3));
    const SurfaceMeter other(surface.topology, surface.positions, false, order);
    Positions placed;
    for (const VertexId v : order) placed.push_back(moved[v]);
    const auto shuffled = other.measure(packed(placed), other.own_references());
    CHECK(shuffled.error == Approx(all.error).epsilon(1e-9));
    CHECK(shuffled.curvature_abs == Approx(all.curvature_abs).epsilon(1e-9));
    CHECK(shuffled.volume == Approx(all.volume).epsilon(1e-9));
}

SCENARIO("Drifting along the surface is no error", "[quality][meter]") {
    const Surface tube = open_tube(3.0, 12.0, 18, 24);
    const SurfaceMeter meter(tube.topology, tube.positions);
    Positions slid = tube.points();
    auto references = meter.own_references();
    for (int step = 0; step < 8; ++step) {
        for (Vec3& p : slid)
            if (p.z() > 0.1 && p.z() < 11.0) p.z() += 0.1;
        const auto found = meter.follow_and_measure(packed(slid), references);
        CHECK(found.error < 1e-9);
    }
    CHECK(references != meter.own_references());
}

SCENARIO("Estimates of all states have the same small error", "[quality][meter]") {
    const Surface surface = with_noise(icosphere(20.0, 6), 0.1);  // 40,962 vertices
    const SurfaceMeter meter(surface.topology, surface.positions);
    auto references = meter.own_references(), sampled = references;
    for (const int iterations : {5, 10, 30}) {
        INFO(iterations << " iterations");
        const auto moved = packed(laplace(*surface.topology, surface.points(), {.lambda = 0.5},
                                          {.iterations = iterations}));
        const auto full = meter.follow_and_measure(moved, references);
        const auto estimate = meter.follow_and_estimate(moved, sampled);
        CHECK(estimate.volume == Approx(full.volume).epsilon(1e-9));
        CHECK(estimate.error == Approx(full.error).epsilon(0.08));
        CHECK(estimate.curvature_abs == Approx(full.curvature_abs).epsilon(0.08));
    }
}
