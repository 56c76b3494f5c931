// Smoothing that the view follows while the mouse, or typing, changes the form.

#include "workbench/window/features/live/live_smoothing.h"

#include <algorithm>

#include <catch2/catch.hpp>

#include "geometry/kernel/errors.h"
#include "tests/support/shapes.h"
#include "tests/window/walk_support.h"
#include "tests/window/window_support.h"
#include "workbench/operations/table.h"
#include "workbench/window/features/live/live_feature.h"
#include "workbench/window/keys/keys.h"

using namespace vesselbench;
using namespace vesselbench::test;
using namespace std::chrono_literals;

namespace {

const LiveSmoothing& live_of(Driver& window) {
    return window.app().place().live();
}

std::string text_in(Driver& window, const std::string& field) {
    return window.app().place().form()->field(field).text;
}

/// Waits until what is shown is what the operation would make.
bool wait_for_exact(Driver& window) {
    return window.run_until(
        [&] {
            const auto& shown = live_of(window).shown();
            return shown && !live_of(window).outdated() && shown->state.exact;
        },
        60s);
}

/// Moves the mouse with the right button held. \param wait between press and movement for the start
void drive(Driver& window, float right, float up) {
    const ScreenRect view = window.app().ui().items().at("view.area").rect;
    const float x = view.middle_x(), y = view.middle_y();
    window.move_mouse(x, y);
    window.press(MouseButton::Right);
    REQUIRE(window.run_until([&] { return live_of(window).shown() != nullptr; }, 60s));
    for (int i = 1; i <= 10; ++i)
        window.move_mouse(x + right * static_cast<float>(i) / 10,
                          y - up * static_cast<float>(i) / 10);
}

const std::vector<QualityCurve>& curves_of(const QualityAnalysis& quality) {
    return quality.answer()->analysis.curves;
}

void open_smooth(Driver& window) {
    open_file(window, tube_file(36));
    choose(window, "smoothing", "smooth");
}

bool has_message(Driver& window, const std::string& part) {
    return std::ranges::any_of(document_of(window).messages(), [&](const Message& message) {
        return message.text.find(part) != std::string::npos;
    });
}

/// Smooths by the mouse, and applies what is seen.
void smooth_live(Driver& window) {
    open_smooth(window);
    const ViewCamera camera = window.app().camera();
    drive(window, 40, 100);
    CHECK(text_in(window, "iterations") == "25");
    CHECK(text_in(window, "lambda") == "0.75");
    window.release(MouseButton::Right);
    REQUIRE(wait_for_exact(window));
    CHECK(window.app().camera() == camera);
    CHECK(window.has("banner.live"));
    const auto seen = live_of(window).shown();
    CHECK(seen->state.resolved.integer("iterations") == 25);
    CHECK(seen->state.surface.points() != document_of(window).current()->surface->points());
    CHECK(edit_count(window) == 1);
    apply_form(window);
    CHECK(edit_count(window) == 2);
    CHECK_FALSE(window.has("banner.live"));
    CHECK(document_of(window).shown()->surface->points() == seen->state.surface.points());
    CHECK_FALSE(has_message(window, "differs from the live preview"));
}

}  // namespace

SCENARIO("The right button smooths, and Apply enters what is seen", "[window][live]") {
    if (const auto window = window_on(Screen::None)) smooth_live(*window);
}

SCENARIO("The right button smooths on a display", "[window][live][walk][display]") {
    if (const auto window = window_on(Screen::Display)) smooth_live(*window);
}

SCENARIO("Who applies what was not shown yet is told how far it is from what was",
         "[window][live]") {
    const auto window = window_on(Screen::None);
    if (!window) return;
    open_smooth(*window);
    drive(*window, -40, 0);
    window->release(MouseButton::Right);
    REQUIRE(wait_for_exact(*window));
    const Positions seen = live_of(*window).shown()->state.surface.points();
    // Without a frame between them, nothing can be computed for the new value.
    Workplace& place = window->app().place();
    place.set_field("iterations", "60");
    place.apply();
    REQUIRE(window->wait_until_idle());
    REQUIRE(edit_count(*window) == 2);
    const Surface& applied = *document_of(*window).current()->surface;
    const std::string difference = difference_text(applied.with_positions(seen), applied);
    REQUIRE_FALSE(difference.empty());
    CHECK(has_message(*window, "The result differs from the live preview by " + difference));
}

SCENARIO("Escape during a drive brings back the fields and the model", "[window][live]") {
    const auto window = window_on(Screen::None);
    if (!window) return;
    open_smooth(*window);
    REQUIRE(window->fill_item("field.lambda", "0.3"));
    drive(*window, 40, 100);
    CHECK(text_in(*window, "lambda") == "0.55");
    window->press_key(keys::kEscape);
    CHECK(text_in(*window, "lambda") == "0.3");
    CHECK(text_in(*window, "iterations").empty());
    window->frame();
    CHECK_FALSE(live_of(*window).follows());
    CHECK_FALSE(live_of(*window).shown());
    THEN("the rest of the drag does nothing") {
        window->move_mouse(500, 300);
        window->release(MouseButton::Right);
        CHECK(text_in(*window, "lambda") == "0.3");
        CHECK_FALSE(live_of(*window).follows());
    }
    THEN("the form stays, and the next drive works") {
        window->release(MouseButton::Right);
        drive(*window, 0, 100);
        CHECK(text_in(*window, "lambda") == "0.55");
        window->release(MouseButton::Right);
        CHECK(live_of(*window).follows());
        AND_THEN("Escape takes it back, once more leaves the form") {
            window->press_key(keys::kEscape);
            window->frame();
            CHECK(text_in(*window, "lambda") == "0.3");
            CHECK_FALSE(live_of(*window).follows());
            window->press_key(keys::kEscape);
            window->frame();
            CHECK_FALSE(window->app().place().form());
            CHECK_FALSE(live_of(*window).shown());
            REQUIRE(window->settle());
            CHECK_FALSE(window->has("banner.live"));
        }
        AND_THEN("Escape takes nothing back after another value was entered") {
            window->app().place().set_field("iterations", "7");
            window->press_key(keys::kEscape);
            window->frame();
            CHECK_FALSE(window->app().place().form());
        }
    }
}

SCENARIO("While it follows, typed values are followed, too", "[window][live]") {
    const auto window = window_on(Screen::None);
    if (!window) return;
    open_smooth(*window);
    REQUIRE(window->click_item("form.live"));
    REQUIRE(window->click_item("live.follow"));
    REQUIRE(wait_for_exact(*window));
    const auto first = live_of(*window).shown();
    REQUIRE(window->click_item("form.fields"));
    REQUIRE(window->fill_item("field.iterations", "3"));
    REQUIRE(wait_for_exact(*window));
    CHECK(live_of(*window).shown()->state.iterations == 3);
    THEN("an error in the form keeps the last model, and does not stop it") {
        REQUIRE(window->fill_item("field.iterations", "x"));
        window->frame();
        CHECK(live_of(*window).shown());
        REQUIRE(window->fill_item("field.iterations", "5"));
        REQUIRE(wait_for_exact(*window));
        CHECK(live_of(*window).shown()->state.iterations == 5);
    }
    THEN("the colours follow") {
        for (const ColouringKind kind : {ColouringKind::Deviation, ColouringKind::MeanCurvature,
                                         ColouringKind::TriangleQuality}) {
            window->app().place().view.choose(kind);
            window->frame();
            REQUIRE(wait_for_exact(*window));
            const auto shown = live_of(*window).shown();
            const std::size_t count = shown->state.surface.vertex_count();
            const auto& values = kind == ColouringKind::Deviation ? shown->deviation->values
                                                                  : shown->colours->values;
            CHECK(values.size() == count);
        }
    }
    THEN("a preview by the operation itself takes its place until a field changes") {
        REQUIRE(window->click_item("operation.preview"));
        REQUIRE(window->wait_until_idle());
        REQUIRE(document_of(*window).previewed());
        window->frame();
        CHECK_FALSE(live_of(*window).shown());
        REQUIRE(window->fill_item("field.iterations", "4"));
        REQUIRE(wait_for_exact(*window));
    }
    THEN("a case that is closed ends it") {
        window->app().place().close();
        REQUIRE(window->settle());
        CHECK_FALSE(live_of(*window).shown());
    }
}

SCENARIO("The worst places are those of the model that is smoothed live", "[window][live]") {
    const auto window = window_on(Screen::None);
    if (!window) return;
    open_smooth(*window);
    Workplace& place = window->app().place();
    place.view.choose(ColouringKind::Deviation);
    drive(*window, 40, 100);
    window->release(MouseButton::Right);
    REQUIRE(wait_for_exact(*window));
    window->press_key(keys::letter('X'));
    REQUIRE(place.looked_at());
    const LiveModel& shown = *live_of(*window).shown();
    const auto& values = shown.deviation->values;
    const auto worst = static_cast<std::size_t>(
        std::ranges::max_element(values, {}, [](double d) { return std::abs(d); }) -
        values.begin());
    CHECK(*place.looked_at() == shown.state.surface.points()[worst]);
    CHECK(has_message(*window, "worst place 1 of"));
    window->press_key(keys::letter('X'));
    CHECK(has_message(*window, "worst place 2 of"));
    THEN("another model has its own") {
        place.set_field("iterations", "3");
        REQUIRE(wait_for_exact(*window));
        window->press_key(keys::letter('X'));
        const auto& points = live_of(*window).shown()->state.surface.points();
        CHECK(std::ranges::count(points, *place.looked_at()) == 1);
    }
    THEN("colours that do not follow it have none") {
        place.view.choose(ColouringKind::LocalRadius);
        REQUIRE(wait_for_exact(*window));
        window->press_key(keys::letter('X'));
        CHECK(has_message(*window, "do not follow the model"));
    }
}

SCENARIO("The right button does nothing elsewhere", "[window][live]") {
    const auto window = window_on(Screen::None);
    if (!window) return;
    open_file(*window, tube_file());
    const ViewCamera camera = window->app().camera();
    const auto right_drag = [&] {
        const ScreenRect view = window->app().ui().items().at("view.area").rect;
        window->drag(view.middle_x(), view.middle_y(), view.middle_x() + 60, view.middle_y(),
                     MouseButton::Right);
        window->frame();
        CHECK(window->app().camera() == camera);
        CHECK_FALSE(live_of(*window).follows());
    };
    right_drag();
    choose(*window, "source", "repair");
    right_drag();
}

SCENARIO("Newer questions end older ones, and no old answer follows", "[window][live]") {
    Scene scene;
    scene.surface = fine_tube(4.0, 30.0, 60);
    LiveModels models(
        {}, live_modelling({.source = []() -> HeldDevice { throw GpuUnavailable("not here"); }}));
    const auto ask_for = [&](std::int64_t iterations, int base) {
        const auto arguments =
            checked_arguments(find_operation("smooth"), {{"iterations", iterations}});
        return ask(models, LiveQuestion{scene, base, arguments});
    };
    std::uint64_t last = 0, seen = 0;
    for (int i = 0; i < 60; ++i) {
        last = ask_for(i, i / 20);
        std::this_thread::sleep_for(1ms);
        if (!models.poll()) continue;
        REQUIRE(models.newest()->question >= seen);
        seen = models.newest()->question;
    }
    while (models.pending()) {
        std::this_thread::sleep_for(1ms);
        static_cast<void>(models.poll());
    }
    CHECK(models.newest()->question == last);
    CHECK(models.newest()->state.exact);
    CHECK(models.newest()->state.iterations == 59);
    models.forget();
    CHECK_FALSE(models.newest());
}

SCENARIO("Live colours show the staircase weights of the question", "[window][live]") {
    // A cylinder whose radius jumps: the step is a staircase of the stack along z.
    const auto stepped = [](const Vec3& p) {
        const double factor = p.z() < 15 ? 1.0 : 1.5;
        return Vec3(factor * p.x(), factor * p.y(), p.z());
    };
    Scene scene;
    scene.surface = mapped(fine_tube(4.0, 30.0, 36), stepped);
    scene.sampling = Sampling{.spacing = {0.5, 0.5, 1.0}, .confidence = 1.0};
    LiveModels models(
        {}, live_modelling({.source = []() -> HeldDevice { throw GpuUnavailable("not here"); }}));
    for (const double least : {0.0, 0.25}) {
        const auto arguments =
            checked_arguments(find_operation("smooth"), {{"staircase", true}, {"beta_min", least}});
        const auto question =
            ask(models, LiveQuestion{scene, 1, arguments, ColouringKind::StaircaseWeight});
        const auto answered = [&] {
            static_cast<void>(models.poll());
            return models.newest() && models.newest()->question == question && !models.pending();
        };
        while (!answered()) std::this_thread::sleep_for(1ms);
        REQUIRE(models.newest()->colours);
        const std::vector<double>& weights = models.newest()->colours->values;
        REQUIRE(weights.size() == scene.surface->vertex_count());
        double at_step = 0.0, away = 0.0;
        for (VertexId v = 0; v < weights.size(); ++v) {
            const double z = scene.surface->points()[v].z();
            if (std::abs(z - 15) < 1.0) at_step = std::max(at_step, weights[v]);
            if (z > 3 && z < 8) away = std::max(away, weights[v]);
        }
        CHECK(at_step == 1.0);
        CHECK(away == least);
    }
}

SCENARIO("A difference is told if it is more than rounding", "[window][live]") {
    const Surface tube = fine_tube(4.0, 30.0, 24);
    Positions moved = tube.points();
    moved[5].x() += 1e-4;
    CHECK(difference_text(tube, tube.with_positions(moved)).empty());
    moved[5].x() += 0.2;
    CHECK(difference_text(tube, tube.with_positions(moved)) == "up to 0.2 mm");
}

SCENARIO("Graphs and suggestions come with the live part of the form", "[window][live]") {
    const auto window = window_on(Screen::None);
    if (!window) return;
    open_smooth(*window);
    REQUIRE(window->click_item("form.live"));
    const QualityAnalysis& quality = window->app().place().quality();
    REQUIRE(window->run_until(
        [&] { return quality.answer() != nullptr && quality.answer()->complete; }, 120s));
    CHECK_FALSE(document_of(*window).activity());
    const auto& curves = quality.answer()->analysis.curves;
    REQUIRE(curves.size() == 4);
    THEN("a press in a graph sets the value, and the model follows") {
        REQUIRE(window->reveal("quality.graph.lambda"));
        const ScreenRect graph = window->app().ui().items().at("quality.graph.lambda").rect;
        window->move_mouse(graph.x + 0.25F * graph.width, graph.middle_y());
        window->press(MouseButton::Left);
        window->frame();
        CHECK(number_of(*window->app().place().form(), "lambda") == Approx(0.25).margin(0.011));
        window->move_mouse(graph.x + 0.75F * graph.width, graph.middle_y());
        CHECK(number_of(*window->app().place().form(), "lambda") == Approx(0.75).margin(0.011));
        AND_THEN("Escape brings back what was there") {
            window->press_key(keys::kEscape);
            window->release(MouseButton::Left);
            CHECK(text_in(*window, "lambda").empty());
        }
        AND_THEN("a release keeps it") {
            window->release(MouseButton::Left);
            window->frame();
            CHECK(number_of(*window->app().place().form(), "lambda") == Approx(0.75).margin(0.011));
            REQUIRE(wait_for_exact(*window));
            REQUIRE(window->run_until([&] { return quality.answer()->complete; }, 120s));
        }
    }
    THEN("its suggestion sets the value") {
        const double suggested = curves.front().suggested;
        REQUIRE(window->click_item("quality.suggest." + curves.front().name));
        CHECK(number_of(*window->app().place().form(), curves.front().name) ==
              Approx(suggested).margin(1e-3));
    }
    THEN("the best of all fills in what it searches") {
        REQUIRE(quality.answer()->best);
        const Arguments best = *quality.answer()->best;
        REQUIRE(window->click_item("quality.best"));
        for (const auto& [name, value] : best.values())
            CHECK(number_of(*window->app().place().form(), name) ==
                  Approx(best.real(name)).margin(1e-3));
        CHECK(live_of(*window).follows());
    }
    THEN("a higher target smoothness does not suggest to smooth less") {
        const auto best_score = [&] { return quality.answer()->best->integer("iterations"); };
        REQUIRE(window->click_item("quality.little"));
        REQUIRE(window->run_until([&] { return !quality.pending(); }, 120s));
        const auto little = best_score();
        REQUIRE(window->click_item("quality.strong"));
        REQUIRE(window->run_until([&] { return !quality.pending(); }, 120s));
        CHECK(best_score() >= little);
    }
    THEN("bars set values as well, in either order") {
        for (const char* order : {"Bars by parameter", "Bars by measure"}) {
            REQUIRE(window->fill_item("quality.view", order));
            REQUIRE(window->reveal("quality.bar.iterations.error"));
            const ScreenRect bar =
                window->app().ui().items().at("quality.bar.iterations.error").rect;
            window->click(bar.x + 0.6F * bar.width, bar.middle_y());
            CHECK(number_of(*window->app().place().form(), "iterations") == Approx(60).margin(1));
        }
    }
    THEN("suggestions follow a drive, and the analysis goes on afterwards") {
        drive(*window, 40, 0);
        REQUIRE(window->run_until(
            [&] { return curves_of(quality).back().current == 25 && quality.answer()->best; },
            120s));
        CHECK(window->app().place().get<LiveFeature>().is_driving());
        CHECK_FALSE(quality.answer()->complete);
        const double fewer = curves_of(quality).front().suggested;
        // The longer it smooths, the less of it is suggested.
        const ScreenRect view = window->app().ui().items().at("view.area").rect;
        window->move_mouse(view.middle_x() + 120, view.middle_y());
        REQUIRE(window->run_until([&] { return curves_of(quality).back().current == 35; }, 120s));
        CHECK(window->app().place().get<LiveFeature>().is_driving());
        CHECK(curves_of(quality).front().suggested <= fewer);
        window->move_mouse(view.middle_x() + 40, view.middle_y());
        window->release(MouseButton::Right);
        REQUIRE(window->run_until([&] { return !quality.pending() && quality.answer()->complete; },
                                  120s));
        CHECK(quality.answer()->analysis.curves.back().current == 25);
    }
}
