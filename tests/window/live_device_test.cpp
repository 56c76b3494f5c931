// Live smoothing on the device, which tests use even where it is slower than the CPU.

#include <algorithm>
#include <atomic>
#include <optional>

#include <catch2/catch.hpp>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/measure.h"
#include "tests/gpu/watched_context.h"
#include "tests/support/shapes.h"
#include "tests/support/shuffled.h"
#include "tests/support/skip.h"
#include "tests/window/walk_support.h"
#include "tests/window/window_support.h"
#include "workbench/operations/table.h"

using namespace vesselbench;
using namespace vesselbench::test;
using namespace std::chrono_literals;
using Catch::Matchers::Contains;

namespace {

/// A device that can be lost, and what it was asked for.
struct TestedDevice {
    std::atomic<bool> lost = false;
    std::shared_ptr<DeviceCounts> counts;  ///< of the last one
    int asked_for = 0;

    HeldDevice make() {
        auto context = std::make_shared<WatchedContext>();
        HeldDevice held{std::move(context), current_device()};
        held.device.lost = [this] { return lost.load(); };
        counts = held.device.counts;
        ++asked_for;
        return held;
    }

    [[nodiscard]] LiveDevice live() {
        return {.choice = DeviceChoice::Gpu, .source = [this] { return make(); }};
    }
};

double largest_distance(const Surface& a, const Surface& b) {
    REQUIRE(a.vertex_count() == b.vertex_count());
    double largest = 0.0;
    for (std::size_t v = 0; v < a.vertex_count(); ++v)
        largest = std::max(largest, (a.points()[v] - b.points()[v]).norm());
    return largest / bounds(a).diagonal();
}

const LiveSmoothing& live_of(Driver& window) {
    return window.app().place().live();
}

bool wait_for_exact(Driver& window) {
    return window.run_until(
        [&] {
            const auto& shown = live_of(window).shown();
            return shown && !live_of(window).outdated() && shown->state.exact;
        },
        120s);
}

std::size_t fallbacks_told(Driver& window) {
    return static_cast<std::size_t>(
        std::ranges::count_if(document_of(window).messages(), [](const Message& message) {
            return message.text.find("continues on the CPU") != std::string::npos;
        }));
}

void follow_smoothing(Driver& window) {
    open_file(window, tube_file(36));
    choose(window, "smoothing", "smooth");
    REQUIRE(window.click_item("form.live"));
    REQUIRE(window.click_item("live.follow"));
    REQUIRE(wait_for_exact(window));
}

/// Drives by the mouse on the device, and applies what is seen.
void smooth_on_device(Screen screen) {
    TestedDevice device;
    AppOptions options = app_options();
    options.live = device.live();
    const auto window = window_on(screen, options);
    if (!window) return;
    follow_smoothing(*window);
    const std::size_t before = device.counts->dispatches;
    CHECK(before >= 20);
    for (const ColouringKind kind : {ColouringKind::Deviation, ColouringKind::MeanCurvature}) {
        window->app().place().view.choose(kind);
        const ScreenRect view = window->app().ui().items().at("view.area").rect;
        window->drag(view.middle_x(), view.middle_y(), view.middle_x() + 40, view.middle_y() - 50,
                     MouseButton::Right);
        REQUIRE(wait_for_exact(*window));
        CHECK(live_of(*window).shown()->state.change);
    }
    CHECK(device.counts->dispatches > before);
    CHECK(device.asked_for == 1);
    CHECK(fallbacks_told(*window) == 0);
    const auto seen = live_of(*window).shown();
    apply_form(*window);
    CHECK(edit_count(*window) == 2);
    CHECK(document_of(*window).shown()->surface->points() == seen->state.surface.points());
}

}  // namespace

SCENARIO("Live smoothing on the device shows the CPU's surface and figures",
         "[window][live][live-device]") {
    TestedDevice device;
    std::vector<VertexId> numbers;
    Scene scene;
    scene.surface = shuffled(fine_tube(4.0, 30.0, 60), numbers);
    const auto arguments =
        checked_arguments(find_operation("smooth"), {{"iterations", std::int64_t{30}}});
    std::optional<HeldDevice> held;
    try {
        held = device.make();
    } catch (const GpuUnavailable& error) {
        return skip(error.what());
    }
    LiveSmoother live(scene, std::move(*held));
    const auto quick = live.run(arguments, [](const LiveSmoother::State&) {}, {});
    REQUIRE(quick.device == "gpu");
    CHECK(live.reason().empty());
    const auto exact = live.exact(quick, {});
    CHECK(exact.device == "cpu");
    CHECK(largest_distance(*scene.surface, exact.surface) > 1e-4);
    CHECK(largest_distance(exact.surface, quick.surface) < 1e-5);
    CHECK(quick.change->error.mean == Approx(exact.change->error.mean).epsilon(1e-3));
    CHECK(quick.change->volume_change_percent ==
          Approx(exact.change->volume_change_percent).epsilon(1e-3));
    THEN("a lost device leaves it to the CPU, and says why") {
        device.lost = true;
        const auto after = live.run(arguments, [](const LiveSmoother::State&) {}, {});
        CHECK(after.device == "cpu");
        CHECK(after.surface.points() == exact.surface.points());
        CHECK_THAT(live.reason(), Contains("lost its context"));
    }
}

SCENARIO("The mouse smooths on the device, and Apply enters the CPU's result",
         "[window][live][live-device]") {
    smooth_on_device(Screen::None);
}

SCENARIO("The mouse smooths on the device under a display",
         "[window][live][live-device][walk][display]") {
    smooth_on_device(Screen::Display);
}

SCENARIO("A device lost while the model follows is replaced by the CPU, and that is said once",
         "[window][live][live-device]") {
    TestedDevice device;
    AppOptions options = app_options();
    options.live = device.live();
    const auto window = window_on(Screen::None, options);
    if (!window) return;
    follow_smoothing(*window);
    CHECK(fallbacks_told(*window) == 0);
    device.lost = true;
    for (const char* iterations : {"7", "9"}) {
        window->app().place().set_field("iterations", iterations);
        REQUIRE(wait_for_exact(*window));
        CHECK(live_of(*window).shown()->state.iterations == std::atoi(iterations));
        CHECK(fallbacks_told(*window) == 1);
    }
    apply_form(*window);
    CHECK(edit_count(*window) == 2);
    THEN("neither is it asked for the next model") {
        REQUIRE(window->settle());
        choose(*window, "smoothing", "smooth");
        REQUIRE(window->click_item("form.live"));
        REQUIRE(window->click_item("live.follow"));
        REQUIRE(wait_for_exact(*window));
        CHECK(device.asked_for == 1);
        CHECK(fallbacks_told(*window) == 1);
    }
}
