// Every operation of the table is reached, previewed, applied, changed and undone by mouse and
// keys.

#include <algorithm>
#include <filesystem>
#include <set>

#include <catch2/catch.hpp>

#include "geometry/formats/surface_file.h"
#include "tests/support/paths.h"
#include "tests/support/program.h"
#include "tests/support/shapes.h"
#include "tests/window/walk_support.h"
#include "tests/window/window_support.h"
#include "workbench/operations/table.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace fs = std::filesystem;

namespace {

using Texts = std::vector<std::pair<std::string, std::string>>;  ///< field and its text

/// How an operation is tried.
struct Trial {
    std::string operation;
    std::string input;  ///< "tube", "open", "image", "y" or "opened"
    Texts given;
    Texts changed;  ///< for its next revision
};

/// The files that trials open and name, beside the projects: changed edits find them again there.
class Files {
public:
    Files() : folder_(temporary_folder()) {
        write_surface(fine_tube(4.0, 30.0, 24), path("tube.vtp"));
        write_surface(open_tube(4.0, 30.0, 24, 28), path("open.stl"));
        write_surface(mapped(fine_tube(1.0, 30.0, 12),
                             [](const Vec3& p) { return Vec3(p + Vec3(8.0, 0.0, 0.0)); }),
                      path("neighbour.stl"));
        run({"phantom", "tube", "--out", path("phantom")});
        fs::copy_file(path("phantom/image.nii.gz"), image());
        run({"phantom", "y", "--out", path("y")});
        run({"new", path("opened.vbench"), path("y/exact.vtp")});
        run({"apply", path("opened.vbench"), "clip-opening"});
    }

    [[nodiscard]] std::string path(const std::string& name) const { return folder_ + "/" + name; }

    /// What to open for a trial.
    [[nodiscard]] std::string input(const std::string& name) const {
        if (name == "tube") return path("tube.vtp");
        if (name == "open") return path("open.stl");
        if (name == "image") return image();
        return path(name == "y" ? "y/exact.vtp" : "opened.vbench");
    }

    [[nodiscard]] std::string image() const { return path("image.nii.gz"); }

private:
    static void run(const std::vector<std::string>& words) {
        const ProgramRun made = run_program(program_path(), words);
        INFO(made.err);
        REQUIRE(made.exit_code == 0);
    }

    std::string folder_;
};

std::vector<Trial> trials(const Files& files) {
    const std::string side = "4,0,15", end = "0,0,-20";
    return {
        {"load-surface", "tube", {{"file", files.path("open.stl")}}, {{"units", "mm"}}},
        {"load-image", "tube", {{"file", files.image()}}, {{"units", "mm"}}},
        {"load-neighbour",
         "tube",
         {{"name", "bone"}, {"file", files.path("neighbour.stl")}},
         {{"name", "vein"}}},
        {"extract-surface", "image", {{"resample", "0.8"}}, {{"gaussian", "0.5"}}},
        {"crop", "tube", {{"box", "-9,-9,5,9,9,40"}}, {{"box", "-9,-9,9,9,9,40"}}},
        {"keep-component", "tube", {{"count", "1"}}, {{"count", "2"}}},
        {"repair", "open", {}, {{"smallest_feature", "0.002"}}},
        {"remove-branch", "y", {{"tip", "11.5,0,16.4"}}, {{"margin", "0.5"}}},
        {"brush-smooth", "tube", {{"at", side}, {"radius", "2"}}, {{"strength", "0.4"}}},
        {"brush-inflate", "tube", {{"at", side}, {"radius", "2"}}, {{"strength", "-0.4"}}},
        {"brush-weight", "tube", {{"at", side}, {"radius", "2"}}, {{"attribute", "plaque"}}},
        {"fill-hole", "open", {}, {{"near", "0,0,30"}}},
        {"widen", "tube", {{"width", "9"}}, {{"width", "9.5"}}},
        {"clip-opening", "y", {{"tip", end}, {"radii", "3"}}, {{"radii", "4"}}},
        {"extrude-opening", "opened", {{"diameters", "2"}}, {{"diameters", "1"}}},
        {"smooth", "tube", {{"iterations", "2"}}, {{"filter", "taubin"}}},
        {"remesh", "tube", {{"edge", "2"}, {"radius", "rays"}}, {{"mode", "uniform"}}},
        {"decimate", "tube", {{"share", "0.6"}}, {{"share", "0.5"}}},
        {"subdivide", "tube", {}, {{"iterations", "2"}}},
        {"tetrahedralize", "tube", {{"improve", "1"}}, {{"growth", "0.3"}}},
        {"print-check", "tube", {}, {{"thinnest", "1"}}},
    };
}

void fill(Driver& window, const Texts& texts) {
    for (const auto& [field, text] : texts) {
        INFO(field << "=" << text);
        REQUIRE(window.fill_item("field." + field, text));
        REQUIRE(window.app().place().form()->field(field).text == text);
    }
}

/// The newest edit of the current state.
LogEntry newest(Driver& window) {
    return *std::ranges::max_element(document_of(window).snapshot()->log, {},
                                     [](const LogEntry& entry) { return entry.edit.edit.id; });
}

void preview(Driver& window) {
    REQUIRE(window.click_item("operation.preview"));
    REQUIRE(window.wait_until_idle());
    INFO((document_of(window).failure() ? document_of(window).failure()->text : "no failure"));
    REQUIRE(document_of(window).previewed());
    CHECK(window.settle());
}

void undo(Driver& window) {
    REQUIRE(window.click_item("tool.undo"));
    REQUIRE(window.wait_until_idle());
    REQUIRE(window.settle());
}

void try_out(Driver& window, const Trial& trial) {
    const std::size_t edits = edit_count(window);
    choose(window, to_string(find_operation(trial.operation).usual_step), trial.operation);
    fill(window, trial.given);
    preview(window);
    CHECK(edit_count(window) == edits);
    apply_form(window);
    REQUIRE(edit_count(window) == edits + 1);
    const LogEntry made = newest(window);
    CHECK(made.edit.operation == trial.operation);
    for (const auto& [field, text] : trial.given) CHECK(made.edit.given.has(field));
    REQUIRE(window.click_item("rail.edit." + std::to_string(made.edit.edit.id)));
    fill(window, trial.changed);
    preview(window);
    apply_form(window);
    const LogEntry changed = newest(window);
    CHECK(changed.edit.edit.revision == 2);
    CHECK(changed.edit.given != made.edit.given);
    undo(window);
    CHECK(newest(window).edit.given == made.edit.given);
    undo(window);
    CHECK(edit_count(window) == edits);
}

}  // namespace

SCENARIO("Every operation works from the window", "[window][operations]") {
    const auto window = window_on(Screen::None);
    if (!window) return;
    const Files files;
    std::set<std::string> tried;
    for (const Trial& trial : trials(files)) {
        INFO(trial.operation);
        open_file(*window, files.input(trial.input));
        try_out(*window, trial);
        tried.insert(trial.operation);
    }
    for (const Operation& operation : operation_table()) CHECK(tried.contains(operation.name));
}
