#include <filesystem>

#include <catch2/catch.hpp>

#include "geometry/formats/surface_file.h"
#include "tests/support/paths.h"
#include "tests/support/program.h"
#include "tests/support/shapes.h"
#include "tests/window/window_support.h"
#include "workbench/window/case/user_folders.h"
#include "workbench/window/keys/keys.h"

using namespace vesselbench;
using namespace vesselbench::test;
using namespace std::chrono_literals;

namespace fs = std::filesystem;

namespace {

const std::string kEndless(300, 'a');  // no file system takes such a name

/// A window that asks for a file, with the folder of its case.
struct Asking {
    explicit Asking(FileQuestion question) : shell(test_shell()) {
        if (!shell) return;
        open_and_wait(*shell, tube_file());
        folder = shell->app().place().document.project().parent_path();
        shell->app().place().ask(question);
        shell->frame();
        REQUIRE(shell->settle(30s));
    }

    [[nodiscard]] bool asks() const {
        return shell->app().place().question() != FileQuestion::None;
    }

    std::unique_ptr<OffscreenShell> shell;
    fs::path folder;
};

}  // namespace

SCENARIO("A name that cannot be used is refused", "[window][files]") {
    Asking window(FileQuestion::Picture);
    if (!window.shell) return;
    REQUIRE(window.shell->fill_item("file.folder", "/" + kEndless + "/x"));
    REQUIRE(window.shell->fill_item("file.name", kEndless));
    REQUIRE(window.shell->click_item("file.accept"));
    CHECK(window.asks());
    WHEN("Esc is pressed") {
        window.shell->press_key(keys::kEscape);
        CHECK_FALSE(window.asks());
    }
    WHEN("a file is to be opened") {
        window.shell->app().place().ask(FileQuestion::Open);
        REQUIRE(window.shell->fill_item("file.name", kEndless));
        REQUIRE(window.shell->click_item("file.accept"));
        CHECK(window.asks());
    }
}

SCENARIO("Enter accepts a name, and a picture gets its suffix", "[window][files]") {
    Asking window(FileQuestion::Picture);
    if (!window.shell) return;
    REQUIRE(window.shell->fill_item("file.name", "side"));
    window.shell->press_key(keys::kEnter);
    CHECK_FALSE(window.asks());
    REQUIRE(window.shell->settle(30s));
    CHECK(fs::exists(window.folder / "side.png"));
    CHECK_FALSE(fs::exists(window.folder / "side"));
}

SCENARIO("A file is opened by Enter or by a double click", "[window][files]") {
    Asking window(FileQuestion::Open);
    if (!window.shell) return;
    OffscreenShell& shell = *window.shell;
    fs::create_directory(window.folder / "inner");
    write_surface(fine_tube(3.0, 20.0, 24), (window.folder / "inner/other.stl").string());
    shell.app().place().ask(FileQuestion::None);
    shell.frame();
    shell.app().place().ask(FileQuestion::Open);
    REQUIRE(shell.settle(30s));
    WHEN("it is a folder that is clicked twice") {
        REQUIRE(shell.click_item("file.entry.inner"));
        REQUIRE(shell.settle(30s));
        REQUIRE(shell.click_item("file.entry.other.stl"));
        THEN("nothing in it is opened") {
            CHECK(window.asks());
        }
    }
    WHEN("the path is typed") {
        REQUIRE(shell.fill_item("file.folder", (window.folder / "inner/other.stl").string()));
        shell.press_key(keys::kEnter);
        CHECK_FALSE(window.asks());
        REQUIRE(wait_until_idle(shell));
        CHECK(shell.app().place().document.project().stem() == "other");
    }
    WHEN("it is clicked twice") {
        REQUIRE(shell.fill_item("file.folder", (window.folder / "inner").string()));
        shell.press_key(keys::kEnter);
        REQUIRE(shell.settle(30s));
        REQUIRE(shell.click_item("file.entry.other.stl"));
        CHECK(window.asks());
        REQUIRE(shell.click_item("file.entry.other.stl"));
        CHECK_FALSE(window.asks());
    }
    REQUIRE(wait_until_idle(shell));
}

SCENARIO("The slices of a DICOM folder are opened together", "[window][files]") {
    const std::string series = shared_data("images/dicom_series");
    if (series.empty()) return;
    Asking window(FileQuestion::Open);
    if (!window.shell) return;
    OffscreenShell& shell = *window.shell;
    CHECK_FALSE(shell.has("file.dicom"));
    // Not beside the shared data: the project is written next to what is opened.
    fs::copy(series, window.folder / "series");
    REQUIRE(shell.fill_item("file.folder", (window.folder / "series").string()));
    REQUIRE(shell.settle(30s));
    REQUIRE(shell.click_item("file.dicom"));
    CHECK_FALSE(window.asks());
    REQUIRE(wait_until_idle(shell));
    const Document& document = shell.app().place().document;
    REQUIRE(document.is_open());
    CHECK(document.shown()->image.has_value());
}

SCENARIO("A free name is numbered", "[window][files]") {
    const fs::path folder = temporary_folder();
    CHECK(free_file(folder / "a.png") == folder / "a.png");
    write_text((folder / "a.png").string(), "");
    write_text((folder / "a-2.png").string(), "");
    CHECK(free_file(folder / "a.png") == folder / "a-3.png");
    CHECK(free_file(folder / kEndless) == folder / kEndless);
}
