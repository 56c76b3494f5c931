#include "workbench/window/app/app.h"

#include <algorithm>
#include <filesystem>
#include <stdexcept>

#include <catch2/catch.hpp>
#include <imgui.h>

#include "tests/support/paths.h"
#include "tests/support/program.h"
#include "tests/support/shapes.h"
#include "tests/window/window_support.h"
#include "workbench/operations/table.h"
#include "workbench/window/keys/keys.h"

using namespace vesselbench;
using namespace vesselbench::test;
using namespace std::chrono_literals;
using Catch::Matchers::Contains;

namespace fs = std::filesystem;

namespace {

std::vector<LogEntry> log_of(const fs::path& project) {
    return Session::open(project, session_options()).log();
}

/// The same edit made by the command line on a project of its own.
Scene by_command_line(const std::string& input, const std::vector<std::string>& edit) {
    const std::string project = temporary_folder() + "/typed.vbench";
    REQUIRE(run_program(program_path(), {"new", project, input}).exit_code == 0);
    std::vector<std::string> words = {"apply", project};
    words.insert(words.end(), edit.begin(), edit.end());
    REQUIRE(run_program(program_path(), words).exit_code == 0);
    return Session::open(project, session_options()).scene();
}

void choose(OffscreenShell& shell, const std::string& step, const std::string& operation) {
    REQUIRE(shell.click_item("rail." + step));
    REQUIRE(shell.click_item("choose." + operation));
}

bool is_enabled(OffscreenShell& shell, const std::string& item) {
    return shell.has(item) && shell.app().ui().items().at(item).enabled;
}

std::size_t edits(OffscreenShell& shell) {
    return shell.app().place().document.snapshot()->log.size();
}

}  // namespace

SCENARIO("An edit made by mouse and keys is the command line's", "[window][app]") {
    const auto shell = test_shell();
    if (!shell) return;
    const std::string input = tube_file();
    open_and_wait(*shell, input);
    const Document& document = shell->app().place().document;
    CHECK(document.project().parent_path() == fs::path(input).parent_path());
    choose(*shell, "smoothing", "smooth");
    REQUIRE(shell->fill_item("field.iterations", "3"));
    REQUIRE(shell->click_item("operation.preview"));
    REQUIRE(wait_until_idle(*shell));
    REQUIRE(document.previewed());
    CHECK(edits(*shell) == 1);
    REQUIRE(shell->click_item("operation.apply"));
    REQUIRE(wait_until_idle(*shell));
    CHECK(edits(*shell) == 2);
    const fs::path project = document.project();
    const Scene shown = *document.shown();
    WHEN("it is undone and done again") {
        REQUIRE(shell->click_item("tool.undo"));
        REQUIRE(wait_until_idle(*shell));
        CHECK(edits(*shell) == 1);
        shell->press_key(keys::letter('Z'), {.control = true, .shift = true});
        REQUIRE(wait_until_idle(*shell));
        CHECK(edits(*shell) == 2);
    }
    shell->app().place().close();
    shell->frame();
    const auto log = log_of(project);
    REQUIRE(log.size() == 2);
    CHECK(log[1].edit.operation == "smooth");
    CHECK(log[1].edit.given == Arguments{{"iterations", Value(std::int64_t{3})}});
    const Scene typed = by_command_line(input, {"smooth", "iterations=3"});
    CHECK(typed.surface->points() == shown.surface->points());
}

SCENARIO("A wrong value shows why and cannot be applied", "[window][app]") {
    const auto shell = test_shell();
    if (!shell) return;
    open_and_wait(*shell, tube_file());
    choose(*shell, "smoothing", "smooth");
    CHECK(is_enabled(*shell, "operation.apply"));
    REQUIRE(shell->fill_item("field.iterations", "-3"));
    CHECK_THAT(shell->app().place().form()->error(), Contains("It must be"));
    CHECK_FALSE(is_enabled(*shell, "operation.apply"));
    CHECK_FALSE(is_enabled(*shell, "operation.preview"));
    REQUIRE(shell->fill_item("field.iterations", "3"));
    CHECK(is_enabled(*shell, "operation.apply"));
}

SCENARIO("The theme is switched and remembered", "[window][app]") {
    const auto shell = test_shell();
    if (!shell) return;
    shell->frame();
    const Picture before = shell->picture();
    CHECK(shell->app().ui().theme.dark);
    REQUIRE(shell->click_item("tool.theme"));
    shell->frame();
    CHECK_FALSE(shell->app().ui().theme.dark);
    CHECK(shell->picture().rgb != before.rgb);
}

SCENARIO("A running operation is cancelled", "[window][app]") {
    const auto shell = test_shell();
    if (!shell) return;
    open_and_wait(*shell, tube_file(96));
    choose(*shell, "smoothing", "smooth");
    REQUIRE(shell->fill_item("field.iterations", "10000"));
    REQUIRE(shell->click_item("operation.apply"));
    REQUIRE(shell->click_item("status.cancel"));
    REQUIRE(wait_until_idle(*shell));
    CHECK(edits(*shell) == 1);
    CHECK(shell->app().place().document.messages().back().text == "Cancelled");
}

SCENARIO("A broken file is refused and the window goes on", "[window][app]") {
    const auto shell = test_shell();
    if (!shell) return;
    const std::string broken = temporary_folder() + "/broken.stl";
    write_text(broken, "solid nothing\nfacet normal");
    shell->app().open(broken);
    REQUIRE(wait_until_idle(*shell));
    const Document& document = shell->app().place().document;
    CHECK_FALSE(document.is_open());
    REQUIRE(document.failure());
    CHECK_THAT(document.failure()->text, Contains("broken.stl"));
    CHECK(names_in(fs::path(broken).parent_path()) == std::vector<std::string>{"broken.stl"});
    REQUIRE(shell->click_item("start.dismiss"));
    CHECK_FALSE(document.failure());
    open_and_wait(*shell, tube_file());
}

SCENARIO("An operation that fails says so in its form", "[window][app]") {
    const auto shell = test_shell();
    if (!shell) return;
    open_and_wait(*shell, tube_file());
    choose(*shell, "branches", "remove-branch");
    REQUIRE(shell->fill_item("field.tip", "500,500,500"));
    REQUIRE(shell->click_item("operation.apply"));
    REQUIRE(wait_until_idle(*shell));
    CHECK(shell->app().place().document.failure());
    CHECK(shell->app().place().form());
    CHECK(edits(*shell) == 1);
}

SCENARIO("An error in the middle of a frame does not close the window", "[window][app]") {
    const auto shell = test_shell();
    if (!shell) return;
    open_and_wait(*shell, tube_file());
    shell->app().place().choose("smooth");
    REQUIRE(shell->settle(60s));
    ImGui::GetIO().SetClipboardTextFn = [](void*, const char*) {
        throw std::runtime_error("the clipboard is gone");
    };
    REQUIRE(shell->click_item("operation.copy"));
    THEN("it is reported, and the window can be used") {
        const auto& messages = shell->app().place().document.messages();
        CHECK(std::ranges::count_if(messages, [](const Message& message) {
                  return message.text.find("the clipboard is gone") != std::string::npos;
              }) == 1);
        REQUIRE(shell->click_item("rail.smoothing"));
        REQUIRE(shell->click_item("choose.smooth"));
        CHECK(shell->has("operation.apply"));
    }
}

SCENARIO("A form that was opened while another one is applied stays", "[window][app]") {
    const auto shell = test_shell();
    if (!shell) return;
    open_and_wait(*shell, tube_file(120));
    Workplace& place = shell->app().place();
    place.choose("smooth");
    place.set_field("iterations", "200");
    place.apply();
    REQUIRE(place.document.activity());
    place.choose("remesh");
    place.set_field("edge", "0.7");
    REQUIRE(wait_until_idle(*shell));
    REQUIRE(place.document.snapshot()->log.size() == 2);
    REQUIRE(place.form());
    CHECK(place.form()->operation().name == "remesh");
    CHECK(place.form()->field("edge").text == "0.7");
}

SCENARIO("The form of an edit is reset to what the edit was given", "[window][app]") {
    const auto shell = test_shell();
    if (!shell) return;
    open_and_wait(*shell, tube_file());
    Workplace& place = shell->app().place();
    place.choose("smooth");
    place.set_field("iterations", "7");
    place.apply();
    REQUIRE(wait_until_idle(*shell));
    place.choose_edit(place.document.snapshot()->log[1].edit.edit.id);
    place.set_field("iterations", "9");
    place.set_field("lambda", "0.4");
    REQUIRE(shell->click_item("operation.reset"));
    CHECK(place.form()->field("iterations").text == "7");
    CHECK(place.form()->field("lambda").text.empty());
}

SCENARIO("A phantom is opened from the start screen", "[window][app]") {
    const auto shell = test_shell();
    if (!shell) return;
    shell->frame();
    REQUIRE(shell->click_item("phantom.tube"));
    REQUIRE(wait_until_idle(*shell));
    const Document& document = shell->app().place().document;
    REQUIRE(document.is_open());
    CHECK(document.project().filename() == "tube.vbench");
    REQUIRE(shell->settle(60s));
    CHECK(document.shown()->image);
    CHECK(shell->click_item("view.extract"));
    CHECK(shell->app().place().form()->operation().name == "extract-surface");
}

SCENARIO("An edit is changed, left out and brought back", "[window][app]") {
    const auto shell = test_shell();
    if (!shell) return;
    open_and_wait(*shell, tube_file());
    choose(*shell, "smoothing", "smooth");
    REQUIRE(shell->fill_item("field.iterations", "1"));
    REQUIRE(shell->click_item("operation.apply"));
    REQUIRE(wait_until_idle(*shell));
    REQUIRE(shell->click_item("rail.edit.2"));
    CHECK(shell->app().place().form()->field("iterations").text == "1");
    REQUIRE(shell->fill_item("field.iterations", "2"));
    REQUIRE(shell->click_item("operation.apply"));
    REQUIRE(wait_until_idle(*shell));
    CHECK(shell->app().place().document.snapshot()->log[1].edit.edit.revision == 2);
    REQUIRE(shell->click_item("rail.edit.2"));
    REQUIRE(shell->click_item("operation.remove"));
    REQUIRE(wait_until_idle(*shell));
    CHECK(edits(*shell) == 1);
    REQUIRE(shell->click_item("tool.undo"));
    REQUIRE(wait_until_idle(*shell));
    CHECK(edits(*shell) == 2);
}

SCENARIO("An idle window does not draw its model again", "[window][app]") {
    const auto shell = test_shell();
    if (!shell) return;
    open_and_wait(*shell, tube_file());
    CHECK(shell->app().is_settled());
    const int drawings = shell->app().drawings();
    for (int i = 0; i < 5; ++i) shell->frame();
    CHECK(shell->app().drawings() == drawings);
    REQUIRE(shell->click_item("view.edges"));
    CHECK(shell->app().drawings() > drawings);
}

SCENARIO("The window begins with what it has to tell", "[window][app]") {
    AppOptions options = app_options();
    options.notice = "The program crashed the last time.";
    if (!test_shell()) return;
    OffscreenShell shell(options, 1280, 720);
    const auto& messages = shell.app().place().document.messages();
    REQUIRE(messages.size() == 1);
    CHECK(messages.back().text == options.notice);
    CHECK(messages.back().kind == MessageKind::Warning);
}
