// Windows that end, or are ended, while something goes on: the project keeps all entered edits.

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <thread>

#include <catch2/catch.hpp>

#include "tests/support/child_process.h"
#include "tests/support/commands.h"
#include "tests/support/paths.h"
#include "tests/support/program.h"
#include "tests/support/shapes.h"
#include "tests/window/display_driver.h"
#include "tests/window/walk_support.h"
#include "tests/window/window_support.h"
#include "workbench/window/keys/keys.h"

using namespace vesselbench;
using namespace vesselbench::test;
using namespace std::chrono_literals;

namespace fs = std::filesystem;

namespace {

constexpr const char* kPainted = "VESSELBENCH_TEST_PAINTED";  ///< project of the endless stroke

/// A project of a tube with one edit after its source.
std::string tube_project(int around) {
    const std::string project = temporary_folder() + "/tube.vbench";
    REQUIRE(run_program(program_path(), {"new", project, tube_file(around)}).exit_code == 0);
    REQUIRE(run_program(program_path(), {"apply", project, "smooth", "iterations=2"}).exit_code ==
            0);
    return project;
}

/// All edits are there, may be continued, and replay to the stored bits.
void check_intact(const std::string& project, std::size_t edits) {
    {
        const Session session = Session::open(project, session_options());
        CHECK(session.read_only_reason().empty());
        CHECK(session.log().size() == edits);
    }
    CHECK(run_program(program_path(), {"replay", project}).exit_code == 0);
}

/// A child that a killed process was just starting holds its lock until it runs its own program.
void wait_for_lock(const std::string& project) {
    for (int i = 0; i < 200; ++i) {
        if (Session::open(project, session_options()).read_only_reason().empty()) return;
        std::this_thread::sleep_for(50ms);
    }
}

/// The program with its window on the virtual display.
struct RunningWindow {
    explicit RunningWindow(const std::string& project)
        : process(program_path(), {"open", project}) {
        const std::string title = fs::path(project).filename().string();
        for (int i = 0; i < 200 && !shown; ++i) {
            shown = run_command("xdotool", {"search", "--name", title})->exit_code == 0;
            if (!shown) std::this_thread::sleep_for(50ms);
        }
    }

    ChildProcess process;
    bool shown = false;
};

}  // namespace

SCENARIO("The window is closed in the middle of an operation", "[window][endings][display]") {
    const Screen screen = GENERATE(Screen::None, Screen::Display);
    auto window = window_on(screen);
    if (!window) return;
    const std::string project = tube_project(96);
    open_file(*window, project);
    choose(*window, "smoothing", "smooth");
    REQUIRE(window->fill_item("field.iterations", "10000"));
    REQUIRE(window->click_item("operation.apply"));
    REQUIRE(document_of(*window).activity());
    window.reset();
    check_intact(project, 2);
    window = window_on(screen);
    open_file(*window, project);
    CHECK(edit_count(*window) == 2);
}

SCENARIO("A project that another window holds is shown, not changed",
         "[window][endings][display]") {
    const std::string project = tube_project(24);
    ::setenv("XDG_CONFIG_HOME", temporary_folder().c_str(), 1);
    if (!start_display()) return;
    RunningWindow other(project);
    REQUIRE(other.shown);
    const auto window = window_on(Screen::Display);
    if (!window) return;
    open_file(*window, project);
    CHECK(edit_count(*window) == 2);
    CHECK(window->has("banner.read_only"));
    choose(*window, "smoothing", "smooth");
    CHECK_FALSE(window->is_enabled("operation.apply"));
    CHECK(window->is_enabled("operation.preview"));
    WHEN("a copy is saved, as the message offers") {
        REQUIRE(window->click_item("banner.read_only.action"));
        REQUIRE(window->fill_item("file.name", "copy.vbench"));
        REQUIRE(window->click_item("file.accept"));
        REQUIRE(window->wait_until_idle());
        INFO(document_of(*window).messages().back().text);
        REQUIRE_FALSE(document_of(*window).failure());
        const std::string copy = fs::path(project).replace_filename("copy.vbench");
        open_file(*window, copy);
        CHECK_FALSE(window->has("banner.read_only"));
        choose(*window, "smoothing", "smooth");
        CHECK(window->is_enabled("operation.apply"));
    }
    WHEN("the other window is asked to end") {
        other.process.signal(SIGTERM);
        CHECK(other.process.wait() == 0);
        open_file(*window, project);
        CHECK_FALSE(window->has("banner.read_only"));
        choose(*window, "smoothing", "smooth");
        apply_form(*window);
        CHECK(edit_count(*window) == 3);
    }
}

// The part of the other process in the next scenario.
SCENARIO("A stroke that does not end", "[.][painting]") {
    const char* project = std::getenv(kPainted);
    if (project == nullptr) return;
    const auto window = window_on(Screen::Display);
    if (!window) return;
    open_file(*window, project);
    choose(*window, "local-repair", "brush-inflate");
    const ScreenRect view = window->app().ui().items().at("view.area").rect;
    window->move_mouse(view.middle_x(), view.middle_y());
    REQUIRE(window->settle());
    window->press(MouseButton::Left);
    const Surface before = *document_of(*window).shown()->surface;
    REQUIRE(window->run_until(
        [&] {
            return document_of(*window).is_painting() &&
                   document_of(*window).shown()->surface->points() != before.points();
        },
        10s));
    std::cout << "painting" << std::endl;
    for (float way = 0;; way = way > 80 ? 0 : way + 10)
        window->move_mouse(view.middle_x() + way, view.middle_y() + way);
}

SCENARIO("The window is killed in the middle of a stroke", "[window][endings][display]") {
    if (!start_display()) return;
    const std::string project = tube_project(48);
    ::setenv(kPainted, project.c_str(), 1);
    ChildProcess painter("/proc/self/exe", {"[painting]"});
    std::string line = painter.line();
    while (!line.empty() && line != "painting") line = painter.line();
    REQUIRE(line == "painting");
    painter.signal(SIGKILL);
    CHECK(painter.wait() == 128 + SIGKILL);
    wait_for_lock(project);
    check_intact(project, 2);
    const auto window = window_on(Screen::Display);
    open_file(*window, project);
    CHECK(edit_count(*window) == 2);
}
