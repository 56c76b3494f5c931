// The bundled case is prepared with nothing but mouse and keys, on a virtual display.

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include <catch2/catch.hpp>

#include "geometry/kernel/whole_file.h"
#include "tests/support/paths.h"
#include "tests/support/program.h"
#include "tests/support/shapes.h"
#include "tests/window/walk_support.h"
#include "tests/window/window_support.h"
#include "workbench/window/keys/keys.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace fs = std::filesystem;

namespace {

/// Places of the bundled case [mm], from cases/phantoms/aneurysm.json.
const Vec3 kLowStub(0.0, 5.6, 8.2), kHighStub(2.4, -6.0, 41.2);
const Vec3 kInlet(-4.5, 2.5, -6.0), kOutletA(5.6, 7.6, 53.0), kOutletB(4.4, -6.0, 53.0);
const Vec3 kBump(-5.0, 1.6, 2.5), kNarrowing(5.3, 3.0, 38.8);

/// The walk, with the commands that do the same.
struct BundledCase {
    explicit BundledCase(Driver& driven) : window(driven) {}

    void apply() { commands.push_back(apply_form(window)); }

    /// Turns the view by its keys, which need the pointer there and no field being edited.
    void look_from(int key, HeldKeys held) {
        window.press_key(keys::kEnter);
        point_at_view(window);
        window.press_key(key, held);
    }

    void paint(const Vec3& from, const Vec3& to) {
        stroke(window, from, to);
        commands.push_back(command_of(last(), document_of(window).project().string()));
    }

    [[nodiscard]] LogEntry last() const {
        return *std::ranges::max_element(document_of(window).snapshot()->log, {},
                                         [](const LogEntry& entry) { return entry.edit.edit.id; });
    }

    [[nodiscard]] const Surface& surface() const { return *document_of(window).shown()->surface; }

    void make_surface();
    void remove_stubs();
    void open_ends();
    void brush();
    void finish();

    Driver& window;
    std::vector<std::string> commands;
};

void BundledCase::make_surface() {
    choose(window, "source", "extract-surface");
    REQUIRE(window.fill_item("field.dilation", "0"));
    apply();
    choose(window, "source", "repair");
    apply();
}

void BundledCase::remove_stubs() {
    for (const Vec3& tip : {kLowStub, kHighStub}) {
        choose(window, "branches", "remove-branch");
        pick_end(window, "tip", tip);
        apply();
    }
}

void BundledCase::open_ends() {
    for (const Vec3& tip : {kInlet, kOutletA, kOutletB}) {
        choose(window, "openings", "clip-opening");
        pick_end(window, "tip", tip);
        apply();
    }
    CHECK(surface().patches.size() == 4);
}

/// The deepest place of the side with the bump, which the patient's right shows.
double bump_side(const Surface& surface) {
    double side = 0.0;
    for (const Vec3& p : surface.points())
        if ((p - kBump).norm() < 1.0) side = std::min(side, p.x());
    return side;
}

/// The outermost place of the narrowed stretch, to the patient's left.
double narrow_side(const Surface& surface) {
    double side = 0.0;
    for (const Vec3& p : surface.points())
        if (std::abs(p.z() - kNarrowing.z()) < 0.5 && p.y() > 0) side = std::max(side, p.x());
    return side;
}

void BundledCase::brush() {
    choose(window, "local-repair", "brush-smooth");
    REQUIRE(window.fill_item("field.radius", "2"));
    REQUIRE(window.fill_item("field.strength", "0.9"));
    look_from(keys::k0 + 3, {.control = true});
    const double bump = bump_side(surface());
    paint(kBump - Vec3(0, 0, 1), kBump + Vec3(0, 0, 1));
    CHECK(bump_side(surface()) > bump + 0.1);
    CHECK(last().edit.place.step == Step::LocalRepair);
    choose(window, "local-repair", "brush-inflate");
    REQUIRE(window.fill_item("field.strength", "1"));
    look_from(keys::k0 + 3, {});
    const double narrow = narrow_side(surface());
    paint(kNarrowing - Vec3(0, 0, 1), kNarrowing + Vec3(0, 0, 1));
    CHECK(narrow_side(surface()) > narrow + 0.1);
}

void BundledCase::finish() {
    choose(window, "openings", "extrude-opening");
    apply();
    choose(window, "smoothing", "smooth");
    const OperationForm& form = *window.app().place().form();
    CHECK(form.field("preset").text == "cfd");  // as the recipe smooths
    CHECK(form.field("staircase").text == "true");
    REQUIRE(window.fill_item("field.tau_theta", "0.5"));
    apply();
    choose(window, "remeshing", "remesh");
    REQUIRE(window.fill_item("field.edge", "0.6"));
    apply();
    choose(window, "product", "tetrahedralize");
    apply();
    CHECK(document_of(window).shown()->volume_mesh->tetrahedra.size() > 10000);
    export_as(window, "walk.stl");
    export_as(window, "walk.vtu");
}

/// Types a command that the window showed for its own project.
void type_command(std::string command, const std::string& shown, const std::string& project) {
    command.replace(command.find(shown), shown.size(), project);
    command.replace(0, std::string("vesselbench").size(), program_path());
    INFO(command);
    REQUIRE(std::system((command + " >/dev/null").c_str()) == 0);
}

/// Every undo, then every redo, by keys.
void check_undo_and_redo(Driver& window) {
    const auto history = document_of(window).snapshot()->history;
    const std::size_t edits = edit_count(window);
    const auto press_z = [&](bool redo) {
        window.press_key(keys::letter('Z'), {.control = true, .shift = redo});
        REQUIRE(window.wait_until_idle());
    };
    point_at_view(window);
    for (std::size_t left = edits; left-- > 1;) {
        press_z(false);
        REQUIRE(edit_count(window) == left);
    }
    REQUIRE(window.settle());
    CHECK_FALSE(document_of(window).shown()->surface);
    for (std::size_t made = 1; made++ < edits;) {
        press_z(true);
        REQUIRE(edit_count(window) == made);
    }
    const auto after = document_of(window).snapshot()->history;
    CHECK(after->current() == history->current());
    const auto results = [](const History& of) {
        std::vector<ResultId> ids;
        for (const HistoryEntry& entry : of.entries()) ids.push_back(entry.result);
        return ids;
    };
    CHECK(results(*after) == results(*history));
    REQUIRE(window.settle());
}

}  // namespace

SCENARIO("The bundled case is prepared by hand", "[window][walk][display]") {
    const auto window = window_on(Screen::Display);
    if (!window) return;
    REQUIRE(window->click_item("case.aneurysm"));
    REQUIRE(window->wait_until_idle());
    REQUIRE(document_of(*window).is_open());
    REQUIRE(window->settle());
    const fs::path project = document_of(*window).project();
    BundledCase walk(*window);
    walk.make_surface();
    walk.remove_stubs();
    walk.open_ends();
    walk.brush();
    walk.finish();
    check_undo_and_redo(*window);
    window->app().place().close();
    CHECK(stored_log(project).size() == walk.commands.size() + 1);
    // The same on the command line.
    const std::string folder = temporary_folder();
    const std::string typed =
        folder + "/" + project.filename().string();  // files name their project
    const std::string input = source_folder() + "/cases/aneurysm";
    REQUIRE(run_program(program_path(), {"new", typed, input}).exit_code == 0);
    for (const std::string& command : walk.commands) type_command(command, project.string(), typed);
    for (const std::string name : {"walk.stl", "walk.vtu"}) {
        REQUIRE(run_program(program_path(), {"export", typed, folder + "/" + name}).exit_code == 0);
        CHECK(file_content(folder + "/" + name) == file_content(project.parent_path() / name));
    }
}
