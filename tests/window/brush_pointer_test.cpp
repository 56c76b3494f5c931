#include "workbench/window/features/brush/brush_pointer.h"

#include <algorithm>

#include <catch2/catch.hpp>

#include "geometry/formats/surface_file.h"
#include "geometry/kernel/measure.h"
#include "tests/support/shapes.h"
#include "tests/window/faulty_device.h"
#include "tests/window/window_support.h"
#include "workbench/window/features/brush/brush_feature.h"
#include "workbench/window/keys/keys.h"

using namespace vesselbench;
using namespace vesselbench::test;
using namespace std::chrono_literals;

namespace fs = std::filesystem;

namespace {

/// A tube with a bump in the middle of the side that the view's first camera looks at.
std::string bumped_tube_file() {
    const auto bumped = [](const Vec3& p) {
        const Vec3 top(0, -4, 15);
        const double share = std::exp(-(p - top).squaredNorm() / 4.0);
        return Vec3(p + 1.5 * share * Vec3(p.x(), p.y(), 0).normalized());
    };
    const std::string file = temporary_folder() + "/bump.stl";
    write_surface(mapped(fine_tube(4.0, 30.0, 48), bumped), file);
    return file;
}

/// The tube in the window, with a brush chosen.
struct Painting {
    explicit Painting(const std::string& operation) : shell(test_shell()) {
        if (!shell) return;
        open_and_wait(*shell, bumped_tube_file());
        REQUIRE(shell->click_item("rail.local-repair"));
        REQUIRE(shell->click_item("choose." + operation));
        const ScreenRect& view = shell->app().ui().items().at("view.area").rect;
        x = view.middle_x();
        y = view.middle_y();
        shell->move_mouse(x, y);
        REQUIRE(shell->settle(10s));
    }

    Document& document() { return shell->app().place().document; }

    Positions points() { return document().shown()->surface->points(); }

    std::size_t edits() { return document().snapshot()->log.size(); }

    bool wait_for_edits(std::size_t count) {
        return shell->run_until([&] { return edits() == count && !document().busy(); }, 60s) &&
               shell->settle(60s);
    }

    /// Over the bump, without releasing the button.
    void draw() {
        shell->move_mouse(x - 30, y - 30);
        shell->press(MouseButton::Left);
        REQUIRE(shell->run_until([&] { return document().is_painting(); }, 10s));
        for (float step = -30; step <= 30; step += 10) {
            shell->move_mouse(x + step, y + step);
            shell->frame();
        }
    }

    void stroke() {
        const std::size_t before = edits();
        draw();
        shell->release(MouseButton::Left);
        REQUIRE(wait_for_edits(before + 1));
    }

    std::unique_ptr<OffscreenShell> shell;
    float x = 0, y = 0;
};

/// The deepest place of the side with the bump, as seen: -5.5 on its top before, -4 without it.
double top(const Positions& points) {
    return std::ranges::min(points, {}, [](const Vec3& p) { return p.y(); }).y();
}

}  // namespace

SCENARIO("A stroke over a bump is one edit that replays to the same bits", "[window][strokes]") {
    Painting painting("brush-smooth");
    if (!painting.shell) return;
    const Positions before = painting.points();
    painting.stroke();
    const Positions after = painting.points();
    CHECK(after.size() == before.size());
    CHECK(top(after) > top(before) + 0.1);
    const LogEntry edit = painting.document().snapshot()->log.back();
    CHECK(edit.edit.operation == "brush-smooth");
    CHECK(edit.edit.given.records("dabs").list().size() >= 2);
    WHEN("it is undone and done again") {
        REQUIRE(painting.shell->click_item("tool.undo"));
        REQUIRE(painting.wait_for_edits(1));
        CHECK(painting.points() == before);
        REQUIRE(painting.shell->click_item("tool.redo"));
        REQUIRE(painting.wait_for_edits(2));
        CHECK(painting.points() == after);
    }
    WHEN("its arguments are given to a session") {
        const fs::path project = painting.document().project();
        painting.shell->app().place().close();
        REQUIRE(painting.shell->run_until([&] { return !painting.document().busy(); }, 30s));
        Session session = Session::open(project, session_options());
        CHECK(session.scene().surface->points() == after);
        session.undo();
        session.apply(edit.edit.operation, edit.edit.given);
        CHECK(session.scene().surface->points() == after);
    }
    WHEN("another stroke follows") {
        painting.stroke();
        CHECK(painting.edits() == 3);
        CHECK(top(painting.points()) > top(after));
    }
}

SCENARIO("The surface follows a stroke before it is entered", "[window][strokes]") {
    Painting painting("brush-inflate");
    if (!painting.shell) return;
    const Positions before = painting.points();
    painting.draw();
    REQUIRE(painting.shell->run_until([&] { return painting.points() != before; }, 10s));
    CHECK(painting.edits() == 1);
    CHECK(top(painting.points()) < top(before) - 0.05);
    SECTION("Esc drops it") {
        painting.shell->press_key(keys::kEscape);
        painting.shell->move_mouse(painting.x - 20, painting.y);
        painting.shell->release(MouseButton::Left);
        REQUIRE(painting.shell->settle(60s));
        CHECK(painting.edits() == 1);
        CHECK(painting.points() == before);
        CHECK(painting.shell->app().place().form());
    }
    SECTION("releasing the button enters it") {
        painting.shell->release(MouseButton::Left);
        REQUIRE(painting.wait_for_edits(2));
        CHECK(top(painting.points()) < top(before) - 0.05);
    }
    SECTION("undo waits for its end") {
        painting.shell->press_key(keys::letter('Z'), {.control = true});
        CHECK(painting.document().is_painting());
        painting.shell->release(MouseButton::Left);
        REQUIRE(painting.wait_for_edits(2));
    }
}

SCENARIO("A click on the surface makes one dab", "[window][strokes]") {
    Painting painting("brush-inflate");
    if (!painting.shell) return;
    painting.shell->click(painting.x, painting.y);
    REQUIRE(painting.wait_for_edits(2));
    CHECK(painting.document().snapshot()->log.back().edit.given.records("dabs").list().size() == 1);
}

SCENARIO("Presses count that are faster than the device", "[window][strokes]") {
    Painting painting("brush-inflate");
    if (!painting.shell) return;
    OffscreenShell& shell = *painting.shell;
    {
        const SlowDevice slow;
        shell.click(painting.x, painting.y);
        shell.click(painting.x + 20, painting.y + 20);
        shell.move_mouse(painting.x - 30, painting.y - 30);
        shell.press(MouseButton::Left);
        shell.move_mouse(painting.x + 30, painting.y - 30);
        shell.release(MouseButton::Left);
    }
    REQUIRE(painting.wait_for_edits(4));
    const auto& log = painting.document().snapshot()->log;
    const auto dabs = [&](std::size_t edit) {
        return log[edit].edit.given.records("dabs").list().size();
    };
    CHECK(dabs(1) == 1);
    CHECK(dabs(2) == 1);
    CHECK(dabs(3) > 1);
}

SCENARIO("A drag on the background turns the view", "[window][strokes]") {
    Painting painting("brush-inflate");
    if (!painting.shell) return;
    const ScreenRect view = painting.shell->app().ui().items().at("view.area").rect;
    const float x = view.x + 40, y = view.middle_y();
    const int drawings = painting.shell->app().drawings();
    painting.shell->move_mouse(x, y);
    painting.shell->press(MouseButton::Left);
    REQUIRE(painting.shell->settle(10s));
    for (int i = 1; i < 8; ++i) painting.shell->move_mouse(x + 4.0F * static_cast<float>(i), y);
    painting.shell->release(MouseButton::Left);
    CHECK(painting.shell->app().drawings() > drawings);
    CHECK(painting.shell->settle(10s));
    CHECK(painting.edits() == 1);
    CHECK_FALSE(painting.document().is_painting());
}

SCENARIO("Keys over the view change the brush", "[window][strokes]") {
    Painting painting("brush-weight");
    if (!painting.shell) return;
    const Workplace& place = painting.shell->app().place();
    const BrushTip tip = place.get<BrushFeature>().tip();
    CHECK(tip.radius > 0.5);
    painting.shell->press_key(keys::kRightBracket);
    CHECK(place.get<BrushFeature>().tip() == after_key(tip, BrushKey::Larger));
    painting.shell->press_key(keys::kLeftBracket, {.shift = true});
    CHECK(place.get<BrushFeature>().tip().strength == Approx(tip.strength - 0.05));
    painting.stroke();
    const Surface& surface = *painting.document().shown()->surface;
    REQUIRE(surface.attributes.contains("painted_weight"));
    CHECK(std::ranges::max(*surface.attributes.at("painted_weight")) > 0.4);
    THEN("another brush has the same size") {
        const double radius = place.get<BrushFeature>().tip().radius;
        painting.shell->app().place().choose("brush-inflate");
        CHECK(place.get<BrushFeature>().tip().radius == radius);
    }
}
