// The right button is held for long, while the model follows.
// VESSELBENCH_DRIVE_SECONDS=60 makes it a minute on each screen.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include <catch2/catch.hpp>
#include <epoxy/gl.h>

#include "geometry/kernel/stopwatch.h"
#include "tests/window/walk_support.h"
#include "tests/window/window_support.h"
#include "workbench/window/features/live/live_feature.h"
#include "workbench/window/keys/keys.h"

using namespace vesselbench;
using namespace vesselbench::test;
using namespace std::chrono_literals;

namespace {

constexpr double kUsualSeconds = 3.0;
constexpr double kWarming = 0.4;      ///< share of the time before memory is looked at [-]
constexpr double kMostGrowth = 20.0;  ///< a model with what belongs to it takes some 5 MB [MB]

double drive_seconds() {
    const char* wished = std::getenv("VESSELBENCH_DRIVE_SECONDS");
    return wished == nullptr ? kUsualSeconds : std::atof(wished);
}

struct Drive {
    std::vector<double> frames;  ///< times [ms]
    int models = 0;              ///< seen
    double grown = 0.0;          ///< memory after the warming [MB]
};

/// Circles with the button held, from the middle of the view.
Drive drive_for(Driver& window, double seconds) {
    const LiveSmoothing& live = window.app().place().live();
    const ScreenRect view = window.app().ui().items().at("view.area").rect;
    Drive drive;
    double before = 0.0;
    auto seen = live.shown();
    const Stopwatch watch;
    for (int i = 0; watch.seconds() < seconds; ++i) {
        const double angle = 0.15 * i;
        window.move_mouse(view.middle_x() + 90.0F * static_cast<float>(std::sin(angle)),
                          view.middle_y() + 60.0F * static_cast<float>(std::sin(0.7 * angle)));
        const Stopwatch clock;
        window.frame();
        drive.frames.push_back(1e3 * clock.seconds());
        if (std::exchange(seen, live.shown()) != live.shown()) ++drive.models;
        if (before == 0.0 && watch.seconds() > kWarming * seconds) before = resident_megabytes();
    }
    drive.grown = resident_megabytes() - before;
    std::ranges::sort(drive.frames);
    return drive;
}

void print(const Drive& drive, double seconds) {
    const auto at = [&](double share) {
        return drive
            .frames[static_cast<std::size_t>(share * static_cast<double>(drive.frames.size() - 1))];
    };
    std::printf(
        "driven for %.0f s: %zu frames, median %.1f ms, 95 %% below %.1f ms, longest %.1f "
        "ms; %d models; %.1f MB more\n",
        seconds, drive.frames.size(), at(0.5), at(0.95), at(1.0), drive.models, drive.grown);
}

}  // namespace

SCENARIO("The right button is held for long", "[window][live][display]") {
    const Screen screen = GENERATE(Screen::None, Screen::Display);
    const auto window = window_on(screen);
    if (!window) return;
    open_file(*window, tube_file(60));
    choose(*window, "smoothing", "smooth");
    const Workplace& place = window->app().place();
    const ScreenRect view = window->app().ui().items().at("view.area").rect;
    window->move_mouse(view.middle_x(), view.middle_y());
    window->press(MouseButton::Right);
    REQUIRE(window->run_until([&] { return place.live().shown() != nullptr; }, 60s));
    const double seconds = drive_seconds();
    const Drive drive = drive_for(*window, seconds);
    print(drive, seconds);
    CHECK(place.get<LiveFeature>().is_driving());
    CHECK(drive.models > 1);
    CHECK(drive.grown < kMostGrowth);
    CHECK(glGetError() == GL_NO_ERROR);
    CHECK(place.form()->arguments() != Arguments());
    // In the middle of it:
    window->press_key(keys::kEscape);
    CHECK(place.form()->arguments() == Arguments());
    window->frame();
    CHECK_FALSE(place.live().follows());
    window->release(MouseButton::Right);
    REQUIRE(window->run_until([&] { return !place.live().pending(); }, 60s));
    CHECK(edit_count(*window) == 1);
    CHECK(glGetError() == GL_NO_ERROR);
    // The next drive works, and is applied.
    window->move_mouse(view.middle_x(), view.middle_y());
    window->press(MouseButton::Right);
    window->move_mouse(view.middle_x() + 40, view.middle_y());
    REQUIRE(window->run_until(
        [&] {
            const Arguments& values = place.form()->arguments();
            return values.has("iterations") && values.integer("iterations") == 25;
        },
        60s));
    window->release(MouseButton::Right);
    apply_form(*window);
    CHECK(edit_count(*window) == 2);
}
