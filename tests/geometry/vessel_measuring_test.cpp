#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "geometry/kernel/errors.h"
#include "geometry/vessel/centerlines/branch_queries.h"
#include "geometry/vessel/centerlines/centerlines.h"
#include "geometry/vessel/centerlines/vessel_diameter.h"
#include "geometry/vessel/tree/flight_path.h"
#include "tests/support/shapes.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

struct StraightTube {
    Surface surface = fine_tube(4, 30, 36);
    std::shared_ptr<const CenterlineGraph> graph = centerlines_of(surface);
    std::vector<PatchMeasures> openings = [this] {
        auto patches = measure_patches(surface);
        std::erase_if(patches, [](const auto& patch) { return patch.kind == PatchKind::Wall; });
        return patches;
    }();
};

/// A straight branch along a direction, from a node to another one.
CenterlineBranch straight(CenterlineGraph& graph, std::size_t from, std::size_t to) {
    CenterlineBranch branch{.start_node = from, .end_node = to};
    for (int i = 0; i <= 20; ++i) {
        branch.points.emplace_back(graph.nodes[from].position +
                                   i / 20.0 *
                                       (graph.nodes[to].position - graph.nodes[from].position));
        branch.radii.push_back(2);
    }
    return branch;
}

/// A trunk of 10 mm from the origin, and two branches, one of which was found from its tip.
CenterlineGraph y_graph() {
    CenterlineGraph graph;
    for (const Vec3& place : {Vec3(0, 0, 0), Vec3(0, 0, 10), Vec3(6, 0, 18), Vec3(-6, 0, 18)})
        graph.nodes.push_back({.position = place, .radius = 2});
    using Ends = std::pair<std::size_t, std::size_t>;
    for (const auto& [from, to] : {Ends{0, 1}, Ends{1, 2}, Ends{3, 1}}) {
        graph.nodes[from].branches.push_back(graph.branches.size());
        graph.nodes[to].branches.push_back(graph.branches.size());
        graph.branches.push_back(straight(graph, from, to));
    }
    return graph;
}

}  // namespace

SCENARIO("The length of clicked points is that of the lines between them",
         "[geometry][measuring]") {
    const Positions points = {{0, 0, 0}, {3, 4, 0}, {3, 4, 12}};
    CHECK(path_length(points) == Approx(17));
    CHECK(path_length({points.data(), 2}) == Approx(5));
    CHECK(path_length({points.data(), 1}) == 0);
}

SCENARIO("A tube of 4 mm radius has a diameter of 8 mm", "[geometry][measuring]") {
    const StraightTube tube;
    const auto found = vessel_diameter(tube.surface, *tube.graph, {0, -4, 15});
    REQUIRE(found);
    CHECK(found->inscribed == Approx(8).epsilon(0.02));
    CHECK(found->equivalent == Approx(8).epsilon(0.02));
    CHECK(found->area == Approx(16 * std::numbers::pi).epsilon(0.03));
    CHECK(found->centre.head<2>().norm() < 0.1);
    CHECK(found->centre.z() == Approx(15).margin(0.2));
    REQUIRE(found->outline.size() > 20);
    for (const Vec3& point : found->outline)
        CHECK(std::hypot(point.x(), point.y()) == Approx(4).epsilon(0.02));
    CHECK_FALSE(vessel_diameter(tube.surface, {}, {0, -4, 15}));
}

SCENARIO("A flight goes from the inlet to the outlet", "[geometry][measuring]") {
    const StraightTube tube;
    const auto paths = flight_paths(*tube.graph, tube.openings);
    REQUIRE(paths.size() == 1);
    CHECK(paths[0].name == "outlet_1");
    CHECK(paths[0].length() == Approx(30).margin(1));
    const FlightPlace middle = place_on(paths[0], 15);
    CHECK(middle.eye.z() == Approx(15).margin(0.5));
    CHECK(middle.eye.head<2>().norm() < 0.2);
    CHECK(middle.view.z() > 0.99);
    CHECK(std::abs(middle.view.dot(middle.up)) < 1e-9);
    CHECK(middle.radius == Approx(4).epsilon(0.03));
    THEN("it ends looking out of the vessel") {
        CHECK(place_on(paths[0], 1e3).view.z() > 0.9);
        CHECK(place_on(paths[0], 1e3).eye == paths[0].tube.points().back());
        CHECK(place_on(paths[0], -1).eye == paths[0].tube.points().front());
    }
}

SCENARIO("Every end of a vessel tree can be flown to", "[geometry][measuring]") {
    const CenterlineGraph graph = y_graph();
    const PatchMeasures inlet{.name = "inlet", .kind = PatchKind::Inlet, .centroid = {0, 0, 0}};
    const auto paths = flight_paths(graph, {inlet});
    REQUIRE(paths.size() == 2);
    for (const FlightPath& path : paths) {
        CHECK(path.length() == Approx(20));
        CHECK(path.tube.points().front() == Vec3(0, 0, 0));
        CHECK(std::abs(path.tube.points().back().x()) == Approx(6));
        CHECK(place_on(path, 19).view.x() * path.tube.points().back().x() > 0);
    }
    CHECK(paths[0].tube.points().back() != paths[1].tube.points().back());
    THEN("the camera does not roll") {
        for (double s = 0.25; s <= paths[0].length(); s += 0.25)
            CHECK(place_on(paths[0], s).up.dot(place_on(paths[0], s - 0.25).up) > 0.8);
    }
    CHECK(flight_paths({}, {}).empty());
    CHECK_THROWS_AS(place_on(FlightPath{}, 0), InvalidInput);
}
