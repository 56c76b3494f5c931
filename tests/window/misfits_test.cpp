// Files that the window cannot use: it says why in place, and goes on.

#include <filesystem>
#include <fstream>

#include <catch2/catch.hpp>

#include "geometry/kernel/whole_file.h"
#include "tests/support/paths.h"
#include "tests/support/program.h"
#include "tests/support/shapes.h"
#include "tests/window/walk_support.h"
#include "tests/window/window_support.h"

using namespace vesselbench;
using namespace vesselbench::test;
using Catch::Matchers::Contains;

namespace fs = std::filesystem;

namespace {

/// Opens a file by the dialog, as a user who types its place.
void open_by_dialog(Driver& window, const std::string& button, const fs::path& file) {
    REQUIRE(window.click_item(button));
    REQUIRE(window.fill_item("file.folder", file.parent_path().string()));
    REQUIRE(window.fill_item("file.name", file.filename().string()));
    REQUIRE(window.click_item("file.accept"));
    REQUIRE(window.wait_until_idle());
}

std::string tube_project() {
    const std::string project = temporary_folder() + "/tube.vbench";
    REQUIRE(run_program(program_path(), {"new", project, tube_file()}).exit_code == 0);
    return project;
}

/// A project as a later program would mark it: SQLite's header has the version in byte 60 to 63.
std::string project_of_version_9() {
    const std::string project = tube_project();
    std::fstream file(project, std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(63).put(9);
    return project;
}

std::string cut_project() {
    const std::string project = tube_project();
    fs::resize_file(project, fs::file_size(project) / 3);
    return project;
}

std::string broken_surface() {
    const std::string file = temporary_folder() + "/broken.stl";
    write_text(file, "solid nothing\nfacet normal");
    return file;
}

struct Misfit {
    std::string file;
    std::string message;
};

}  // namespace

SCENARIO("A file that cannot be opened is named with a remedy", "[window][misfits]") {
    const Screen screen = GENERATE(Screen::None, Screen::Display);
    const auto window = window_on(screen);
    if (!window) return;
    const Document& document = document_of(*window);
    const std::vector<Misfit> misfits = {{broken_surface(), "broken.stl"},
                                         {project_of_version_9(), "use the newer program"},
                                         {cut_project(), "use a copy of it"}};
    for (const Misfit& misfit : misfits) {
        const std::string before = file_content(misfit.file);
        open_by_dialog(*window, "start.open", misfit.file);
        CHECK_FALSE(document.is_open());
        REQUIRE(document.failure());
        CHECK_THAT(document.failure()->text, Contains(misfit.message));
        CHECK(file_content(misfit.file) == before);
        REQUIRE(window->click_item("start.dismiss"));
        CHECK_FALSE(document.failure());
    }
    const std::string good = tube_file();
    open_by_dialog(*window, "start.open", good);
    REQUIRE(document.is_open());
    THEN("an open case stays when another file is a misfit") {
        for (const Misfit& misfit : misfits) {
            open_by_dialog(*window, "tool.open", misfit.file);
            CHECK(document.project().parent_path() == fs::path(good).parent_path());
            REQUIRE(document.failure());
            CHECK_THAT(document.failure()->text, Contains(misfit.message));
            REQUIRE(window->click_item("banner.failure.close"));
        }
        REQUIRE(window->settle());
        choose(*window, "smoothing", "smooth");
        apply_form(*window);
        CHECK(edit_count(*window) == 2);
    }
}
