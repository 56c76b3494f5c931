// Every operation of the table is reached, previewed, applied, changed and undone by mouse and
// keys.

#include <algorithm>
#include <filesystem>

#include <catch2/catch.hpp>

#include "geometry/formats/surface_file.h"
#include "tests/support/operation_examples.h"
#include "tests/support/paths.h"
#include "tests/support/program.h"
#include "tests/support/shapes.h"
#include "tests/support/touching_vessels.h"
#include "tests/window/walk_support.h"
#include "tests/window/window_support.h"
#include "workbench/operations/table.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace fs = std::filesystem;

namespace {

constexpr double kRadius = 4.0;  // [mm] of the tubes

/// The files that examples open and name, beside the projects: changed edits find them again there.
class Files {
public:
    Files() : folder_(temporary_folder()) {
        write_surface(fine_tube(kRadius, 30.0, 24), path("tube.vtp"));
        write_surface(open_tube(kRadius, 30.0, 24, 28), path("open.stl"));
        write_surface(mapped(fine_tube(1.0, 30.0, 12),
                             [](const Vec3& p) { return Vec3(p + Vec3(8.0, 0.0, 0.0)); }),
                      path("neighbour.stl"));
        write_surface(touching_vessels(), path("contact.vtp"));
        run({"phantom", "tube", "--out", path("phantom")});
        fs::copy_file(path("phantom/image.nii.gz"), image());
        run({"phantom", "y", "--out", path("y")});
        run({"new", path("opened.vbench"), path("y/exact.vtp")});
        run({"apply", path("opened.vbench"), "clip-opening"});
    }

    [[nodiscard]] std::string path(const std::string& name) const { return folder_ + "/" + name; }

    /// What to open for an example.
    [[nodiscard]] std::string input(ExampleScene scene) const {
        switch (scene) {
            case ExampleScene::Holes:
                return path("open.stl");
            case ExampleScene::Branches:
                return path("y/exact.vtp");
            case ExampleScene::Openings:
                return path("opened.vbench");
            case ExampleScene::Contact:
                return path("contact.vtp");
            case ExampleScene::Image:
                return image();
            default:
                return path("tube.vtp");
        }
    }

    [[nodiscard]] std::string image() const { return path("image.nii.gz"); }

    /// Places of the tube's wall, and of the phantom "y", the scene with branches; of vessels that
    /// touch, the contact.
    [[nodiscard]] ExampleGround ground(ExampleScene scene) const {
        if (scene == ExampleScene::Contact)
            return {.radius = kTouchingRadius, .wall = Vec3(kTouchingBridge, 0.0, 0.0)};
        return {.radius = kRadius,
                .wall = Vec3(kRadius, 0.0, 15.0),
                .end = Vec3(0.0, 0.0, -20.0),
                .branch = Vec3(11.5, 0.0, 16.4),
                .files = {{InputKind::Surface, path("open.stl")},
                          {InputKind::Image, image()},
                          {InputKind::Neighbour, path("neighbour.stl")}}};
    }

private:
    static void run(const std::vector<std::string>& words) {
        const ProgramRun made = run_program(program_path(), words);
        INFO(made.err);
        REQUIRE(made.exit_code == 0);
    }

    std::string folder_;
};

void fill_field(Driver& window, const std::string& name, const std::string& text) {
    INFO(name << "=" << text);
    if (!window.reveal("field." + name)) REQUIRE(window.click_item("field.more"));
    REQUIRE(window.fill_item("field." + name, text));
    REQUIRE(window.app().place().form()->field(name).text == text);
}

/// Choices first: other fields may be there with one of them only.
void fill(Driver& window, const Arguments& values) {
    for (const bool choices : {true, false})
        for (const auto& [name, value] : values.values())
            if (std::holds_alternative<std::string>(value) == choices)
                fill_field(window, name, to_text(value));
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

void try_out(Driver& window, const Operation& operation, const ExampleGround& ground) {
    const std::size_t edits = edit_count(window);
    const Arguments given = example_arguments(operation, ground);
    choose(window, to_string(operation.usual_step), operation.name);
    fill(window, given);
    preview(window);
    CHECK(edit_count(window) == edits);
    apply_form(window);
    REQUIRE(edit_count(window) == edits + 1);
    const LogEntry made = newest(window);
    CHECK(made.edit.operation == operation.name);
    for (const auto& [name, value] : given.values()) CHECK(made.edit.given.has(name));
    REQUIRE(window.click_item("rail.edit." + std::to_string(made.edit.edit.id)));
    fill(window, example_changes(operation, ground));
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

/// The table is dealt to several scenarios, which ctest runs side by side.
constexpr std::size_t kHands = 4;

void try_hand(std::size_t hand) {
    const auto window = window_on(Screen::None);
    if (!window) return;
    const Files files;
    for (std::size_t i = hand; i < operation_table().size(); i += kHands) {
        const Operation& operation = operation_table()[i];
        INFO(operation.name);
        open_file(*window, files.input(operation.example.scene));
        try_out(*window, operation, files.ground(operation.example.scene));
    }
}

}  // namespace

SCENARIO("Every operation works from the window, first hand", "[window][operations]") {
    try_hand(0);
}

SCENARIO("Every operation works from the window, second hand", "[window][operations]") {
    try_hand(1);
}

SCENARIO("Every operation works from the window, third hand", "[window][operations]") {
    try_hand(2);
}

SCENARIO("Every operation works from the window, fourth hand", "[window][operations]") {
    try_hand(kHands - 1);
}
