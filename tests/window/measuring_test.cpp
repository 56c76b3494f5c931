#include <cmath>

#include <catch2/catch.hpp>

#include "geometry/vessel/centerlines/centerlines.h"
#include "tests/support/shapes.h"
#include "workbench/window/view/overlay_layers.h"

using namespace vesselbench;
using namespace vesselbench::test;

SCENARIO("Circles of the local radius are drawn along the centerline", "[window][measuring]") {
    const auto graph = centerlines_of(fine_tube(4, 30, 36));
    const auto drawing = centerline_drawing(*graph);
    REQUIRE(drawing.size() > 5);
    CHECK_FALSE(drawing[0].closed);
    CHECK(drawing[0].points.size() == graph->branches[0].points.size());
    for (std::size_t i = 1; i < drawing.size(); ++i) {
        REQUIRE(drawing[i].closed);
        const Vec3& point = drawing[i].points[0];
        if (point.z() > 5 && point.z() < 25)
            CHECK(std::hypot(point.x(), point.y()) == Approx(4).epsilon(0.03));
    }
}
