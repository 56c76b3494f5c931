#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "geometry/kernel/errors.h"
#include "tests/support/shapes.h"
#include "tests/support/surface_facts.h"
#include "tests/workbench/test_operations.h"
#include "workbench/case/operation.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

/// A second run with the resolved arguments leaves the same bits.
void check_replay(const std::string& operation, const Surface& surface, const Outcome& outcome) {
    const Outcome again = run(operation, surface, outcome.resolved);
    CHECK(again.scene.surface->points() == outcome.scene.surface->points());
    CHECK(std::equal(
        again.scene.surface->triangles().begin(), again.scene.surface->triangles().end(),
        outcome.scene.surface->triangles().begin(), outcome.scene.surface->triangles().end()));
    CHECK(again.scene.surface->patches == outcome.scene.surface->patches);
}

}  // namespace

SCENARIO("extrude-opening lengthens all openings by diameters", "[workbench][openings]") {
    const Surface tube = closed_tube(2.0, 20.0, 48, 60);
    const Outcome outcome = run("extrude-opening", tube, {});
    THEN("each is three diameters longer, and the report says so") {
        CHECK(is_closed_manifold(*outcome.scene.surface));
        CHECK(enclosed_volume(*outcome.scene.surface) ==
              Approx(enclosed_volume(tube) * 44.0 / 20.0).epsilon(3e-3));
        REQUIRE(outcome.report->at("openings").size() == 2);
        CHECK(outcome.report->at("openings")[0]["length_mm"].get<double>() ==
              Approx(12.0).epsilon(3e-3));
        check_replay("extrude-opening", tube, outcome);
    }
    THEN("an unknown opening and a surface without openings are refused") {
        CHECK_THROWS_WITH(run("extrude-opening", tube, {{"opening", "outlet_9"}}),
                          Catch::Contains("outlet_1"));
        CHECK_THROWS_AS(run("extrude-opening", icosphere(1.0, 1), {}), AlgorithmFailure);
    }
}

SCENARIO("fill-hole closes the named hole or all of them", "[workbench][openings]") {
    const Surface tube = open_tube(2.0, 20.0, 40, 60);
    const Outcome one = run("fill-hole", tube, {{"near", Vec3(0, 0, 21)}});
    CHECK(one.scene.surface->topology->boundary_loops().size() == 1);
    const Outcome all = run("fill-hole", tube, {});
    CHECK(is_closed_manifold(*all.scene.surface));
    check_replay("fill-hole", tube, all);
    CHECK_THROWS_AS(run("fill-hole", *all.scene.surface, {}), AlgorithmFailure);
}

SCENARIO("clip-opening opens every end, and replays what it decided", "[workbench][openings]") {
    const Surface tube = open_tube(2.0, 30.0, 40, 90);
    const Outcome outcome = run("clip-opening", tube, {});
    THEN("both ends are capped, perpendicular and named") {
        const Surface& clipped = *outcome.scene.surface;
        CHECK(is_closed_manifold(clipped));
        REQUIRE(clipped.patches.size() == 3);
        CHECK(clipped.patches[1] == Patch{"inlet", PatchKind::Inlet});
        CHECK(clipped.patches[2] == Patch{"outlet_1", PatchKind::Outlet});
        for (const auto& opening : outcome.report->at("openings"))
            CHECK(opening["tilt_deg"].get<double>() < 0.5);
        check_replay("clip-opening", tube, outcome);
    }
    THEN("one end can be opened alone, with a name and a kind") {
        const Outcome one = run("clip-opening", tube,
                                {{"tip", Vec3(0, 0, 30)},
                                 {"distance", 5.0},
                                 {"name", std::string("femoral")},
                                 {"kind", std::string("outlet")}});
        REQUIRE(one.scene.surface->patches.size() == 2);
        CHECK(one.scene.surface->patches[1] == Patch{"femoral", PatchKind::Outlet});
        CHECK(one.scene.surface->topology->boundary_loops().size() == 1);
        check_replay("clip-opening", tube, one);
    }
    THEN("contradictory arguments are refused") {
        CHECK_THROWS_AS(run("clip-opening", tube, {{"name", std::string("x")}}), UsageError);
        CHECK_THROWS_AS(run("clip-opening", tube, {{"distance", 1.0}, {"radii", 1.0}}), UsageError);
        CHECK_THROWS_AS(run("clip-opening", tube,
                            {{"planes", std::vector<double>{1, 2}}, {"names", std::string("x")}}),
                        UsageError);
    }
}

SCENARIO("remove-branch names the branch by a point", "[workbench][openings]") {
    const Surface tube = open_tube(2.0, 30.0, 40, 90);
    CHECK_THROWS_AS(run("remove-branch", tube, {}), UsageError);
    CHECK_THROWS_AS(run("remove-branch", tube, {{"tip", Vec3(0, 0, 30)}}), AlgorithmFailure);
}
