// What the view was doing when its case is closed, replaced or cannot be drawn.

#include <algorithm>
#include <filesystem>
#include <thread>

#include <catch2/catch.hpp>

#include "geometry/formats/surface_file.h"
#include "tests/support/paths.h"
#include "tests/support/program.h"
#include "tests/support/shapes.h"
#include "tests/window/faulty_device.h"
#include "tests/window/window_support.h"
#include "workbench/window/features/compare/compare_feature.h"
#include "workbench/window/keys/keys.h"

using namespace vesselbench;
using namespace vesselbench::test;
using namespace std::chrono_literals;
using Catch::Matchers::Contains;

namespace fs = std::filesystem;

namespace {

std::string capped_tube_file() {
    const std::string file = temporary_folder() + "/tube.vtp";
    write_surface(fine_tube(4.0, 30.0, 24), file);
    return file;
}

void move_over_model(OffscreenShell& shell) {
    REQUIRE(shell.has("view.area"));
    const ScreenRect rect = shell.app().ui().items().at("view.area").rect;
    shell.move_mouse(rect.middle_x(), rect.middle_y());
}

bool settles_on_the_start_screen(OffscreenShell& shell) {
    shell.app().place().close();
    return shell.settle(20s) && shell.has("start.open");
}

bool tells(const Document& document, const std::string& words) {
    return std::ranges::any_of(document.messages(), [&](const Message& message) {
        return message.text.find(words) != std::string::npos;
    });
}

}  // namespace

SCENARIO("A window is idle after its case was closed midway", "[window][closing]") {
    const auto shell = test_shell();
    if (!shell) return;
    Document& document = shell->app().place().document;
    SECTION("while the model is laid out") {
        shell->app().open(tube_file(240));
        REQUIRE(shell->run_until([&] { return document.shown() != nullptr; }, 60s));
        CHECK(settles_on_the_start_screen(*shell));
    }
    SECTION("while the reference of a comparison is laid out") {
        open_and_wait(*shell, tube_file(240));
        Workplace& place = shell->app().place();
        place.get<CompareFeature>().compare(document.snapshot()->history->current());
        REQUIRE(shell->run_until([&] { return place.comparison()->scene() != nullptr; }, 60s));
        place.get<CompareFeature>().stop();
        CHECK(shell->settle(20s));
        CHECK(settles_on_the_start_screen(*shell));
    }
    SECTION("while a place is searched") {
        open_and_wait(*shell, capped_tube_file());
        shell->press_key(keys::letter('M'));
        move_over_model(*shell);
        const SlowDevice slow;
        shell->press(MouseButton::Left);
        shell->release(MouseButton::Left);
        shell->frame();
        CHECK_FALSE(shell->app().is_settled());
        CHECK(settles_on_the_start_screen(*shell));
    }
    SECTION("while the centre of turns is searched") {
        open_and_wait(*shell, capped_tube_file());
        move_over_model(*shell);
        const SlowDevice slow;
        for (int i = 0; i < 2; ++i) {
            shell->press(MouseButton::Left);
            shell->release(MouseButton::Left);
        }
        CHECK_FALSE(shell->app().is_settled());
        CHECK(settles_on_the_start_screen(*shell));
    }
    SECTION("while the camera flies") {
        open_and_wait(*shell, capped_tube_file());
        shell->press_key(keys::letter('E'));
        REQUIRE(shell->settle(60s));
        REQUIRE(shell->click_item("flight.play"));
        shell->frame();
        CHECK_FALSE(shell->app().is_settled());
        CHECK(settles_on_the_start_screen(*shell));
    }
}

SCENARIO("A stroke whose button was released is kept when its case is closed",
         "[window][closing]") {
    for (const bool started : {true, false}) {
        const fs::path project = fs::path(temporary_folder()) / "tube.vbench";
        {
            Session session = Session::create(project, session_options());
            session.apply("load-surface", {{"file", tube_file(240)}, {"units", std::string("mm")}});
        }
        {
            Document document({.session = session_options(), .documents = temporary_folder()});
            document.open({.path = project});
            while (!document.is_open() || document.busy()) document.poll();
            document.begin_stroke({.operation = "brush-inflate", .radius = 2.0, .strength = 0.5},
                                  Step::LocalRepair);
            document.add_dab({.point = {4, 0, 15}, .normal = {1, 0, 0}});
            while (started && document.take_moves().empty()) document.poll();
            document.end_stroke();
            document.close();
        }
        const Session session = Session::open(project, session_options());
        REQUIRE(session.log().size() == 2);
        CHECK(session.log()[1].edit.operation == "brush-inflate");
        CHECK(session.log()[1].status == EditStatus::Done);
    }
}

SCENARIO("A closed case can be opened and seen again", "[window][closing]") {
    const auto shell = test_shell();
    if (!shell) return;
    const std::string file = capped_tube_file();
    open_and_wait(*shell, file);
    const ViewCamera camera = shell->app().camera();
    const auto project = shell->app().place().document.project();
    REQUIRE(settles_on_the_start_screen(*shell));
    const int drawings = shell->app().drawings();
    open_and_wait(*shell, project.string());
    CHECK(shell->app().camera() == camera);
    CHECK(shell->app().drawings() > drawings);
}

SCENARIO("A double click makes its place the centre of turns", "[window][closing]") {
    const auto shell = test_shell();
    if (!shell) return;
    open_and_wait(*shell, capped_tube_file());
    move_over_model(*shell);
    for (int i = 0; i < 2; ++i) {
        shell->press(MouseButton::Left);
        shell->release(MouseButton::Left);
    }
    REQUIRE(shell->settle(20s));
    CHECK(shell->app().camera().centre.y() == Approx(-4).margin(0.1));
}

SCENARIO("A note that is being written ends with its case", "[window][closing]") {
    const auto shell = test_shell();
    if (!shell) return;
    open_and_wait(*shell, tube_file());
    REQUIRE(shell->click_item("history.note.1"));
    REQUIRE(shell->has("note.words"));
    WHEN("another file is opened") {
        open_and_wait(*shell, capped_tube_file());
        THEN("the note is not written to the new case") {
            CHECK_FALSE(shell->has("note.words"));
        }
    }
    WHEN("another file cannot be opened") {
        const std::string broken = temporary_folder() + "/broken.stl";
        write_text(broken, "solid nothing\nfacet normal");
        shell->app().open(broken);
        REQUIRE(wait_until_idle(*shell));
        THEN("the note is still there") {
            CHECK(shell->has("note.words"));
        }
    }
}

SCENARIO("Of several dropped files the first is opened, and the user is told",
         "[window][closing]") {
    const auto shell = test_shell();
    if (!shell) return;
    const std::string first = tube_file();
    shell->app().drop({first, capped_tube_file()});
    REQUIRE(wait_until_idle(*shell));
    const Document& document = shell->app().place().document;
    REQUIRE(document.is_open());
    CHECK(document.project().parent_path() == std::filesystem::path(first).parent_path());
    CHECK(tells(document, "2 files were dropped"));
}

SCENARIO("Requests go on while nothing can be seen", "[window][closing]") {
    const auto shell = test_shell();
    if (!shell) return;
    App& app = shell->app();
    app.open(tube_file());
    const int drawings = app.drawings();
    const auto end = std::chrono::steady_clock::now() + 60s;
    while (!app.place().document.is_open() && std::chrono::steady_clock::now() < end) {
        app.rest();
        std::this_thread::sleep_for(5ms);
    }
    CHECK(app.place().document.is_open());
    CHECK(app.drawings() == drawings);
    CHECK(shell->settle(60s));
}

SCENARIO("A device without memory leaves the window open", "[window][closing]") {
    const auto shell = test_shell();
    if (!shell) return;
    const Document& document = shell->app().place().document;
    SECTION("for a model") {
        const FullDevice full;
        open_and_wait(*shell, capped_tube_file());
        CHECK(tells(document, "out of memory"));
    }
    SECTION("for a larger view") {
        open_and_wait(*shell, capped_tube_file());
        const FullDevice full;
        shell->resize(1400, 800);
        REQUIRE(shell->settle(20s));
        CHECK(tells(document, "framebuffer"));
    }
    SECTION("for lines and sections") {
        open_and_wait(*shell, capped_tube_file());
        const FullDevice full;
        shell->press_key(keys::letter('L'));
        REQUIRE(shell->settle(60s));
        CHECK(tells(document, "out of memory"));
    }
    // It draws again when there is memory.
    const int drawings = shell->app().drawings();
    open_and_wait(*shell, capped_tube_file());
    CHECK(shell->app().drawings() > drawings);
}

SCENARIO("Closing while an edit runs asks first", "[window][closing]") {
    const auto shell = test_shell();
    if (!shell) return;
    open_and_wait(*shell, tube_file(240));
    App& app = shell->app();
    Document& document = app.place().document;
    document.apply("smooth", {{"iterations", Value(std::int64_t{10000})}}, Step::Smoothing);
    REQUIRE(document.is_editing());
    shell->frame();
    WHEN("the case is closed") {
        REQUIRE(shell->click_item("tool.home"));
        shell->frame();
        CHECK(document.is_open());
        REQUIRE(shell->has("leaving.stay"));
        THEN("it can go on") {
            REQUIRE(shell->click_item("leaving.stay"));
            shell->frame();
            CHECK_FALSE(shell->has("leaving.stay"));
            CHECK(document.is_editing());
            document.cancel();
        }
        THEN("it can be cancelled") {
            REQUIRE(shell->click_item("leaving.leave"));
            CHECK(shell->settle(60s));
            CHECK_FALSE(document.is_open());
        }
        THEN("Escape lets it run") {
            shell->press_key(keys::kEscape);
            shell->frame();
            CHECK_FALSE(shell->has("leaving.stay"));
            CHECK(document.is_editing());
            document.cancel();
        }
    }
    WHEN("the window is closed") {
        CHECK_FALSE(app.may_close());
        for (int i = 0; i < 3; ++i) shell->frame();
        REQUIRE(shell->click_item("leaving.leave"));
        shell->frame();
        CHECK(app.closes());
        CHECK(app.may_close());
    }
    WHEN("the edit has ended") {
        document.cancel();
        REQUIRE(wait_until_idle(*shell));
        CHECK(app.may_close());
    }
    document.cancel();
    CHECK(wait_until_idle(*shell));
}
