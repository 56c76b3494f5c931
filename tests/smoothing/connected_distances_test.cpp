#include "smoothing/context/connected_distances.h"

#include <cmath>
#include <limits>
#include <random>

#include <catch2/catch.hpp>
#include <tbb/global_control.h>

#include "smoothing/context/staircase_weights.h"
#include "smoothing/context/staircases.h"
#include "tests/support/shapes.h"
#include "tests/support/surface_facts.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();

/// The definition: a search from every source over everything within its reach.
std::vector<double> by_definition(const Surface& surface, const std::vector<VertexId>& sources,
                                  double reach) {
    const Positions& x = surface.points();
    std::vector<double> distance(x.size(), kFar);
    for (const VertexId s : sources) {
        std::vector<bool> seen(x.size(), false);
        std::vector<VertexId> queue{s};
        seen[s] = true;
        for (std::size_t i = 0; i < queue.size(); ++i) {
            distance[queue[i]] = std::min(distance[queue[i]], (x[queue[i]] - x[s]).norm());
            for (const VertexId u : surface.topology->rings().row(queue[i]))
                if (!seen[u] && (x[u] - x[s]).norm() <= reach) {
                    seen[u] = true;
                    queue.push_back(u);
                }
        }
    }
    return distance;
}

std::vector<VertexId> some_vertices(std::size_t count, double share) {
    std::mt19937 random(11);
    std::bernoulli_distribution chosen(share);
    std::vector<VertexId> result;
    for (VertexId v = 0; v < count; ++v)
        if (chosen(random)) result.push_back(v);
    return result;
}

std::vector<double> distances(const Surface& s, const std::vector<VertexId>& sources,
                              double reach) {
    return connected_distances(*s.topology, s.points(), sources, reach);
}

/// A sphere with another one inside, 0.6 mm below it, and spikes that no straight walk climbs.
Surface spiky_shells() {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> height(-1.0, 1.0);
    return mapped(merged(icosphere(5.0, 3), icosphere(4.4, 3)),
                  [&](const Vec3& p) { return Vec3(p * (1.0 + 0.15 * height(random))); });
}

}  // namespace

SCENARIO("Distances along a surface are those of a search from every source",
         "[smoothing][connected-distances]") {
    const double reach = GENERATE(0.3, 1.0, 2.5, 6.0, 100.0);
    const double share = GENERATE(0.005, 0.1, 0.6);
    CAPTURE(reach, share);
    for (const Surface& surface : {icosphere(5.0, 3), spiky_shells()}) {
        const auto sources = some_vertices(surface.vertex_count(), share);
        REQUIRE(!sources.empty());
        const auto found = distances(surface, sources, reach);
        CHECK(found == by_definition(surface, sources, reach));
        const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
        CHECK(distances(surface, sources, reach) == found);
    }
}

SCENARIO("Sources that crowd in a corner of a wide space give exact distances",
         "[smoothing][connected-distances]") {
    const Surface far = mapped(icosphere(5.0, 1), [](const Vec3& p) { return Vec3(p * 1e6); });
    const Surface both = merged(spiky_shells(), far);
    const double share = GENERATE(0.1, 0.6);
    const auto sources = some_vertices(both.vertex_count(), share);
    CHECK(distances(both, sources, 2.5) == by_definition(both, sources, 2.5));
}

SCENARIO("Distances in a plane and along a line of vertices are exact",
         "[smoothing][connected-distances]") {
    const Vec3 flat = GENERATE(Vec3(1, 1, 0), Vec3(0, 1, 0), Vec3(0, 0, 0), Vec3(0, 1e-310, 0));
    const Surface sphere =
        mapped(icosphere(5.0, 3), [&](const Vec3& p) { return Vec3(p.cwiseProduct(flat)); });
    const auto sources = some_vertices(sphere.vertex_count(), 0.1);
    CHECK(distances(sphere, sources, 1.0) == by_definition(sphere, sources, 1.0));
}

SCENARIO("Distances do not leak between surfaces that are not connected",
         "[smoothing][connected-distances]") {
    const Surface outer = icosphere(5.0, 3);
    const Surface both = merged(outer, icosphere(4.9, 3));
    std::vector<VertexId> sources(outer.vertex_count());
    for (VertexId v = 0; v < sources.size(); ++v) sources[v] = v;
    for (const double reach : {1.0, 1000.0}) {
        const auto found = distances(both, sources, reach);
        for (std::size_t v = 0; v < found.size(); ++v)
            CHECK(found[v] == (v < sources.size() ? 0.0 : kFar));
    }
}

SCENARIO("Vertices at non-finite positions neither stop nor spoil staircase weights",
         "[smoothing][connected-distances][staircases]") {
    const Surface sphere = icosphere(5.0, 3);
    Positions points = sphere.points();
    const double nowhere = GENERATE(std::nan(""), kFar);
    const VertexId lost = 20, neighbour = sphere.topology->rings().row(lost)[0];
    points[lost] = points[neighbour] = Vec3(nowhere, 0.0, nowhere);
    std::vector<double> change(points.size(), 0.0);
    change[0] = change[lost] = 1.0;
    const auto weights = staircase_weights(*sphere.topology, points, change, {.tau_max = 20.0});
    for (VertexId v = 0; v < points.size(); ++v) {
        const bool gone = v == lost || v == neighbour;
        const double expected = gone ? 0.0 : 1.0 - (points[v] - points[0]).norm() / 20.0;
        CHECK(weights[v] == Approx(expected).margin(1e-12));
    }
    for (const double c : orientation_change(*sphere.topology, points, Vec3(0, 0, 1)))
        CHECK((c >= 0.0 && c <= 1.0));
    CHECK_THROWS(orientation_change(*sphere.topology, {}, Vec3(0, 0, 1)));
}
