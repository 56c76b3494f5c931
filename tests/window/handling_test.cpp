// What a user meets while working: what came out, what runs, where the view is, what is still true.

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <catch2/catch.hpp>

#include "tests/support/shapes.h"
#include "tests/window/case_folder.h"
#include "tests/window/window_support.h"
#include "workbench/operations/table.h"
#include "workbench/window/case/history_tree.h"
#include "workbench/window/case/readable.h"
#include "workbench/window/case/rerun.h"
#include "workbench/window/features/result/result_feature.h"

using namespace vesselbench;
using namespace vesselbench::test;
using namespace std::chrono_literals;
using Catch::Matchers::Contains;

namespace fs = std::filesystem;

namespace {

const Arguments kGentle = {{"iterations", Value(std::int64_t{2})}};

Document& document_in(OffscreenShell& shell) {
    return shell.app().place().document;
}

void wait(OffscreenShell& shell) {
    REQUIRE(wait_until_idle(shell));
    REQUIRE(shell.settle(60s));
}

void apply(OffscreenShell& shell, const std::string& operation, Arguments given) {
    document_in(shell).apply(operation, std::move(given), find_operation(operation).usual_step);
    wait(shell);
}

void click(OffscreenShell& shell, const std::string& item) {
    INFO(item);
    REQUIRE(shell.click_item(item));
    wait(shell);
}

const ResultCard* card_of(OffscreenShell& shell) {
    return shell.app().place().get<ResultFeature>().card();
}

std::string row_of(const ResultCard& card, const std::string& name) {
    const auto row = std::ranges::find(card.rows, name, &ResultRow::name);
    return row == card.rows.end() ? "" : row->before + " -> " + row->after;
}

const ScreenRect& rect_of(OffscreenShell& shell, const std::string& item) {
    return shell.app().ui().items().at(item).rect;
}

/// The pointer is on the model, as while somebody works there.
void point_at_model(OffscreenShell& shell) {
    const ScreenRect view = rect_of(shell, "view.area");
    shell.move_mouse(view.middle_x(), view.middle_y());
}

HistoryTree strokes_tree(std::size_t count) {
    HistoryTree tree;
    tree.rows.push_back({.state = 0, .title = "empty case"});
    for (std::size_t i = 1; i <= count; ++i)
        tree.rows.push_back({.state = static_cast<StateId>(i),
                             .parent_row = static_cast<int>(i) - 1,
                             .current = i == count,
                             .title = "brush-smooth",
                             .brush = "brush-smooth"});
    return tree;
}

}  // namespace

SCENARIO("After a recipe ran, a card says what came out and what is next", "[window][handling]") {
    const auto shell = test_shell();
    if (!shell) return;
    open_and_wait(*shell, case_folder());
    CHECK(card_of(*shell) == nullptr);
    click(*shell, "tool.prepare");
    click(*shell, "prepare.run");
    REQUIRE(card_of(*shell) != nullptr);
    const ResultCard card = *card_of(*shell);
    CHECK(card.model == "Model for flow simulation");
    CHECK_THAT(card.what, Contains("Prepared the model for flow simulation"));
    const std::size_t triangles = document_in(*shell).newest()->surface->triangle_count();
    CHECK_THAT(row_of(card, "Triangles"), Contains("-> " + grouped(triangles)));
    CHECK_THAT(row_of(card, "Volume"), Contains("mm\u00B3 -> 1,"));
    CHECK(card.can_compare);
    WHEN("the model is to be looked at") {
        click(*shell, "result.look");
        THEN("it is seen beside the one before") {
            CHECK(shell->app().place().comparison());
            CHECK(card_of(*shell) != nullptr);
        }
    }
    WHEN("it is to be reviewed") {
        click(*shell, "result.review");
        CHECK(shell->app().place().step() == Step::Review);
        CHECK(card_of(*shell) == nullptr);
        CHECK(shell->has("review.export"));
    }
    WHEN("it is to be exported") {
        click(*shell, "result.export");
        CHECK(shell->app().place().question() == FileQuestion::Export);
    }
    WHEN("another state is shown") {
        click(*shell, "tool.undo");
        CHECK(card_of(*shell) == nullptr);
    }
    WHEN("it is closed") {
        click(*shell, "result.close");
        CHECK(card_of(*shell) == nullptr);
    }
}

SCENARIO("An earlier edit is changed, and what follows runs, by one button", "[window][handling]") {
    const auto shell = test_shell();
    if (!shell) return;
    open_and_wait(*shell, tube_file());
    const Document& document = document_in(*shell);
    apply(*shell, "smooth", kGentle);
    apply(*shell, "subdivide", {});
    click(*shell, "rail.edit.2");
    CHECK(shell->app().place().following().edits == 1);
    CHECK(shell->has("operation.cost"));
    REQUIRE(shell->fill_item("field.iterations", "4"));
    click(*shell, "operation.apply");
    CHECK(pending_count(*document.snapshot(), document.variant()) == 0);
    CHECK(document.snapshot()->log[1].edit.edit.revision == 2);
    CHECK_FALSE(shell->has("banner.pending"));
    REQUIRE(card_of(*shell) != nullptr);
    CHECK(card_of(*shell)->what == "Ran 1 pending edit");
    THEN("an edit that nothing follows has no cost and no card") {
        click(*shell, "rail.edit.3");
        CHECK(shell->app().place().following().edits == 0);
        CHECK_FALSE(shell->has("operation.cost"));
        click(*shell, "operation.apply");
        CHECK(card_of(*shell) == nullptr);
    }
}

SCENARIO("What an edit costs is said in edits and time", "[window][handling]") {
    CHECK(rerun_text({.edits = 5, .seconds = 19.0}) == "5 edits, about 20 s");
    CHECK(rerun_text({.edits = 1, .seconds = 0.2}) == "1 edit, less than a second");
    CHECK(rerun_text({.edits = 2, .seconds = 3.2}) == "2 edits, about 3 s");
    CHECK(rerun_text({.edits = 9, .seconds = 200.0}) == "9 edits, about 4 min");
}

SCENARIO("Strokes collect until what follows them is run", "[window][handling]") {
    const auto shell = test_shell();
    if (!shell) return;
    open_and_wait(*shell, tube_file());
    Document& document = document_in(*shell);
    apply(*shell, "smooth", kGentle);
    shell->app().place().choose("brush-inflate");
    wait(*shell);
    for (const double z : {12.0, 18.0}) {
        apply(*shell, "brush-inflate", {{"at", Value(Vec3(4, 0, z))}, {"radius", Value(2.0)}});
        CHECK(pending_count(*document.snapshot(), document.variant()) == 1);
    }
    if (!shell->app().place().form()) shell->app().place().choose("brush-inflate");
    wait(*shell);
    CHECK_FALSE(shell->has("operation.apply"));
    click(*shell, "operation.run");
    CHECK(pending_count(*document.snapshot(), document.variant()) == 0);
    CHECK_FALSE(shell->app().place().form());
}

SCENARIO("A banner does not move the model", "[window][handling]") {
    const auto shell = test_shell();
    if (!shell) return;
    open_and_wait(*shell, tube_file());
    apply(*shell, "smooth", kGentle);
    apply(*shell, "subdivide", {});
    const ScreenRect view = rect_of(*shell, "view.area");
    const ViewCamera camera = shell->app().camera();
    document_in(*shell).change(2, {{"iterations", Value(std::int64_t{3})}});
    wait(*shell);
    REQUIRE(shell->has("banner.pending"));
    CHECK(rect_of(*shell, "view.area") == view);
    CHECK(shell->app().camera() == camera);
}

SCENARIO("The camera stays while something is tried out or the mouse works on the model",
         "[window][handling]") {
    const auto shell = test_shell();
    if (!shell) return;
    open_and_wait(*shell, tube_file());
    Workplace& place = shell->app().place();
    const ViewCamera before = shell->app().camera();
    const auto longer = [&] { return shell->app().camera().half_height > before.half_height; };
    WHEN("a preview is much larger") {
        place.choose_edit(1);
        place.set_field("units", "cm");
        place.preview();
        wait(*shell);
        REQUIRE(place.document.previewed());
        CHECK(shell->app().camera() == before);
        THEN("the camera follows when it is entered") {
            place.apply();
            wait(*shell);
            CHECK(longer());
        }
    }
    WHEN("the model grows under the mouse") {
        point_at_model(*shell);
        place.document.change(1,
                              {{"file", place.document.snapshot()->log[0].edit.given.text("file")},
                               {"units", std::string("cm")}});
        wait(*shell);
        CHECK(shell->app().camera() == before);
        THEN("the camera follows when the mouse has left the view") {
            shell->move_mouse(2, 2);
            wait(*shell);
            CHECK(longer());
        }
    }
}

SCENARIO("A project is shown as it was left", "[window][handling]") {
    const fs::path project = fs::path(temporary_folder()) / "tube.vbench";
    {
        Session session = Session::create(project, session_options());
        session.apply("load-surface", {{"file", tube_file()}, {"units", std::string("mm")}});
    }
    const auto shell = test_shell();
    if (!shell) return;
    open_and_wait(*shell, project);
    const ScreenRect view = rect_of(*shell, "view.area");
    shell->drag(view.middle_x(), view.middle_y(), view.middle_x() + 90, view.middle_y() + 20);
    const ViewCamera left = shell->app().camera();
    shell->app().place().close();
    wait(*shell);
    const auto near = [&](const ViewCamera& camera) {
        return (camera.view - left.view).norm() < 1e-9 && (camera.up - left.up).norm() < 1e-9 &&
               (camera.centre - left.centre).norm() < 1e-6 &&
               std::abs(camera.half_height - left.half_height) < 1e-9;
    };
    WHEN("another case was shown meanwhile") {
        open_and_wait(*shell, tube_file(36));
        REQUIRE_FALSE(near(shell->app().camera()));
        open_and_wait(*shell, project);
        CHECK(near(shell->app().camera()));
    }
    WHEN("the project can only be read") {
        const Session holder = Session::open(project, session_options());
        open_and_wait(*shell, project);
        REQUIRE_FALSE(document_in(*shell).snapshot()->read_only_reason.empty());
        CHECK(near(shell->app().camera()));
        THEN("turning it is no failure") {
            shell->drag(view.middle_x(), view.middle_y(), view.middle_x() - 60, view.middle_y());
            shell->app().place().close();
            wait(*shell);
            CHECK_FALSE(document_in(*shell).failure());
        }
    }
}

SCENARIO("A warning goes with what it warned of, and comes back with it", "[window][handling]") {
    const LogEntry edit{.edit = {.edit = {.id = 4}, .place = {Step::Smoothing, "rp"}},
                        .status = EditStatus::Done,
                        .result = std::make_shared<ResultRecord>(ResultRecord{.id = 9})};
    Snapshot snapshot{.log = {edit}};
    Message warning = make_message(MessageKind::Warning, "the wall is thin");
    warning.edit = 4;
    warning.result = 9;
    CHECK(holds_now(warning, snapshot, "rp", false));
    CHECK_FALSE(holds_now(warning, snapshot, "cfd", false));
    snapshot.log[0].result = std::make_shared<ResultRecord>(ResultRecord{.id = 10});
    CHECK_FALSE(holds_now(warning, snapshot, "rp", false));
    snapshot.log.clear();
    CHECK_FALSE(holds_now(warning, snapshot, "rp", false));
    Message tried = make_message(MessageKind::Warning, "the preview's wall is thin");
    tried.of_preview = true;
    CHECK(holds_now(tried, snapshot, "rp", true));
    CHECK_FALSE(holds_now(tried, snapshot, "rp", false));
    CHECK(holds_now(make_message(MessageKind::Success, "Opened"), snapshot, "cfd", false));
}

SCENARIO("Strokes are one row of the history until they are asked for", "[window][history]") {
    HistoryTree tree = strokes_tree(12);
    const HistoryTree shown = folded(tree, {});
    REQUIRE(shown.rows.size() == 2);
    CHECK(shown.rows[1].strokes == 12);
    CHECK(shown.rows[1].state == 12);
    CHECK(shown.rows[1].current);
    CHECK(shown.rows[1].parent_row == 0);
    CHECK(folded(tree, {shown.rows[1].fold}).rows.size() == 13);
    WHEN("the state is between them") {
        tree.rows[12].current = false;
        tree.rows[5].current = true;
        const HistoryTree split = folded(tree, {});
        REQUIRE(split.rows.size() == 3);
        CHECK(split.rows[1].strokes == 5);
        CHECK(split.rows[2].strokes == 7);
        CHECK(split.rows[2].parent_row == 1);
    }
    WHEN("another branch begins between them") {
        tree.rows.push_back({.state = 13, .column = 1, .parent_row = 4, .title = "smooth"});
        const HistoryTree branched = folded(tree, {});
        REQUIRE(branched.rows.size() == 4);
        CHECK(branched.rows[1].strokes == 4);
        CHECK(branched.rows[3].parent_row == 1);
    }
    WHEN("one has a note") {
        tree.rows[3].note = "the neck";
        CHECK(folded(tree, {}).rows.size() == 4);
    }
}

SCENARIO("The history says whose model a row changes", "[window][history]") {
    Session session = Session::unsaved(session_options());
    session.apply("load-surface", {{"file", tube_file()}, {"units", "mm"}});
    session.apply("subdivide", {}, {.variant = "rp"});
    const HistoryTree tree = history_tree(*session.snapshot());
    CHECK(tree.rows[1].variant.empty());
    CHECK(tree.rows[2].variant == "printing");
}

SCENARIO("Numbers have three digits and separators", "[window][handling]") {
    CHECK(readable_number(0.012345) == "0.0123");
    CHECK(readable_number(12.345) == "12.3");
    CHECK(readable_number(999.7) == "1,000");
    CHECK(readable_number(-12345.6) == "-12,300");
    CHECK(readable_number(0.0) == "0");
    CHECK(grouped(1234567) == "1,234,567");
}
