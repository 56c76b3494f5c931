#include <filesystem>

#include <catch2/catch.hpp>

#include "geometry/formats/surface_file.h"
#include "geometry/kernel/whole_file.h"
#include "tests/support/paths.h"
#include "tests/support/shapes.h"
#include "tests/window/review_support.h"
#include "tests/window/window_support.h"
#include "workbench/export/products.h"
#include "workbench/session/stored_texts.h"

using namespace vesselbench;
using namespace vesselbench::test;
using namespace std::chrono_literals;

namespace fs = std::filesystem;

namespace {

void ask_for_export(OffscreenShell& shell, const std::string& name) {
    shell.app().place().ask(FileQuestion::Export);
    shell.frame();
    REQUIRE(shell.settle(30s));
    REQUIRE(shell.fill_item("file.name", name));
}

void press_export(OffscreenShell& shell) {
    REQUIRE(shell.click_item("file.accept"));
    REQUIRE(wait_until_idle(shell));
    REQUIRE(shell.settle(60s));
}

bool asks(OffscreenShell& shell) {
    return shell.app().place().question() == FileQuestion::Export;
}

/// A tube whose ends are an inlet and an outlet, filled with tetrahedra.
std::unique_ptr<OffscreenShell> filled_tube() {
    auto shell = test_shell();
    if (!shell) return nullptr;
    const std::string file = temporary_folder() + "/tube.vtp";
    write_surface(fine_tube(4.0, 30.0, 24), file);
    open_and_wait(*shell, file);
    Document& document = shell->app().place().document;
    document.apply("tetrahedralize", {}, Step::Product);
    REQUIRE(wait_until_idle(*shell));
    REQUIRE(shell->settle(60s));
    return shell;
}

}  // namespace

SCENARIO("A model that nobody reviewed is exported at once", "[window][export]") {
    const auto shell = reviewed_tube();
    if (!shell) return;
    ask_for_export(*shell, "model.stl");
    press_export(*shell);
    CHECK_FALSE(asks(*shell));
    CHECK(fs::exists(beside_project(*shell, "model.stl")));
}

SCENARIO("The export of a rejected model asks first", "[window][export][review]") {
    const auto shell = reviewed_tube();
    if (!shell) return;
    import_roth(*shell);
    ask_for_export(*shell, "model.stl");
    press_export(*shell);
    CHECK(asks(*shell));
    CHECK_FALSE(fs::exists(beside_project(*shell, "model.stl")));
    WHEN("Export is pressed again") {
        press_export(*shell);
        THEN("it is written, and its header says that it was rejected") {
            CHECK_FALSE(asks(*shell));
            REQUIRE(fs::exists(beside_project(*shell, "model.stl")));
        }
    }
    WHEN("another name is given") {
        REQUIRE(shell->fill_item("file.name", "other.stl"));
        press_export(*shell);
        CHECK(asks(*shell));
    }
}

SCENARIO("The acceptance that a project requires holds in the window", "[window][export][review]") {
    const auto shell = reviewed_tube();
    if (!shell) return;
    Document& document = shell->app().place().document;
    store_text(document.project(), StoredText::Acceptance, R"({"cfd": 1})");
    ask_for_export(*shell, "model.stl");
    for (int i = 0; i < 2; ++i) press_export(*shell);
    CHECK(asks(*shell));
    CHECK_FALSE(fs::exists(beside_project(*shell, "model.stl")));
    WHEN("the dialog is passed by") {
        document.export_to(beside_project(*shell, "model.stl"));
        REQUIRE(wait_until_idle(*shell));
        CHECK_FALSE(fs::exists(beside_project(*shell, "model.stl")));
        REQUIRE(document.failure());
        CHECK_THAT(document.failure()->text, Catch::Contains("review is not complete"));
    }
}

SCENARIO("An OpenFOAM case takes the flow that is entered beside its name", "[window][export]") {
    const auto shell = filled_tube();
    if (!shell) return;
    ask_for_export(*shell, "case");
    REQUIRE(shell->settle(30s));
    REQUIRE(shell->fill_item("export.flow.flow", "0.5"));
    REQUIRE(shell->click_item("export.flow.profile"));
    REQUIRE(shell->click_item("export.flow.profile=plug"));
    shell->frame();
    press_export(*shell);
    const Document& document = shell->app().place().document;
    for (const Message& message : document.messages()) UNSCOPED_INFO(message.text);
    const fs::path written = beside_project(*shell, "case");
    REQUIRE(fs::exists(written / "0/U"));
    const CfdParameters kept =
        FlowSettings(stored_text(document.project(), StoredText::Flow)).parameters();
    CHECK(kept.flow == 0.5);
    CHECK(kept.profile == InflowProfile::Plug);
    CHECK_THAT(file_content(written / "README"), Catch::Contains("0.5"));
    WHEN("the next case is exported") {
        ask_for_export(*shell, "other");
        press_export(*shell);
        THEN("it has the same flow") {
            CHECK(file_content(beside_project(*shell, "other") / "0/U") ==
                  file_content(written / "0/U"));
        }
    }
    WHEN("a flow is no number") {
        ask_for_export(*shell, "other");
        REQUIRE(shell->fill_item("export.flow.flow", "much"));
        press_export(*shell);
        CHECK(asks(*shell));
    }
}
