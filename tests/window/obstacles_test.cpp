// What annoyed people who used the window without having read anything, and stays mended.

#include <algorithm>
#include <filesystem>

#include <catch2/catch.hpp>

#include "geometry/formats/surface_file.h"
#include "geometry/kernel/edges.h"
#include "geometry/kernel/measure.h"
#include "geometry/kernel/whole_file.h"
#include "tests/support/paths.h"
#include "tests/support/program.h"
#include "tests/support/shapes.h"
#include "tests/window/window_support.h"
#include "workbench/window/case/preparation.h"
#include "workbench/window/case/readable.h"
#include "workbench/window/case/unit_question.h"

using namespace vesselbench;
using namespace vesselbench::test;
using namespace std::chrono_literals;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

namespace fs = std::filesystem;

namespace {

/// An artery of 1.5 mm radius in mm, an aorta in cm: the file does not state the unit.
std::string doubtful_file() {
    const std::string file = temporary_folder() + "/vessel.off";
    write_surface(fine_tube(1.5, 20.0, 24), file);
    std::string text = file_content(file);
    for (auto at = text.find('#'); at != std::string::npos; at = text.find('#'))
        text.erase(at, text.find('\n', at) + 1 - at);
    write_file(file, text);
    return file;
}

double length_of(const Document& document) {
    const Bounds box = bounds(*document.shown()->surface);
    return (box.max - box.min).maxCoeff();
}

/// The folder of the bundled phantom's files, without its case: an image and its mask.
fs::path phantom_files() {
    const fs::path folder = fs::path(temporary_folder()) / "tube";
    const auto run = run_program(program_path(), {"phantom", "tube", "--out", folder.string()});
    REQUIRE(run.exit_code == 0);
    return folder;
}

}  // namespace

SCENARIO("A doubtful unit is asked for in the view", "[window][obstacles]") {
    const auto shell = test_shell();
    if (!shell) return;
    open_and_wait(*shell, doubtful_file());
    Workplace& place = shell->app().place();
    REQUIRE(place.unit_question());
    CHECK(place.unit_question()->read == "mm");
    CHECK_THAT(place.unit_question()->doubt, Contains("in cm it is"));
    const double before = length_of(place.document);
    WHEN("another unit is chosen") {
        REQUIRE(shell->click_item("banner.unit.cm"));
        REQUIRE(wait_until_idle(*shell));
        REQUIRE(shell->settle(60s));
        THEN("the file is read in it, and nothing is asked any more") {
            CHECK(length_of(place.document) == Approx(10.0 * before));
            CHECK_FALSE(place.unit_question());
            CHECK_FALSE(shell->has("banner.unit.cm"));
        }
        THEN("undo asks again") {
            place.document.undo();
            REQUIRE(wait_until_idle(*shell));
            REQUIRE(shell->settle(60s));
            CHECK(place.unit_question());
        }
    }
    WHEN("the shown unit is confirmed") {
        REQUIRE(shell->click_item("banner.unit.mm"));
        REQUIRE(wait_until_idle(*shell));
        REQUIRE(shell->settle(60s));
        CHECK(length_of(place.document) == Approx(before));
        CHECK_FALSE(place.unit_question());
    }
}

SCENARIO("What happens while a case is opened is told once, in the window's words",
         "[window][obstacles]") {
    const auto shell = test_shell();
    if (!shell) return;
    open_and_wait(*shell, doubtful_file());
    const auto& messages = shell->app().place().document.messages();
    const auto warns = [](const Message& message) { return message.kind == MessageKind::Warning; };
    CHECK(std::ranges::count_if(messages, warns) == 1);
    for (const Message& message : messages) CHECK_THAT(message.text, !Contains("load-surface"));
}

SCENARIO("A surface that is inside out is said to be, until it is repaired",
         "[window][obstacles]") {
    const auto shell = test_shell();
    if (!shell) return;
    const std::string file = temporary_folder() + "/tube.vtp";
    write_surface(flipped(fine_tube(4.0, 30.0, 24)), file);
    open_and_wait(*shell, file);
    REQUIRE(shell->settle(60s));
    CHECK(shell->has("status.inside_out"));
    shell->app().place().choose("repair");
    shell->app().place().apply();
    REQUIRE(wait_until_idle(*shell));
    REQUIRE(shell->settle(60s));
    CHECK_FALSE(shell->has("status.inside_out"));
}

SCENARIO("A recipe's lines are put in the window's words", "[window][obstacles]") {
    const Message done = message_from("openings: clip-opening (0.3 s): volume -3 %");
    CHECK(done.text == "Clip opening (0.3 s): volume -3 %");
    CHECK(done.kind == MessageKind::Remark);
    const Message noticed = make_message({.code = "opening-in-bend",
                                          .operation = "clip-opening",
                                          .place = Vec3(1, 2, 3),
                                          .figures = {{"turn_deg", 40.0}}});
    CHECK_THAT(noticed.text, Catch::StartsWith("Clip opening: the opening at (1, 2, 3) mm lies"));
    CHECK(noticed.kind == MessageKind::Warning);
    CHECK(noticed.place == Vec3(1, 2, 3));
    CHECK(message_from("read-only: another program has it").text ==
          "read-only: another program has it");
    CHECK(message_from("openings (2)").text == "openings (2)");
}

SCENARIO("A warning of a recipe leads to its edit", "[window][obstacles]") {
    const auto shell = test_shell();
    if (!shell) return;
    const fs::path folder = fs::path(temporary_folder()) / "tube";
    fs::create_directory(folder);
    fs::copy_file(tube_file(), folder / "tube.stl");
    write_text(folder / "case.json", R"({"name": "tube", "surface": "tube.stl", "units": "mm",
        "recipe": [{"operation": "brush-smooth", "arguments":
            {"at": [0, 0, 15], "radius": 1}}]})");
    open_and_wait(*shell, folder.string());
    Workplace& place = shell->app().place();
    place.document.prepare("cfd");
    REQUIRE(wait_until_idle(*shell));
    const EditId brushed = place.document.snapshot()->log.back().edit.edit.id;
    const auto& messages = place.document.messages();
    const auto leads = [&](const Message& message) { return message.edit == brushed; };
    for (const Message& message : messages) UNSCOPED_INFO(message.text);
    CHECK(std::ranges::any_of(messages, leads));
}

SCENARIO("The newest message opens the list of messages", "[window][obstacles]") {
    const auto shell = test_shell();
    if (!shell) return;
    open_and_wait(*shell, doubtful_file());
    REQUIRE_FALSE(shell->has("message.remedy.0"));
    REQUIRE(shell->click_item("status.news"));
    shell->frame();
    CHECK(shell->has("message.remedy.0"));
}

SCENARIO("The start screen says that a case is being opened", "[window][obstacles]") {
    const auto shell = test_shell();
    if (!shell) return;
    shell->frame();
    REQUIRE_FALSE(shell->has("start.opening"));
    shell->app().open(tube_file());
    shell->frame();
    CHECK(shell->has("start.opening"));
    REQUIRE(wait_until_idle(*shell));
}

SCENARIO("An image without a mask offers to add one", "[window][obstacles]") {
    const auto shell = test_shell();
    if (!shell) return;
    const fs::path folder = phantom_files();
    open_and_wait(*shell, (folder / "image.nii.gz").string());
    Workplace& place = shell->app().place();
    REQUIRE(shell->click_item("view.add_mask"));
    REQUIRE(place.question() == FileQuestion::Parameter);
    place.answer(folder / "mask.nii.gz");
    shell->frame();
    REQUIRE(place.form());
    REQUIRE(place.can_apply());
    place.apply();
    REQUIRE(wait_until_idle(*shell));
    REQUIRE(shell->settle(60s));
    CHECK(place.document.shown()->mask);
    CHECK_FALSE(shell->has("view.add_mask"));
}

SCENARIO("A volume mesh is what an export offers first", "[window][obstacles]") {
    const auto shell = test_shell();
    if (!shell) return;
    open_and_wait(*shell, tube_file());
    Workplace& place = shell->app().place();
    place.ask(FileQuestion::Export);
    shell->frame();
    REQUIRE(shell->has("format..stl"));
    CHECK(shell->click_item("file.accept"));
    REQUIRE(wait_until_idle(*shell));
    CHECK(fs::exists(place.document.project().parent_path() / "tube-2.stl"));
    place.document.apply("tetrahedralize", {}, Step::Product);
    REQUIRE(wait_until_idle(*shell));
    REQUIRE(shell->settle(60s));
    REQUIRE(place.document.current()->volume_mesh);
    place.ask(FileQuestion::Export);
    shell->frame();
    CHECK(shell->click_item("file.accept"));
    REQUIRE(wait_until_idle(*shell));
    CHECK(fs::exists(place.document.project().parent_path() / "tube.vtu"));
}

SCENARIO("Units are written with raised digits", "[window][obstacles]") {
    CHECK(readable_unit("mm2") == "mm\u00B2");
    CHECK(readable_unit("mm3") == "mm\u00B3");
    CHECK(readable_unit("1/mm") == "1/mm");
    CHECK(readable_unit("-").empty());
    CHECK(readable_unit("").empty());
}

SCENARIO("A click beside the help closes it", "[window][obstacles]") {
    const auto shell = test_shell();
    if (!shell) return;
    REQUIRE(shell->click_item("tool.help"));
    shell->frame();
    REQUIRE(shell->has("help.close"));
    shell->click(640, 300);
    CHECK(shell->has("help.close"));
    shell->click(60, 600);
    shell->frame();
    CHECK_FALSE(shell->has("help.close"));
}

SCENARIO("The current state stays in sight when the window is made larger and small again",
         "[window][obstacles]") {
    const auto shell = test_shell();
    if (!shell) return;
    open_and_wait(*shell, tube_file());
    Workplace& place = shell->app().place();
    for (int i = 0; i < 6; ++i) {
        place.document.apply("smooth", {{"iterations", Value(std::int64_t{1 + i})}},
                             Step::Smoothing);
        REQUIRE(wait_until_idle(*shell));
    }
    REQUIRE(shell->settle(60s));
    const std::string current =
        "history." + std::to_string(place.document.snapshot()->history->current());
    REQUIRE(shell->has(current));
    shell->resize(2000, 2400);
    REQUIRE(shell->settle(60s));
    shell->resize(1280, 720);
    REQUIRE(shell->settle(60s));
    CHECK(shell->has(current));
}
