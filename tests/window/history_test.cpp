#include <catch2/catch.hpp>

#include "geometry/formats/surface_file.h"
#include "tests/support/shapes.h"
#include "tests/window/window_support.h"
#include "workbench/operations/table.h"
#include "workbench/window/case/history_tree.h"

using namespace vesselbench;
using namespace vesselbench::test;
using namespace std::chrono_literals;
using Catch::Matchers::Contains;

namespace {

/// Applies an operation and waits for it.
void apply(OffscreenShell& shell, const std::string& operation, Arguments given) {
    shell.app().place().document.apply(operation, std::move(given),
                                       find_operation(operation).usual_step);
    REQUIRE(wait_until_idle(shell));
    REQUIRE(shell.settle(60s));
}

const std::vector<LogEntry>& log_of(OffscreenShell& shell) {
    return shell.app().place().document.snapshot()->log;
}

}  // namespace

SCENARIO("A note is written on an edit from the history", "[window][history]") {
    const auto shell = test_shell();
    if (!shell) return;
    open_and_wait(*shell, tube_file());
    apply(*shell, "smooth", {{"iterations", Value(std::int64_t{2})}});
    REQUIRE(shell->click_item("history.note.2"));
    REQUIRE(shell->fill_item("note.words", "the staircase\u2019s edge"));
    REQUIRE(shell->click_item("note.save"));
    REQUIRE(wait_until_idle(*shell));
    CHECK_FALSE(shell->has("note.words"));
    CHECK(log_of(*shell)[1].edit.note == "the staircase\u2019s edge");
    CHECK(shell->app().place().history().rows[2].note == "the staircase\u2019s edge");
    WHEN("it is changed from the edit's form, and dropped") {
        REQUIRE(shell->click_item("rail.edit.2"));
        REQUIRE(shell->click_item("operation.note"));
        REQUIRE(shell->fill_item("note.words", "other"));
        REQUIRE(shell->click_item("note.cancel"));
        THEN("it stays") {
            CHECK(log_of(*shell)[1].edit.note == "the staircase\u2019s edge");
        }
    }
    WHEN("the project is opened again") {
        const auto project = shell->app().place().document.project();
        shell->app().place().close();
        shell->frame();
        CHECK(Session::open(project, session_options()).log()[1].edit.note ==
              "the staircase\u2019s edge");
    }
}

SCENARIO("An earlier edit's change leaves later ones pending until they are run",
         "[window][history]") {
    const auto shell = test_shell();
    if (!shell) return;
    open_and_wait(*shell, tube_file());
    apply(*shell, "smooth", {{"iterations", Value(std::int64_t{2})}});
    apply(*shell, "subdivide", {});
    shell->app().place().document.change(2, {{"iterations", Value(std::int64_t{4})}});
    REQUIRE(wait_until_idle(*shell));
    REQUIRE(log_of(*shell)[1].edit.edit.revision == 2);
    CHECK(log_of(*shell)[2].status == EditStatus::Pending);
    REQUIRE(shell->has("banner.pending"));
    REQUIRE(shell->click_item("banner.pending.action"));
    REQUIRE(wait_until_idle(*shell));
    CHECK(log_of(*shell)[2].status == EditStatus::Done);
    CHECK_FALSE(shell->has("banner.pending.action"));
}

SCENARIO("A stale edit says why, and its remedies are buttons", "[window][history]") {
    const auto shell = test_shell();
    if (!shell) return;
    const std::string input = tube_file();
    open_and_wait(*shell, input);
    Document& document = shell->app().place().document;
    apply(*shell, "brush-smooth", {{"dabs", std::vector<double>{4, 0, 15, 1, 0, 0, 4, 2, 0.5, 1}}});
    const std::string far = temporary_folder() + "/far.stl";
    write_surface(
        mapped(fine_tube(4.0, 30.0, 48), [](const Vec3& p) { return Vec3(p + Vec3(50, 0, 0)); }),
        far);
    document.change(1, {{"file", far}, {"units", std::string("mm")}});
    REQUIRE(wait_until_idle(*shell));
    document.run_pending();
    REQUIRE(wait_until_idle(*shell));
    REQUIRE(shell->settle(60s));
    REQUIRE(log_of(*shell)[1].status == EditStatus::Stale);
    REQUIRE(shell->click_item("banner.stale.action"));
    REQUIRE(shell->app().place().form());
    CHECK(shell->app().place().form()->edit() == 2);
    CHECK_FALSE(shell->has("banner.stale.action"));
    REQUIRE(shell->click_item("operation.remove"));
    REQUIRE(wait_until_idle(*shell));
    REQUIRE(shell->settle(60s));
    CHECK(log_of(*shell).size() == 1);
    CHECK_FALSE(shell->has("banner.stale.action"));
}

SCENARIO("The history follows the current state", "[window][history]") {
    const auto shell = test_shell();
    if (!shell) return;
    open_and_wait(*shell, tube_file());
    for (int i = 0; i < 8; ++i) apply(*shell, "smooth", {{"iterations", Value(std::int64_t{1})}});
    const auto current = [&] {
        const StateId state = shell->app().place().document.snapshot()->history->current();
        return "history." + std::to_string(state);
    };
    const auto height = [&](const std::string& row) {
        return shell->has(row) ? shell->app().ui().items().at(row).rect.height : 0.0F;
    };
    const float whole = height(current());
    CHECK(whole > shell->app().ui().em);
    CHECK(height("history.0") < whole);
    WHEN("everything is undone") {
        for (int i = 0; i < 9; ++i) {
            REQUIRE(shell->click_item("tool.undo"));
            REQUIRE(wait_until_idle(*shell));
            REQUIRE(shell->settle(60s));
        }
        CHECK(current() == "history.0");
        CHECK(height(current()) == Approx(whole));
    }
}
