#include "geometry/vessel/openings/planned_cut.h"

#include <catch2/catch.hpp>

#include "geometry/vessel/centerlines/centerlines.h"
#include "geometry/vessel/openings/openings.h"
#include "tests/support/shapes.h"

using namespace vesselbench;
using namespace vesselbench::test;

SCENARIO("A planned cut is where the opening is made", "[geometry][openings]") {
    const Surface tube = fine_tube(4, 30, 48);
    const Vec3 tip(0, 0, 30);
    GIVEN("a distance in radii") {
        const Cut cut = find_cut(tube, {.tip = tip, .radii = 2.5}, nullptr);
        REQUIRE(cut.problem.empty());
        const OpeningPlan plan =
            plan_openings(tube, *lines_for_openings(tube, tip), {.tip = tip, .radii = 2.5});
        const OpeningPlace& place = plan.openings.at(0).place;
        CHECK((cut.plane.point - place.plane.point).norm() < 1e-9);
        CHECK((cut.plane.normal - place.plane.normal).norm() < 1e-9);
        CHECK(cut.diameter == Approx(place.diameter));
        CHECK(cut.branch->patch->name == "outlet_1");
    }
    GIVEN("a plane") {
        const Plane plane{.point = {0, 0, 12}, .normal = {0, 0, 1}};
        const Cut cut = find_cut(tube, {.tip = tip, .plane = plane}, nullptr);
        CHECK(cut.plane.point == plane.point);
        CHECK(cut.distance == Approx(18).margin(0.1));
        THEN("the branch is used again for another one") {
            const Cut other = find_cut(tube, {.tip = tip, .distance = 5.0}, cut.branch);
            CHECK(other.branch == cut.branch);
        }
    }
    GIVEN("a tip that no vessel has") {
        const Cut cut = find_cut(tube, {.tip = Vec3(0, 0, 90), .distance = 5.0}, nullptr);
        CHECK_FALSE(cut.problem.empty());
        CHECK(cut.ring.empty());
    }
}
