#include "workbench/operations/shared/bodies.h"

#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "geometry/kernel/edges.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/measure.h"
#include "tests/support/shapes.h"
#include "tests/support/surface_facts.h"
#include "workbench/operations/table.h"

using namespace vesselbench;
using namespace vesselbench::test;
using Catch::Matchers::Contains;

namespace {

/// A trunk along z, 8 mm wide and 40 mm long.
Surface trunk() {
    return closed_tube(4.0, 40.0, 32, 40);
}

/// A branch that begins inside the trunk and leaves it sideways, 5 mm wide.
Surface branch() {
    return mapped(closed_tube(2.5, 30.0, 24, 30),
                  [](const Vec3& p) { return Vec3(p.z(), 0.3 + p.y(), 20.0 - p.x()); });
}

Surface moved(const Surface& surface, const Vec3& way) {
    return mapped(surface, [&](const Vec3& p) { return Vec3(p + way); });
}

/// A base plate of 60 x 60 x 2 mm in which the trunk stands.
Surface plate() {
    return mapped(cube(1.0), [](const Vec3& p) {
        return Vec3(60.0 * p.x() - 30.3, 60.0 * p.y() - 30.1, 2.0 * p.z() - 1.5);
    });
}

Outcome repaired(const Surface& surface, const std::string& bodies,
                 const std::string& wall = "lumen") {
    Scene scene;
    scene.surface = surface;
    Progress progress;
    const Operation& repair = find_operation("repair");
    return run_here(repair, scene, checked_arguments(repair, {{"bodies", bodies}, {"wall", wall}}),
                    progress);
}

std::size_t count_of(const Surface& surface) {
    return connected_components(*surface.topology).count();
}

bool warns(const Outcome& outcome, const std::string& code) {
    return std::ranges::count(outcome.warnings, code, &Diagnostic::code) > 0;
}

}  // namespace

SCENARIO("Closed bodies that overlap are united", "[workbench][bodies]") {
    const Surface both = merged(trunk(), branch());
    for (const std::string choice : {"vessel", "ask", "all"}) {
        CAPTURE(choice);
        const Outcome outcome = repaired(both, choice);
        const Surface& vessel = *outcome.scene.surface;
        CHECK(count_of(vessel) == 1);
        CHECK(is_closed_manifold(vessel));
        CHECK(volume(vessel) > volume(trunk()));
        CHECK(volume(vessel) < volume(trunk()) + volume(branch()));
        CHECK(bounds(vessel).max.x() == Approx(30.0));
        CHECK(warns(outcome, "bodies-united"));
        CHECK(outcome.report->at("united_bodies") == 1);
        CHECK_THAT(outcome.report->at("headline").get<std::string>(), Contains("united"));
    }
    THEN("one that is inside out is turned first") {
        const Outcome outcome = repaired(merged(trunk(), flipped(branch())), "vessel");
        CHECK(volume(*outcome.scene.surface) > volume(trunk()));
    }
    THEN("without the choice, the largest is kept, as ever") {
        const Outcome outcome = repaired(both, "largest");
        CHECK(area(*outcome.scene.surface) == Approx(area(trunk())));
        CHECK(warns(outcome, "vessel-removed"));
    }
    THEN("bodies beside each other are not united") {
        const Outcome outcome = repaired(merged(trunk(), moved(branch(), {10, 0, 0})), "vessel");
        CHECK_FALSE(warns(outcome, "bodies-united"));
        CHECK(area(*outcome.scene.surface) == Approx(area(trunk())));
    }
}

SCENARIO("The same body twice is one body", "[workbench][bodies]") {
    // Their walls coincide nearly, so that they cannot be united, and need not be.
    const Surface again = mapped(trunk(), [](const Vec3& p) {
        return Vec3(p + 2e-4 * Vec3(std::sin(40.0 * p.z()), std::sin(50.0 * p.x()), 0.0));
    });
    const Outcome outcome = repaired(merged(trunk(), again), "ask");
    CHECK(count_of(*outcome.scene.surface) == 1);
    CHECK(is_closed_manifold(*outcome.scene.surface));
    CHECK(volume(*outcome.scene.surface) == Approx(volume(trunk())).epsilon(0.01));
}

SCENARIO("A base plate is no vessel, however large it is", "[workbench][bodies]") {
    const Surface standing = merged(plate(), merged(trunk(), branch()));
    CHECK(area(plate()) > 3.0 * area(trunk()));
    THEN("it is asked about") {
        CHECK_THROWS_AS(repaired(standing, "ask"), UsageError);
        CHECK_THROWS_WITH(repaired(standing, "ask"), Contains("cannot be a vessel") &&
                                                         Contains("bodies=vessel") &&
                                                         Contains("bodies=all"));
    }
    THEN("it is left out, and said") {
        const Outcome outcome = repaired(standing, "vessel");
        CHECK(count_of(*outcome.scene.surface) == 1);
        CHECK(bounds(*outcome.scene.surface).min.x() == Approx(-4.0).margin(0.1));
        CHECK(bounds(*outcome.scene.surface).max.x() == Approx(30.0));
        CHECK(warns(outcome, "bodies-left-out"));
    }
    THEN("it is part of the model if wanted") {
        const Outcome outcome = repaired(standing, "all");
        CHECK(count_of(*outcome.scene.surface) == 1);
        CHECK(is_closed_manifold(*outcome.scene.surface));
        CHECK(volume(*outcome.scene.surface) > volume(plate()) + volume(trunk()));
    }
    THEN("beside the vessel it is asked about as well, if it is larger") {
        CHECK_THROWS_AS(repaired(merged(moved(plate(), {0, 0, -5}), trunk()), "ask"), UsageError);
        const Outcome outcome = repaired(merged(moved(plate(), {0, 0, -5}), trunk()), "vessel");
        CHECK(area(*outcome.scene.surface) == Approx(area(trunk())));
    }
}

SCENARIO("Of a wall with two sides nothing is united, and no cavity is called inside out",
         "[workbench][bodies]") {
    const Surface inner = moved(closed_tube(3.0, 38.0, 32, 40), {0, 0, 1});
    const Outcome outcome = repaired(merged(trunk(), flipped(inner)), "ask");
    CHECK(volume(*outcome.scene.surface) == Approx(volume(inner)));
    CHECK(warns(outcome, "outer-wall-removed"));
    CHECK_FALSE(warns(outcome, "bodies-united"));
    CHECK_FALSE(warns(outcome, "orientation-reversed"));
}

SCENARIO("Which side of a wall is the vessel is asked", "[workbench][bodies]") {
    const Surface inner = moved(closed_tube(3.0, 38.0, 32, 40), {0, 0, 1});
    for (const Surface& within : {inner, flipped(inner)}) {
        const Surface both = merged(trunk(), within);
        CHECK_THROWS_AS(repaired(both, "ask", "ask"), UsageError);
        CHECK_THROWS_WITH(repaired(both, "ask", "ask"), Contains("wall=lumen") &&
                                                            Contains("wall=outer") &&
                                                            !Contains("inside out"));
        const Outcome lumen = repaired(both, "ask", "lumen"),
                      outer = repaired(both, "ask", "outer");
        CHECK(volume(*lumen.scene.surface) == Approx(volume(inner)));
        CHECK(warns(lumen, "outer-wall-removed"));
        CHECK(volume(*outer.scene.surface) == Approx(volume(trunk())));
        CHECK(outer.warnings.empty());
    }
    THEN("a vessel alone, or a small body in it, is not asked about") {
        CHECK_NOTHROW(repaired(trunk(), "ask", "ask"));
        CHECK_NOTHROW(repaired(merged(trunk(), icosphere(1.0, 2, Vec3(0, 0, 20))), "ask", "ask"));
    }
}
