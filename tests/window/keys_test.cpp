#include "workbench/window/keys/keys.h"

#include <algorithm>

#include <catch2/catch.hpp>

#include "tests/window/window_support.h"
#include "workbench/window/features/compare/compare_feature.h"
#include "workbench/window/keys/key_table.h"

using namespace vesselbench;
using namespace vesselbench::test;
using namespace std::chrono_literals;

namespace {

std::vector<KeyBinding> all_bindings() {
    std::vector<KeyBinding> all;
    for (const KeyRow& row : key_table())
        all.insert(all.end(), row.bindings.begin(), row.bindings.end());
    return all;
}

bool meet(const KeyBinding& a, const KeyBinding& b) {
    const bool held = a.modifiers == b.modifiers || a.modifiers == Modifiers::Any ||
                      b.modifiers == Modifiers::Any;
    const bool used = a.use == b.use || a.use == KeyUse::Anywhere || b.use == KeyUse::Anywhere;
    return a.key == b.key && held && used;
}

/// A window with a tube, the mouse over its view.
struct Keyed {
    Keyed() : shell(test_shell()) {
        if (!shell) return;
        open_and_wait(*shell, tube_file());
        point_at_view();
    }

    void point_at_view() {
        REQUIRE(shell->has("view.area"));
        const ScreenRect view = shell->app().ui().items().at("view.area").rect;
        shell->move_mouse(view.middle_x(), view.middle_y());
    }

    /// Whether 3 shows the model from the side.
    bool turns_camera() {
        const Vec3 before = shell->app().camera().view;
        shell->press_key(keys::k0 + 3);
        return (shell->app().camera().view - before).norm() > 0.5;
    }

    Workplace& place() { return shell->app().place(); }

    std::unique_ptr<OffscreenShell> shell;
};

}  // namespace

SCENARIO("A key has one meaning at a time", "[window][keys]") {
    const auto all = all_bindings();
    for (const KeyBinding& a : all)
        for (const KeyBinding& b : all) {
            // In a slice, Home is the slice's.
            if (a.command == KeyCommand::FrameSlice || b.command == KeyCommand::FrameSlice)
                continue;
            INFO("key " << a.key);
            CHECK((a.command == b.command || !meet(a, b)));
        }
}

SCENARIO("Every command has a key, which the help names", "[window][keys]") {
    for (int i = 1; i < static_cast<int>(KeyCommand::Count); ++i) {
        INFO("command " << i);
        CHECK_FALSE(keys_of(static_cast<KeyCommand>(i)).empty());
    }
    CHECK(keys_of(KeyCommand::SlicePlanes) == "Shift+I");
    CHECK(keys_text(KeyRow{.mouse = "wheel",
                           .bindings = {{KeyCommand::FlyForward, keys::kUp},
                                        {KeyCommand::FlyBack, keys::kDown}}}) == "Up, Down, wheel");
    CHECK(keys_text(
              KeyRow{.bindings = {{KeyCommand::Redo, keys::letter('Z'), Modifiers::ControlShift},
                                  {KeyCommand::Redo, keys::letter('Y'), Modifiers::Control}}}) ==
          "Ctrl+Shift+Z, Ctrl+Y");
}

SCENARIO("A field keeps the keys until the view takes them", "[window][keys]") {
    Keyed window;
    if (!window.shell) return;
    OffscreenShell& shell = *window.shell;
    window.place().choose("smooth");
    REQUIRE(shell.fill_item("field.iterations", "7"));
    window.point_at_view();
    REQUIRE_FALSE(window.turns_camera());
    const auto text = [&] { return window.place().form()->field("iterations").text; };
    WHEN("the wheel is turned over the view") {
        shell.wheel(1);
        shell.frame();
        CHECK(window.turns_camera());
        shell.type("5");
        CHECK(text() == "7");
    }
    WHEN("the view is clicked") {
        const ScreenRect view = shell.app().ui().items().at("view.area").rect;
        shell.click(view.middle_x(), view.y + view.height - 5);
        CHECK(window.turns_camera());
        CHECK(text() == "7");
    }
    WHEN("Enter is pressed") {
        shell.press_key(keys::kEnter);
        CHECK(window.turns_camera());
        CHECK(text() == "7");
    }
    WHEN("Esc is pressed while a distance is measured") {
        window.place().view.tool = ClickTool::Distance;
        shell.press_key(keys::kEscape);
        CHECK(text().empty());
        CHECK(window.place().view.tool == ClickTool::Distance);
        THEN("the next one ends the measuring") {
            shell.press_key(keys::kEscape);
            CHECK(window.place().view.tool == ClickTool::None);
        }
    }
}

SCENARIO("Space is the flight's before a comparison's, and no one's behind a dialog",
         "[window][keys]") {
    Keyed window;
    if (!window.shell) return;
    OffscreenShell& shell = *window.shell;
    Document& document = window.place().document;
    document.apply("smooth", {{"iterations", Value(std::int64_t{1})}}, Step::Smoothing);
    REQUIRE(wait_until_idle(shell));
    const History& history = *document.snapshot()->history;
    const StateId reference = history.state(history.current()).parent;
    window.place().get<CompareFeature>().compare(reference);
    REQUIRE(shell.settle(60s));
    Comparison& comparison = *window.place().comparison();
    comparison.set_mode(CompareMode::Blink);
    shell.frame();
    comparison.switch_by_hand();  // it no longer switches by itself
    const bool before = comparison.blinks_reference();
    window.point_at_view();
    SECTION("alone") {
        shell.press_key(keys::kSpace);
        CHECK(comparison.blinks_reference() != before);
    }
    SECTION("in a flight") {
        shell.press_key(keys::letter('E'));
        shell.press_key(keys::kSpace);
        CHECK(comparison.blinks_reference() == before);
    }
    SECTION("behind the help") {
        shell.press_key(keys::kF1);
        shell.press_key(keys::kSpace);
        CHECK(comparison.blinks_reference() == before);
    }
}

SCENARIO("The text's size is chosen by keys and in the tool bar", "[window][keys]") {
    const auto shell = test_shell();
    if (!shell) return;
    shell->frame();
    const auto em = [&] {
        shell->frame();
        return shell->app().ui().em;
    };
    CHECK(em() == 15);
    shell->press_key(keys::kEqual, {.control = true});
    CHECK(em() == 17);
    REQUIRE(shell->click_item("tool.text_size"));
    REQUIRE(shell->click_item("tool.text_size=75 %"));
    CHECK(em() == 11);
    shell->press_key(keys::k0, {.control = true});
    CHECK(em() == 15);
    WHEN("it is larger than the window has room for") {
        shell->app().place().settings.scale = 2.5;
        CHECK(em() == 19);
        shell->resize(2560, 1440);
        CHECK(em() == 38);
    }
}
