#include "workbench/window/case/stroke.h"

#include <catch2/catch.hpp>

#include "tests/support/shapes.h"
#include "workbench/operations/table.h"
#include "workbench/window/case/live_stroke.h"
#include "workbench/window/features/brush/brush_form.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

StrokePlace at(double x, const Vec3& normal = Vec3::UnitZ()) {
    return {.point = {x, 0, 0}, .normal = normal};
}

using State = Stroke::State;

}  // namespace

SCENARIO("Dabs of a stroke are a quarter of the radius apart", "[window][stroke]") {
    Stroke stroke;
    stroke.begin(4.0);
    CHECK(stroke.state() == State::Deciding);
    const auto first = stroke.extend(at(0));
    CHECK(stroke.state() == State::Painting);
    REQUIRE(first.size() == 1);
    CHECK_FALSE(first[0].between);
    CHECK(stroke.extend(at(0.6)).empty());
    const auto more = stroke.extend(at(2.3));
    REQUIRE(more.size() == 2);
    CHECK(more[0].point.x() == Approx(1.0));
    CHECK(more[1].point.x() == Approx(2.0));
    CHECK(more[0].between);
    CHECK(stroke.extend(at(3.0)).size() == 1);
    stroke.end();
    CHECK(stroke.state() == State::Idle);
    CHECK(stroke.extend(at(9)).empty());
}

SCENARIO("A drag that begins beside the surface turns the view", "[window][stroke]") {
    Stroke stroke;
    stroke.begin(1.0);
    CHECK(stroke.extend(std::nullopt).empty());
    CHECK(stroke.state() == State::Turning);
    CHECK(stroke.extend(at(0)).empty());
}

SCENARIO("The background and other parts interrupt a stroke", "[window][stroke]") {
    Stroke stroke;
    stroke.begin(4.0);
    REQUIRE(stroke.extend(at(0)).size() == 1);
    SECTION("the background") {
        CHECK(stroke.extend(std::nullopt).empty());
        CHECK(stroke.state() == State::Painting);
        const auto again = stroke.extend(at(10));
        REQUIRE(again.size() == 1);
        CHECK(again[0].point.x() == 10);
    }
    SECTION("a part that faces elsewhere") {
        CHECK(stroke.extend(at(10, Vec3::UnitX())).size() == 1);
    }
}

SCENARIO("A cancelled stroke paints nothing more until the button goes down", "[window][stroke]") {
    Stroke stroke;
    stroke.cancel();
    CHECK(stroke.state() == State::Idle);
    stroke.begin(4.0);
    REQUIRE(stroke.extend(at(0)).size() == 1);
    stroke.cancel();
    CHECK(stroke.extend(at(5)).empty());
    CHECK(stroke.state() == State::Dropped);
    stroke.begin(4.0);
    CHECK(stroke.extend(at(5)).size() == 1);
}

SCENARIO("Keys change radius and strength within their limits", "[window][stroke]") {
    const BrushTip tip{1.0, 0.5};
    CHECK(after_key(tip, BrushKey::Larger) == BrushTip{1.2, 0.5});
    CHECK(after_key(tip, BrushKey::Smaller) == BrushTip{0.833, 0.5});
    CHECK(after_key(tip, BrushKey::Stronger) == BrushTip{1.0, 0.55});
    CHECK(after_key(tip, BrushKey::Weaker) == BrushTip{1.0, 0.45});
    CHECK(after_key({1.0, -0.5}, BrushKey::Stronger) == BrushTip{1.0, -0.55});
    CHECK(after_key({1.0, 1.0}, BrushKey::Stronger).strength == 1.0);
    CHECK(after_key({1.0, 0.05}, BrushKey::Weaker).strength == 0.05);
    CHECK(after_key({100.0, 0.5}, BrushKey::Larger).radius == 100.0);
    CHECK(after_key({0.01, 0.5}, BrushKey::Smaller).radius == 0.01);
}

SCENARIO("A form of a brush says what a stroke does", "[window][stroke]") {
    CHECK(is_brush(find_operation("brush-weight")));
    CHECK_FALSE(is_brush(find_operation("smooth")));
    OperationForm form(find_operation("brush-inflate"));
    set_tip(form, {2.5, 0.4});
    CHECK(form.valid());
    CHECK(form.field("radius").text == "2.5");
    const BrushTip tip = tip_of(form, {});
    CHECK(tip == BrushTip{2.5, 0.4});
    CHECK(stroke_of(form, tip, {}).strength == 0.4);
    CHECK(stroke_of(form, tip, {.invert = true}).strength == -0.4);
    const StrokeRequest smoothing = stroke_of(form, tip, {.smooth = true, .invert = true});
    CHECK(smoothing.operation == "brush-smooth");
    CHECK(smoothing.strength == 0.4);
    CHECK(painted_attribute(form).empty());
    WHEN("a field that lasts through the stroke is given") {
        OperationForm weights(find_operation("brush-weight"));
        weights.set("attribute", "plaque");
        CHECK(painted_attribute(weights) == "plaque");
        CHECK(stroke_of(weights, tip, {}).given == Arguments{{"attribute", "plaque"}});
    }
}
