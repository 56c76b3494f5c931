// What is refused is mended by the buttons of its remedies: each fills in what it says.

#include "workbench/window/core/remedies.h"

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>

#include <catch2/catch.hpp>

#include "geometry/formats/surface_file.h"
#include "tests/support/paths.h"
#include "tests/support/shapes.h"
#include "tests/window/window_support.h"
#include "tests/window/workplace_updates.h"

using namespace vesselbench;
using namespace vesselbench::test;
using namespace std::chrono_literals;

namespace {

std::string file_of(const Surface& surface) {
    const std::string file = temporary_folder() + "/surface.vtp";
    write_surface(surface, file);
    return file;
}

/// A workplace without a window, on a project whose edit 1 loads a surface.
struct Desk {
    explicit Desk(const Surface& surface)
        : place({.session = session_options(), .documents = temporary_folder()},
                Settings(temporary_folder()), {.choice = DeviceChoice::Cpu}) {
        const std::filesystem::path project =
            std::filesystem::path(temporary_folder()) / "case.vbench";
        Session::create(project, session_options())
            .apply("load-surface", {{"file", file_of(surface)}, {"units", std::string("mm")}});
        place.open(project);
        REQUIRE(update_until(place, [&] { return document.is_open(); }));
        settle();
    }

    void settle() {
        REQUIRE(update_until(place, [&] { return !document.busy(); }));
    }

    void apply(const std::string& operation, const Arguments& given, Step step) {
        document.apply(operation, given, step);
        settle();
    }

    [[nodiscard]] const LogEntry& edit(std::size_t i) const { return document.snapshot()->log[i]; }

    [[nodiscard]] const OperationForm& form() const {
        REQUIRE(place.form());
        return *place.form();
    }

    Workplace place;
    Document& document = place.document;
};

std::string label(const Message& message, std::size_t i = 0) {
    return remedy_label(message.operation, message.remedies.at(i));
}

}  // namespace

SCENARIO("A refused form gets the value that its remedy names", "[window][remedies]") {
    Desk desk(closed_tube(2.0, 30.0, 40, 90));
    desk.place.choose("remesh");
    desk.place.set_field("mode", "uniform");
    desk.place.set_field("edge", "0.001");
    REQUIRE(update_until(desk.place, [&] { return desk.place.can_apply(); }));
    desk.place.apply();
    desk.settle();
    REQUIRE(desk.document.failure());
    const Message refused = *desk.document.failure();
    REQUIRE(remedies_of(desk.document, refused).size() == 1);
    const std::string edge = refused.remedies[0].arguments.at("edge");
    CHECK(button_of(desk.document, refused) == "Set edge to " + edge + " mm");
    follow(desk.place, *desk.document.failure());
    CHECK(desk.form().field("edge").text == edge);
    CHECK(desk.form().field("mode").text == "uniform");
    CHECK_FALSE(desk.form().edit());
    CHECK_FALSE(desk.document.failure());
    CHECK(desk.document.snapshot()->log.size() == 1);  // the user applies it
}

SCENARIO("A refused change of an edit is mended in the edit's form", "[window][remedies]") {
    Desk desk(closed_tube(2.0, 30.0, 40, 90));
    desk.apply("remesh", {{"mode", std::string("uniform")}, {"edge", 0.5}}, Step::Remeshing);
    REQUIRE_FALSE(desk.document.failure());
    desk.place.choose_edit(2);
    desk.place.set_field("edge", "0.001");
    REQUIRE(update_until(desk.place, [&] { return desk.place.can_apply(); }));
    desk.place.apply();
    desk.settle();
    REQUIRE(desk.document.failure());
    const Message refused = *desk.document.failure();
    REQUIRE(remedies_of(desk.document, refused).size() == 1);
    follow(desk.place, refused);
    CHECK(desk.form().edit() == 2);
    CHECK(desk.form().field("edge").text == refused.remedies[0].arguments.at("edge"));
}

SCENARIO("A remedy that is another operation opens its form", "[window][remedies]") {
    Desk desk(open_tube(2.0, 30.0, 40, 90));
    desk.apply("tetrahedralize", {}, Step::Product);
    REQUIRE(desk.document.failure());
    const Message refused = *desk.document.failure();
    REQUIRE(remedies_of(desk.document, refused).size() == 3);
    CHECK(label(refused, 0) == "Clip opening");
    CHECK(label(refused, 1) == "Fill hole");
    follow(desk.place, refused, refused.remedies[1]);
    CHECK(desk.form().operation().name == "fill-hole");
    CHECK(desk.place.step() == Step::LocalRepair);
    THEN("in the step of what was refused, where it is allowed there") {
        desk.place.choose("remesh");
        Message crossing = refused;
        crossing.operation = "remesh";
        follow(desk.place, crossing, crossing.remedies[2]);
        CHECK(desk.form().operation().name == "repair");
        CHECK(desk.place.step() == Step::Remeshing);
    }
}

SCENARIO("A place that a remedy asks for is picked in the view", "[window][remedies]") {
    Desk desk(icosphere(10.0, 4));
    desk.place.choose("clip-opening");
    desk.apply("clip-opening", {}, Step::Openings);
    REQUIRE(desk.document.failure());
    const Message refused = *desk.document.failure();
    CHECK(button_of(desk.document, refused) == "Pick tip");
    follow(desk.place, refused);
    CHECK(desk.form().operation().name == "clip-opening");
    CHECK(desk.place.armed() == "tip");
}

SCENARIO("A remedy of an edit fills in its form, or changes the case", "[window][remedies]") {
    Desk desk(closed_tube(2.0, 30.0, 40, 90));
    desk.apply("smooth", {{"iterations", Value(std::int64_t{4})}}, Step::Smoothing);
    const auto about_edit = [](const Remedy& remedy) {
        return make_message({.code = "all-kept",
                             .operation = "smooth",
                             .edit = 2,
                             .remedies = {remedy, {.operation = "no-such-operation"}}});
    };
    WHEN("it is another value") {
        const Message message =
            about_edit({.arguments = {{"caps", "smooth"}, {"iterations", "20"}}});
        REQUIRE(remedies_of(desk.document, message).size() == 1);
        CHECK(label(message) == "Set caps to smooth and set iterations to 20");
        follow(desk.place, message);
        CHECK(desk.form().edit() == 2);
        CHECK(desk.form().field("iterations").text == "20");
        CHECK(desk.edit(1).edit.edit.revision == 1);
    }
    WHEN("a value is to be chosen") {
        const Message message = about_edit({.arguments = {{"lambda", ""}, {"staircase", "true"}}});
        CHECK(label(message) == "Change lambda and turn on staircase");
        follow(desk.place, message);
        CHECK(desk.form().edit() == 2);
        CHECK(desk.form().field("staircase").text == "true");
        CHECK(desk.place.wanted_field() == "lambda");
    }
    WHEN("the edit is to choose again") {
        const Message message = about_edit({.action = RemedyAction::ChooseAgain});
        CHECK(button_of(desk.document, message) == "Let Smooth choose again");
        follow(desk.place, message);
        desk.settle();
        CHECK(desk.edit(1).edit.edit.revision == 2);
        CHECK(desk.edit(1).edit.given == Arguments{{"iterations", Value(std::int64_t{4})}});
    }
    WHEN("the edit is to go") {
        const Message message = about_edit({.action = RemedyAction::Remove});
        CHECK(button_of(desk.document, message) == "Remove Smooth");
        follow(desk.place, message);
        desk.settle();
        CHECK(desk.document.snapshot()->log.size() == 1);
        CHECK(button_of(desk.document, message).empty());
    }
    WHEN("this build knows neither the operation nor the parameter") {
        const Message message = about_edit({.arguments = {{"of_tomorrow", "1"}}});
        CHECK(remedies_of(desk.document, message).empty());
        CHECK(button_of(desk.document, message) == "Go to Smooth");
    }
}

SCENARIO("The file of a remedy is asked for in the form of the edit that loads",
         "[window][remedies]") {
    Desk desk(closed_tube(2.0, 30.0, 40, 90));
    const Message message =
        make_message({.code = "no-surface",
                      .operation = "extract-surface",
                      .remedies = {{.operation = "load-surface", .arguments = {{"file", ""}}}}});
    CHECK(label(message) == "Load surface: choose file");
    follow(desk.place, message);
    CHECK(desk.form().edit() == 1);
    CHECK(desk.place.question() == FileQuestion::Parameter);
    CHECK(desk.place.asked_parameter() == "file");
}

SCENARIO("A stale edit offers the remedy of its refusal", "[window][remedies]") {
    Desk desk(closed_tube(2.0, 30.0, 40, 90));
    desk.apply("remesh", {{"mode", std::string("uniform")}, {"edge", 0.5}}, Step::Remeshing);
    REQUIRE_FALSE(desk.document.failure());
    const auto small = [](const Vec3& p) { return Vec3(p / 16.0); };
    const std::string file = file_of(mapped(closed_tube(2.0, 30.0, 40, 90), small));
    desk.document.change(1, {{"file", file}, {"units", std::string("mm")}});
    desk.settle();
    desk.document.run_pending();
    desk.settle();
    REQUIRE(desk.edit(1).status == EditStatus::Stale);
    const Message message = stale_message(desk.edit(1));
    CAPTURE(message.text);
    CHECK(message.text.starts_with("Remesh no longer applies: "));
    CHECK(message.text.find("edge=") == std::string::npos);
    REQUIRE(remedies_of(desk.document, message).size() == 1);
    follow(desk.place, message);
    CHECK(desk.form().edit() == 2);
    CHECK(desk.form().field("edge").text == message.remedies[0].arguments.at("edge"));
    THEN("a project without diagnostics offers the edit alone") {
        LogEntry old = desk.edit(1);
        old.refusal.clear();
        CHECK(remedies_of(desk.document, stale_message(old)).empty());
        CHECK(button_of(desk.document, stale_message(old)) == "Go to Remesh");
    }
}

SCENARIO("The operation's panel has a button for each remedy", "[window][remedies]") {
    const auto shell = test_shell();
    if (!shell) return;
    open_and_wait(*shell, file_of(open_tube(2.0, 30.0, 40, 90)));
    Workplace& place = shell->app().place();
    place.choose("tetrahedralize");
    REQUIRE(shell->settle(60s));
    REQUIRE_FALSE(shell->has("operation.remedy"));
    REQUIRE(shell->click_item("operation.apply"));
    REQUIRE(wait_until_idle(*shell));
    REQUIRE(shell->settle(60s));
    CHECK(shell->has("operation.remedy"));
    REQUIRE(shell->click_item("operation.remedy.1"));
    REQUIRE(place.form());
    CHECK(place.form()->operation().name == "fill-hole");
    CHECK_FALSE(shell->has("operation.remedy"));
}

SCENARIO("A field whose value is to be chosen takes the keyboard", "[window][remedies]") {
    const auto shell = test_shell();
    if (!shell) return;
    open_and_wait(*shell, file_of(closed_tube(2.0, 30.0, 40, 90)));
    Workplace& place = shell->app().place();
    place.choose("smooth");
    follow(place, make_message({.code = "all-kept",
                                .operation = "smooth",
                                .remedies = {{.arguments = {{"iterations", ""}}}}}));
    CHECK(place.wanted_field() == "iterations");
    for (int i = 0; i < 3; ++i) shell->frame();
    CHECK(place.wanted_field().empty());
    shell->type("7");
    shell->frame();
    CHECK(place.form()->field("iterations").text == "7");
}
