// Quality graphs and suggestions of forms that change triangles, while they are looked at.

#include <algorithm>

#include <catch2/catch.hpp>

#include "tests/support/program.h"
#include "tests/support/shapes.h"
#include "tests/window/walk_support.h"
#include "tests/window/window_support.h"
#include "workbench/window/keys/keys.h"

using namespace vesselbench;
using namespace vesselbench::test;
using namespace std::chrono_literals;
using Catch::Matchers::Contains;

namespace {

const QualityAnalysis& quality_of(Driver& window) {
    return window.app().place().quality();
}

QualityCurve curve_of(Driver& window, const std::string& name) {
    REQUIRE(quality_of(window).answer() != nullptr);
    const auto& curves = quality_of(window).answer()->analysis.curves;
    const auto found = std::ranges::find(curves, name, &QualityCurve::name);
    REQUIRE(found != curves.end());
    return *found;
}

std::optional<double> number_in(Driver& window, const std::string& field) {
    return number_of(*window.app().place().form(), field);
}

std::string text_in(Driver& window, const std::string& field) {
    return window.app().place().form()->field(field).text;
}

/// Waits until the newest answer is complete.
[[nodiscard]] bool wait_for_answer(Driver& window) {
    return window.run_until(
        [&] {
            const QualityAnalysis& quality = quality_of(window);
            return !quality.pending() && quality.answer() != nullptr && quality.answer()->complete;
        },
        120s);
}

/// A form of the step of remeshing, with its graphs.
void open_graphs(Driver& window, const std::string& operation, int around = 24) {
    open_file(window, tube_file(around));
    choose(window, "remeshing", operation);
    REQUIRE(window.click_item("form.live"));
}

/// The place of a share of a graph's width.
Eigen::Vector2f place_in(Driver& window, const std::string& parameter, float share) {
    REQUIRE(window.reveal("quality.graph." + parameter));
    const ScreenRect graph = window.app().ui().items().at("quality.graph." + parameter).rect;
    return {graph.x + std::clamp(share, 0.005F, 0.995F) * graph.width, graph.middle_y()};
}

std::size_t triangles_of(Driver& window) {
    return document_of(window).current()->surface->triangle_count();
}

/// Sets a decimation by its graph, and applies it.
void decimate_by_graph(Driver& window) {
    open_graphs(window, "decimate");
    REQUIRE(wait_for_answer(window));
    CHECK(curve_of(window, "share").current == 0.5);
    CHECK(curve_of(window, "share").points.size() == 21);
    CHECK(edit_count(window) == 1);
    const auto from = place_in(window, "share", 0.5F), to = place_in(window, "share", 0.25F);
    window.drag(from.x(), from.y(), to.x(), to.y());
    const auto share = number_in(window, "share");
    REQUIRE(share);
    CHECK(*share == Approx(0.265).margin(0.011));
    REQUIRE(wait_for_answer(window));
    CHECK(curve_of(window, "share").current == *share);
    const auto before = static_cast<double>(triangles_of(window));
    apply_form(window);
    CHECK(static_cast<double>(triangles_of(window)) == Approx(*share * before).margin(4.0));
    CHECK_FALSE(quality_of(window).answer());
}

}  // namespace

SCENARIO("A share is dragged in the graph of a decimation, and applied", "[window][live]") {
    if (const auto window = window_on(Screen::None)) decimate_by_graph(*window);
}

SCENARIO("A share is dragged in a graph on a display", "[window][live][walk][display]") {
    if (const auto window = window_on(Screen::Display)) decimate_by_graph(*window);
}

SCENARIO("The graph of a decimation sets its share", "[window][live]") {
    const auto window = window_on(Screen::None);
    if (!window) return;
    open_graphs(*window, "decimate");
    REQUIRE(wait_for_answer(*window));
    THEN("Escape during a drag brings back what was there, and the form stays") {
        const auto at = place_in(*window, "share", 0.3F);
        window->move_mouse(at.x(), at.y());
        window->press(MouseButton::Left);
        window->frame();
        CHECK(number_in(*window, "share") == Approx(0.314).margin(0.011));
        REQUIRE(window->run_until(
            [&] { return curve_of(*window, "share").current == number_in(*window, "share"); },
            60s));
        CHECK_FALSE(quality_of(*window).answer()->complete);
        window->press_key(keys::kEscape);
        window->release(MouseButton::Left);
        window->frame();
        CHECK(text_in(*window, "share").empty());
        CHECK(window->app().place().form());
    }
    THEN("Escape afterwards takes the drag back, and leaves the form only then") {
        const auto at = place_in(*window, "share", 0.3F);
        window->click(at.x(), at.y());
        CHECK(number_in(*window, "share"));
        window->press_key(keys::kEscape);
        window->frame();
        CHECK(text_in(*window, "share").empty());
        CHECK(window->app().place().form());
        window->press_key(keys::kEscape);
        window->frame();
        CHECK_FALSE(window->app().place().form());
    }
    THEN("its suggestion is taken with a click") {
        const double suggested = curve_of(*window, "share").suggested;
        REQUIRE(window->click_item("quality.suggest.share"));
        CHECK(number_in(*window, "share") == Approx(suggested).margin(1e-3));
    }
    THEN("a target of few triangles suggests fewer, and the best of all fills them in") {
        REQUIRE(window->click_item("quality.little"));
        REQUIRE(wait_for_answer(*window));
        const double little = curve_of(*window, "share").suggested;
        REQUIRE(window->click_item("quality.strong"));
        REQUIRE(wait_for_answer(*window));
        const double strong = curve_of(*window, "share").suggested;
        CHECK(strong < little);
        REQUIRE(window->click_item("quality.best"));
        CHECK(number_in(*window, "share") == Approx(strong).margin(1e-3));
    }
    THEN("bars set it as well") {
        REQUIRE(window->fill_item("quality.view", "Bars by measure"));
        CHECK_FALSE(window->has("quality.bar.share.curvature"));
        REQUIRE(window->reveal("quality.bar.share.skewness"));
        const ScreenRect bar = window->app().ui().items().at("quality.bar.share.skewness").rect;
        window->click(bar.x + 0.6F * bar.width, bar.middle_y());
        CHECK(number_in(*window, "share") == Approx(0.61).margin(0.011));
    }
    THEN("a number of triangles, which replaces it, is named as the reason for no graphs") {
        REQUIRE(window->click_item("form.fields"));
        REQUIRE(window->fill_item("field.triangles", "300"));
        REQUIRE(window->click_item("form.live"));
        REQUIRE(window->run_until([&] { return !quality_of(*window).problem().empty(); }, 60s));
        CHECK_THAT(quality_of(*window).problem(), Contains("triangles cannot be given"));
        REQUIRE(window->click_item("form.fields"));
        REQUIRE(window->fill_item("field.triangles", ""));
        REQUIRE(window->click_item("form.live"));
        REQUIRE(wait_for_answer(*window));
    }
}

SCENARIO("The graphs of a remeshing set edge and gradation", "[window][live]") {
    const auto window = window_on(Screen::None);
    if (!window) return;
    open_graphs(*window, "remesh");
    REQUIRE(wait_for_answer(*window));
    REQUIRE(quality_of(*window).answer()->analysis.curves.size() == 2);
    const QualityCurve edge = curve_of(*window, "edge");
    CHECK(edge.unit == "mm");
    CHECK(edge.current > edge.points.front().value);
    CHECK(edge.current < edge.points.back().value);
    const auto at = place_in(*window, "edge", 1.0F);
    window->click(at.x(), at.y());
    CHECK(number_in(*window, "edge") == Approx(edge.points.back().value).epsilon(0.01));
    const auto other = place_in(*window, "gradation", 0.0F);
    window->click(other.x(), other.y());
    CHECK(number_in(*window, "gradation") == Approx(1.1).margin(0.02));
    REQUIRE(wait_for_answer(*window));
    CHECK(curve_of(*window, "edge").current == *number_in(*window, "edge"));
    CHECK(curve_of(*window, "gradation").current == *number_in(*window, "gradation"));
    THEN("what the curve says of the chosen values is what the operation makes") {
        const auto points = curve_of(*window, "edge").points;
        const auto now = std::ranges::find(points, *number_in(*window, "edge"), &CurvePoint::value);
        REQUIRE(now != points.end());
        const double promised = now->measures->triangles;
        apply_form(*window);
        CHECK(static_cast<double>(triangles_of(*window)) == promised);
    }
}

SCENARIO("A surface that no subdivision makes better is left as it is", "[window][live]") {
    const auto window = window_on(Screen::None);
    if (!window) return;
    open_graphs(*window, "subdivide");
    REQUIRE(window->click_item("quality.little"));
    REQUIRE(wait_for_answer(*window));
    const QualityCurve curve = curve_of(*window, "iterations");
    REQUIRE(std::ranges::all_of(
        curve.points, [](const CurvePoint& point) { return point.measures.has_value(); }));
    CHECK(curve.points.front().value == 0.0);
    CHECK(curve.points.back().measures->triangles >
          10.0 * static_cast<double>(triangles_of(*window)));
    const auto low = place_in(*window, "iterations", 0.0F);
    window->click(low.x(), low.y());
    CHECK(text_in(*window, "iterations") == "1");  // 0 is no subdivision
    const auto high = place_in(*window, "iterations", 0.68F);
    window->click(high.x(), high.y());
    CHECK(text_in(*window, "iterations") == "2");
    if (quality_of(*window).answer()->leave_as_is) CHECK_FALSE(window->is_enabled("quality.best"));
}

SCENARIO("Graphs of a large surface are interrupted at once", "[window][live]") {
    const auto window = window_on(Screen::None);
    if (!window) return;
    open_graphs(*window, "remesh", 120);
    // The first values are seen while the others are measured.
    REQUIRE(window->run_until([&] { return quality_of(*window).answer() != nullptr; }, 120s));
    REQUIRE(quality_of(*window).pending());
    CHECK_FALSE(quality_of(*window).answer()->complete);
    THEN("a newer value takes over") {
        REQUIRE(window->click_item("form.fields"));
        REQUIRE(window->fill_item("field.edge", "2.5"));
        // Nobody looks at them.
        REQUIRE(window->run_until([&] { return !quality_of(*window).pending(); }, 10s));
        REQUIRE(window->click_item("form.live"));
        REQUIRE(window->run_until([&] { return curve_of(*window, "edge").current == 2.5; }, 120s));
        CHECK_FALSE(quality_of(*window).answer()->complete);
    }
    THEN("leaving the form ends them") {
        window->app().place().leave_form();
        window->frame();
        CHECK_FALSE(quality_of(*window).answer());
        CHECK(window->run_until([&] { return !quality_of(*window).pending(); }, 10s));
    }
    THEN("another form begins its own") {
        window->app().place().choose("decimate");
        window->frame();
        CHECK_FALSE(quality_of(*window).answer());
        REQUIRE(window->run_until([&] { return quality_of(*window).answer() != nullptr; }, 120s));
        CHECK(curve_of(*window, "share").name == "share");
    }
    THEN("a preview comes first, and they go on afterwards") {
        REQUIRE(window->click_item("operation.preview"));
        CHECK(window->run_until([&] { return !quality_of(*window).pending(); }, 10s));
        REQUIRE(window->wait_until_idle());
        CHECK(document_of(*window).previewed());
        window->frame();
        CHECK(window->run_until([&] { return quality_of(*window).pending(); }, 10s));
    }
    THEN("closing the case ends them") {
        window->app().place().close();
        REQUIRE(window->settle());
        CHECK_FALSE(quality_of(*window).answer());
    }
}

SCENARIO("An earlier edit that is changed has the graphs of what it runs on", "[window][live]") {
    const auto window = window_on(Screen::None);
    if (!window) return;
    open_graphs(*window, "decimate");
    REQUIRE(wait_for_answer(*window));
    const std::size_t before = triangles_of(*window);
    apply_form(*window);
    CHECK(triangles_of(*window) < before);
    window->app().place().choose_edit(document_of(*window).snapshot()->log.back().edit.edit.id);
    REQUIRE(window->settle());
    CHECK(triangles_of(*window) == before);
    CHECK(quality_of(*window).can_analyse());
    REQUIRE(wait_for_answer(*window));
}
