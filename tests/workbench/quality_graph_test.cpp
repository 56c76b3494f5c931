#include "workbench/report/quality_graph.h"

#include <limits>

#include <catch2/catch.hpp>

using namespace vesselbench;

namespace {

/// A curve over 0 to 4 whose middle value has no measures.
QualityCurve interrupted_curve() {
    QualityCurve curve{.name = "alpha", .unit = "", .points = {}};
    for (int i = 0; i <= 4; ++i) {
        CurvePoint point;
        point.value = i;
        point.scaled.error = 0.25 * i;
        if (i != 2) point.measures = QualityMeasures{};
        curve.points.push_back(point);
    }
    curve.most = 4.0;
    return curve;
}

constexpr GraphFrame kFrame = {100.0, 20.0, 200.0, 50.0, 0.0, 4.0, 0.5};

}  // namespace

SCENARIO("A graph's frame maps values to the page and back", "[workbench][graphs]") {
    CHECK(kFrame.x(1.0) == Approx(150.0));
    CHECK(kFrame.value(150.0) == Approx(1.0));
    CHECK(kFrame.y(0.0) == Approx(70.0));
    CHECK(kFrame.y(0.25) == Approx(45.0));
    THEN("what lies beyond is drawn at the frame's sides") {
        CHECK(kFrame.x(9.0) == Approx(300.0));
        CHECK(kFrame.value(0.0) == Approx(0.0));
        CHECK(kFrame.y(2.0) == Approx(20.0));
    }
    THEN("a single value lies in the middle") {
        const GraphFrame single = {100.0, 20.0, 200.0, 50.0, 3.0, 3.0, 1.0};
        CHECK(single.x(3.0) == Approx(200.0));
    }
}

SCENARIO("A value without measures interrupts a curve, and is left out of a bar",
         "[workbench][graphs]") {
    const QualityCurve curve = interrupted_curve();
    const auto lines =
        graph_lines(curve, kFrame, [](const CurvePoint& point) { return point.scaled.error; });
    REQUIRE(lines.size() == 2);
    CHECK(lines[0].size() == 2);
    CHECK(lines[1].front().x == Approx(250.0));
    CHECK(lines[1].front().y == Approx(20.0));  // 0.75 is above the top

    const double none = std::numeric_limits<double>::quiet_NaN();
    const QualityBar bar{.goodness = {0.0, 0.5, none, 0.5, 1.0}};
    const auto fields = bar_fields(curve, bar, kFrame);
    REQUIRE(fields.size() == 5);
    CHECK(fields.front().left == Approx(kFrame.left));
    CHECK(fields.back().right == Approx(kFrame.right()));
    for (std::size_t i = 0; i + 1 < fields.size(); ++i)
        CHECK(fields[i].right == fields[i + 1].left);
    CHECK(fields[0].right == Approx(kFrame.x(0.5)));
    CHECK_FALSE(fields[2].colour);
    CHECK(*fields[4].colour == PixelColour{255, 255, 255});
}

SCENARIO("Ticks are round and lie on the axis", "[workbench][graphs]") {
    const std::vector<double> ticks = axis_ticks(0.0, 1.0, 5);
    REQUIRE(ticks.size() == 6);
    for (std::size_t i = 0; i < ticks.size(); ++i)
        CHECK(ticks[i] == Approx(0.2 * static_cast<double>(i)));
    CHECK(axis_ticks(3.0, 3.0, 5) == std::vector<double>{3.0});
    for (const double tick : axis_ticks(-0.7, 12.3, 5)) {
        CHECK(tick >= -0.7);
        CHECK(tick <= 12.3);
    }
}
