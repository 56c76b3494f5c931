#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <filesystem>

#include <catch2/catch.hpp>
#include <imgui.h>

#include "tests/support/program.h"
#include "tests/support/shapes.h"
#include "tests/window/window_support.h"
#include "workbench/case/argument_texts.h"
#include "workbench/operations/table.h"
#include "workbench/report/log_json.h"
#include "workbench/window/case/argument_words.h"
#include "workbench/window/case/history_tree.h"
#include "workbench/window/case/local_time.h"
#include "workbench/window/case/message.h"
#include "workbench/window/case/rail.h"
#include "workbench/window/case/readable.h"
#include "workbench/window/case/user_folders.h"
#include "workbench/window/core/settings.h"
#include "workbench/window/drawing/view_choice.h"
#include "workbench/window/drawing/view_overlays.h"
#include "workbench/window/features/history/history_columns.h"
#include "workbench/window/panels/folder_listing.h"
#include "workbench/window/widgets/controls.h"

using namespace vesselbench;
using namespace vesselbench::test;
using Catch::Matchers::Contains;

namespace fs = std::filesystem;

namespace {

const Arguments kGentle = {{"iterations", Value(std::int64_t{1})}};

Session tube_session() {
    Session session = Session::unsaved(session_options());
    session.apply("load-surface", {{"file", tube_file()}, {"units", "mm"}});
    return session;
}

}  // namespace

SCENARIO("The rail lists the steps with their edits and states", "[window][rail]") {
    Session session = tube_session();
    session.apply("smooth", kGentle);
    const auto rail = rail_of(*session.snapshot(), "cfd");
    REQUIRE(rail.size() == 9);
    CHECK(rail[0].title == "Source");
    CHECK(rail[0].edits.size() == 1);
    CHECK(rail[1].state == StepState::Empty);
    REQUIRE(rail[4].edits.size() == 1);
    CHECK(rail[4].edits[0].operation == "smooth");
    CHECK(rail[4].edits[0].arguments == "iterations 1");
    WHEN("an earlier edit is left out") {
        const EditId repair = session.apply("repair", {}).edit.edit.id;
        session.remove_edit(repair);
        session.apply("smooth", kGentle, {.step = Step::Source});
        const auto changed = rail_of(*session.snapshot(), "cfd");
        CHECK(changed[4].state == StepState::Pending);
        CHECK(pending_count(*session.snapshot(), "cfd") == 1);
    }
}

SCENARIO("Strokes of one brush that follow one another are one row", "[window][rail]") {
    Session session = tube_session();
    const Arguments dab = {{"at", Value(Vec3(4, 0, 15))}, {"radius", Value(2.0)}};
    for (const char* brush : {"brush-inflate", "brush-inflate", "brush-smooth", "brush-inflate"})
        session.apply(brush, dab);
    const RailStep step = rail_of(*session.snapshot(), "cfd")[2];
    REQUIRE(step.edits.size() == 4);
    const std::vector<RailRow> rows = rail_rows(step);
    REQUIRE(rows.size() == 3);
    CHECK(rows[0].count == 2);
    CHECK(rows[1].first == 2);
    CHECK(rows[2].count == 1);
    CHECK(state_of(step, rows[0]) == std::max(state_of(step.edits[0]), state_of(step.edits[1])));
}

SCENARIO("Every step is listed: it has operations, or is the review", "[window][rail]") {
    const Session session = tube_session();
}

SCENARIO("Long lists of arguments are counted", "[window][rail]") {
    const Arguments stroke = {{"dabs", Records(std::vector<Arguments>(80))}};
    CHECK(argument_summary(find_operation("brush-inflate"), stroke) == "dabs=(80 records)");
    const Arguments ends = {{"open", std::vector<double>(30, 1.5)}};
    CHECK(argument_summary(find_operation("clip-opening"), ends) == "open=(30 numbers)");
    const Arguments box = {{"box", Value(std::vector<double>{1, 2, 3, 4, 5, 6})}};
    CHECK(argument_summary(find_operation("crop"), box) == "box=1,2,3,4,5,6");
}

SCENARIO("Lists have the window's words for arguments, not the command line's", "[window][rail]") {
    const auto words = [](const char* operation, const Arguments& arguments) {
        return argument_words(find_operation(operation), arguments);
    };
    CHECK(words("smooth", {}).empty());
    CHECK(words("smooth", {{"find_caps", Value(false)}, {"iterations", Value(std::int64_t{5})}}) ==
          "iterations 5, find caps: no");
    CHECK(words("remesh", {{"edge", 0.25}}) == "edge 0.25 mm");
    CHECK(words("brush-inflate", {{"dabs", Records(std::vector<Arguments>(80))}}) == "80 dabs");
    CHECK(words("clip-opening", {{"open", std::vector<double>(30, 1.5)}}) == "open: 10 places");
    CHECK(words("crop", {{"box", Value(std::vector<double>{1, 2, 3, 4, 5, 6})}}) ==
          "box 1, 2, 3, 4, 5, 6 mm");
}

SCENARIO("What an operation says of its result precedes what it changed", "[window][rail]") {
    ResultRecord result{.report = R"({"headline":"threshold 60","triangles":2})"};
    CHECK(effect_text(result) == "threshold 60");
    result.change.triangles_before = 1;
    result.change.triangles_after = 2;
    CHECK(effect_text(result) == "threshold 60, 1 -> 2 triangles");
    result.change = {.largest_deviation = 0.92,
                     .triangles_before = 2,
                     .triangles_after = 2,
                     .moved_vertices = 5};
    CHECK(effect_text(result) == "threshold 60, moved up to 0.920 mm");
    // Along the surface they may move as they like.
    result.report = R"({"local_error":{"mean_mm":0.1,"largest_mm":0.31}})";
    CHECK(effect_text(result) == "distance up to 0.310 mm");
    result.change = {.triangles_before = 1, .triangles_after = 2};
    result.report = R"({"headline":7})";
    CHECK(effect_text(result) == "1 -> 2 triangles");
    result.report.clear();
    CHECK(effect_text(result) == "1 -> 2 triangles");
}

SCENARIO("Edits of another variant are not in the rail", "[window][rail]") {
    Session session = tube_session();
    session.apply("subdivide", {}, {.variant = "rp"});
    CHECK(rail_of(*session.snapshot(), "cfd")[6].edits.empty());
    CHECK(rail_of(*session.snapshot(), "rp")[6].edits.size() == 1);
}

SCENARIO("The history is a tree whose branches keep their places", "[window][history]") {
    Session session = tube_session();
    session.apply("smooth", kGentle);
    session.undo();
    session.apply("repair", {});
    const HistoryTree tree = history_tree(*session.snapshot());
    REQUIRE(tree.rows.size() == 4);
    CHECK(tree.rows[0].title == "empty case");
    CHECK(tree.rows[1].title == "load-surface");
    CHECK(tree.rows[1].author == "Ada");
    CHECK(tree.columns == 2);
    const auto current =
        std::ranges::find_if(tree.rows, [](const HistoryRow& row) { return row.current; });
    REQUIRE(current != tree.rows.end());
    CHECK(current->title == "repair");
    CHECK(current->column == 1);
    const auto other = std::ranges::find_if(
        tree.rows, [](const HistoryRow& row) { return row.title == "smooth"; });
    REQUIRE(other != tree.rows.end());
    CHECK_FALSE(other->on_path);
    CHECK(other->arguments == "iterations 1");
    CHECK(tree.can_undo);
    CHECK(tree.undo_title == "repair");
    CHECK_FALSE(tree.can_redo);
    session.undo();
    CHECK(history_tree(*session.snapshot()).redo_title == "repair");
}

SCENARIO("The history gives each state the figures of its own run", "[window][history]") {
    Session session = tube_session();
    const LogEntry finer = session.apply("subdivide", {});
    const std::string own = effect_text(*finer.result);
    session.apply("subdivide", {}, {.step = Step::Source});
    REQUIRE(session.log()[2].status == EditStatus::Pending);
    (void)session.scene();
    REQUIRE(effect_text(*session.log()[2].result) != own);
    const auto row_of = [&](StateId state) {
        const HistoryTree tree = history_tree(*session.snapshot());
        return *std::ranges::find(tree.rows, state, &HistoryRow::state);
    };
    CHECK(row_of(2).change == own);
    WHEN("the edit is removed") {
        session.remove_edit(finer.edit.edit.id);
        const HistoryRow removal = row_of(session.snapshot()->history->current());
        THEN("the removal does not repeat the edit's author, time and figures") {
            CHECK(removal.title == "removed subdivide");
            CHECK(removal.change.empty());
            CHECK(removal.author.empty());
            CHECK(removal.time.empty());
        }
    }
    WHEN("the project is saved and opened") {
        const std::string file = temporary_folder() + "/figures.vbench";
        session.save_as(file);
        const Session opened = Session::open(file, session_options());
        const HistoryTree tree = history_tree(*opened.snapshot());
        CHECK(std::ranges::find(tree.rows, 2, &HistoryRow::state)->change == own);
    }
}

SCENARIO("The history's columns give way to the name", "[window][history]") {
    HistoryColumns wider = history_columns(80);
    CHECK(wider.change > 20);
    CHECK(wider.author > 0);
    for (float room = 80; room >= 0; room -= 0.25F) {
        const HistoryColumns columns = history_columns(room);
        CHECK(columns.name + columns.change + columns.author + columns.time == Approx(room));
        CHECK(columns.change <= wider.change + 6.0F);  // it may take over what the author leaves
        if (columns.author > 0) CHECK(columns.change > 0);
        if (columns.change > 0) CHECK(columns.time > 0);
        if (columns.time > 0) CHECK(columns.name >= 11.0F);
        wider = columns;
    }
    CHECK(history_columns(15).time == 0);
    CHECK(history_columns(15).name == 15);
}

SCENARIO("A message has the remedies of its diagnostic, a text alone has none",
         "[window][messages]") {
    CHECK(make_message(MessageKind::Error, "use repair").remedies.empty());
    const Diagnostic gap{.code = "surface-gap",
                         .severity = Severity::Error,
                         .operation = "tetrahedralize",
                         .place = Vec3(1, 0, 0),
                         .figures = {{"count", 3.0}},
                         .words = {{"places", "(1, 0, 0) mm"}},
                         .remedies = {{.operation = "fill-hole"}, {.arguments = {{"edge", "1"}}}}};
    const Message failed = make_message(gap);
    CHECK(failed.kind == MessageKind::Error);
    REQUIRE(failed.remedies.size() == 2);
    CHECK(failed.remedies[0].operation == "fill-hole");
    CHECK(failed.remedies[1].operation == "tetrahedralize");
    CHECK(failed.place == Vec3(1, 0, 0));
}

SCENARIO("Settings remember recent projects", "[window][settings]") {
    const std::string folder = temporary_folder();
    for (const char* name : {"/a.vbench", "/b.vbench"}) write_text(folder + name, "");
    Settings settings(folder + "/config");
    settings.remember(folder + "/a.vbench");
    settings.remember(folder + "/b.vbench");
    settings.remember(folder + "/a.vbench");
    settings.dark = false;
    settings.reviewer = "A. Kern";
    settings.reviewer_role = "radiologist";
    REQUIRE(settings.save());
    CHECK(fs::status(folder + "/config/settings.json").permissions() ==
          (fs::perms::owner_read | fs::perms::owner_write));
    fs::remove(folder + "/b.vbench");
    const Settings again(folder + "/config");
    CHECK_FALSE(again.dark);
    CHECK(again.reviewer == "A. Kern");
    CHECK(again.reviewer_role == "radiologist");
    REQUIRE(again.recent().size() == 2);
    CHECK(again.recent()[0].file.filename() == "a.vbench");
    CHECK_FALSE(again.recent()[0].missing);
    CHECK(again.recent()[1].missing);
    WHEN("the file is damaged") {
        write_text(folder + "/config/settings.json", "{\"recent\": [1, 2");
        const Settings defaults(folder + "/config");
        CHECK(defaults.recent().empty());
        CHECK(defaults.dark);
    }
}

SCENARIO("Of settings that are saved in the background, the last ones count",
         "[window][settings]") {
    const std::string folder = temporary_folder();
    {
        Settings settings(folder);
        for (const double scale : {0.75, 1.25, 2.0}) {
            settings.scale = scale;
            settings.save_soon();
        }
    }
    CHECK(Settings(folder).scale == 2.0);
}

SCENARIO("The size of the text is remembered", "[window][settings]") {
    const std::string folder = temporary_folder();
    Settings settings(folder);
    settings.change_scale(1);
    CHECK(settings.scale == 1.1);
    settings.change_scale(100);
    CHECK(settings.scale == 2.5);
    REQUIRE(settings.save());
    CHECK(Settings(folder).scale == 2.5);
    settings.change_scale(-100);
    CHECK(settings.scale == 0.75);
}

SCENARIO("A listing has folders first and only files that can be opened", "[window][files]") {
    const std::string folder = temporary_folder();
    fs::create_directories(folder + "/zebra");
    fs::create_directories(folder + "/case");
    write_text(folder + "/case/case.json", "{}");
    for (const char* name : {"/b.STL", "/A.nii.gz", "/notes.txt", "/.hidden.stl"})
        write_text(folder + name, "x");
    const FolderListing listing = list_folder(folder, openable_suffixes());
    std::vector<std::string> names;
    for (const FolderEntry& entry : listing.entries) names.push_back(entry.name);
    CHECK(names == std::vector<std::string>{"case", "zebra", "A.nii.gz", "b.STL"});
    CHECK(listing.entries[0].openable_folder);
    CHECK_FALSE(listing.entries[1].openable_folder);
    CHECK_THAT(list_folder(folder + "/none", {}).error, Contains("none"));
}

SCENARIO("A link that leads nowhere is no obstacle to a listing", "[window][files]") {
    const std::string folder = temporary_folder();
    fs::create_symlink("loop", folder + "/loop");
    fs::create_symlink("none", folder + "/lost.stl");
    write_text(folder + "/b.stl", "x");
    const FolderListing listing = list_folder(folder, openable_suffixes());
    CHECK(listing.error.empty());
    REQUIRE(listing.entries.size() == 2);
    CHECK(listing.entries[0].name == "b.stl");
}

SCENARIO("Times of the log are shown by the user's clock", "[window][history]") {
    const char* before = std::getenv("TZ");
    const std::string kept = before == nullptr ? "" : before;
    ::setenv("TZ", "XXX-03:30", 1);
    ::tzset();
    CHECK(local_time("2024-05-17T22:15:00Z", "%Y-%m-%d %H:%M") == "2024-05-18 01:45");
    CHECK(local_time("some day", "%H:%M") == "some day");
    before == nullptr ? ::unsetenv("TZ") : ::setenv("TZ", kept.c_str(), 1);
    ::tzset();
}

SCENARIO("A new project never replaces a file", "[window][files]") {
    const std::string folder = temporary_folder(), other = temporary_folder();
    write_text(folder + "/scan.nii.gz", "");
    CHECK(new_project_file(folder + "/scan.nii.gz", true, other) ==
          fs::path(folder) / "scan.vbench");
    write_text(folder + "/scan.vbench", "");
    CHECK(new_project_file(folder + "/scan.nii.gz", true, other) ==
          fs::path(folder) / "scan-2.vbench");
    CHECK(new_project_file(folder + "/scan.nii.gz", false, other) ==
          fs::path(other) / "scan.vbench");
}

SCENARIO("A scale bar has a round length", "[window][view]") {
    CHECK(scale_length(0.99).text == "0.5 mm");
    CHECK(scale_length(1.0).text == "1 mm");
    CHECK(scale_length(49.0).text == "20 mm");
    CHECK(scale_length(0.0).text.empty());
}

SCENARIO("Names of the command line are made readable", "[window]") {
    CHECK(readable("clip-opening") == "Clip opening");
    CHECK(readable("tau_max") == "Tau max");
    CHECK(readable("").empty());
}

SCENARIO("Typed numbers are read as a whole or not at all", "[window]") {
    CHECK(typed_number(" 1.5 ") == 1.5);
    CHECK(typed_number("+2e-3") == 0.002);
    for (const char* text : {"", " ", "+", "1,5", "2 mm", "nan", "inf"}) {
        INFO(text);
        CHECK_FALSE(typed_number(text));
    }
}

SCENARIO("The section of a volume mesh shows its cells", "[window][view]") {
    ViewChoice view;
    view.switch_clip(true);
    CHECK(view.clip.on);
    CHECK(view.colouring == ColouringKind::TetrahedraQuality);
    view.switch_clip(true);
    CHECK_FALSE(view.clip.on);
    CHECK(view.colouring == ColouringKind::Patches);
    view.choose(ColouringKind::MeanCurvature);
    view.switch_clip(true);
    CHECK(view.colouring == ColouringKind::MeanCurvature);
    ViewChoice surface;
    surface.switch_clip(false);
    CHECK(surface.colouring == ColouringKind::Patches);
}

SCENARIO("A typed range is of one quantity", "[window][view]") {
    ViewChoice view;
    view.draw_as({ColouringKind::MeanCurvature}, ValueRange{-1, 2});
    CHECK_FALSE(view.range());
    view.least = "0.5";
    CHECK(view.range() == ValueRange{0.5, 2});
    view.most = "0.4";
    CHECK_FALSE(view.range());
    view.most = "1";
    view.draw_as({ColouringKind::MeanCurvature}, ValueRange{-3, 3});
    CHECK(view.range() == ValueRange{0.5, 1});
    WHEN("a comparison colours the model") {
        view.draw_as({ColouringKind::MeanCurvature, true}, ValueRange{-0.1, 0.1});
        CHECK_FALSE(view.has_typed_range());
    }
    WHEN("another quantity is chosen") {
        view.choose(ColouringKind::Deviation);
        CHECK_FALSE(view.has_typed_range());
    }
}

SCENARIO("A text is broken at blanks, not within numbers", "[window]") {
    const auto shell = test_shell();
    if (!shell) return;
    shell->frame();
    const std::string words = "at (12.345,-6.789, 101.112) mm, 3.5 mm wide\nand more";
    CHECK(broken(words, 1e6F) == words);
    CHECK(broken(words, 1) == "at\n(12.345,-6.789,\n101.112)\nmm,\n3.5\nmm\nwide\nand\nmore");
    const std::string lines = broken(words, 120);
    CHECK(ImGui::CalcTextSize(lines.c_str()).x <= 120);
    CHECK(broken(lines, 120) == lines);
    CHECK(broken("", 10).empty());
}

SCENARIO("A text is shortened to whole characters", "[window]") {
    const auto shell = test_shell();
    if (!shell) return;
    shell->frame();
    CHECK(fitted("short", 500) == "short");
    std::string endless;
    for (int i = 0; i < 5000; ++i) endless += "\u00F8 1.5 mm, ";
    const std::string shorter = fitted(endless, 200);
    CHECK(shorter.size() < 100);
    CHECK(shorter.ends_with("\u2026"));
    CHECK(fitted(shorter, 200) == shorter);
    CHECK(fitted(endless, -5) == "\u2026");
    for (int width = 60; width < 100; ++width) {
        const std::string part = fitted(endless, static_cast<float>(width));
        const auto before = static_cast<unsigned char>(part[part.size() - 4]);
        CHECK(before != 0xC3);  // the first half of a character
    }
}
