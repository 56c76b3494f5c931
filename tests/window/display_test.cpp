// The window on a display: its size, its memory, its history.

#include <filesystem>

#include <Eigen/Dense>
#include <catch2/catch.hpp>
#include <epoxy/gl.h>

#include "geometry/kernel/measure.h"
#include "tests/support/paths.h"
#include "tests/support/program.h"
#include "tests/support/shapes.h"
#include "tests/window/walk_support.h"
#include "tests/window/window_support.h"
#include "workbench/window/keys/keys.h"

using namespace vesselbench;
using namespace vesselbench::test;
using namespace std::chrono_literals;

namespace fs = std::filesystem;

namespace {

/// The rectangle of every item lies in the window.
void check_inside(Driver& window, float width, float height) {
    window.frame();
    for (const auto& [name, item] : window.app().ui().items()) {
        INFO(name);
        CHECK(item.rect.x >= 0);
        CHECK(item.rect.y >= 0);
        CHECK(item.rect.x + item.rect.width <= width + 1);
        CHECK(item.rect.y + item.rect.height <= height + 1);
    }
}

float view_width(Driver& window) {
    REQUIRE(window.has("view.area"));
    return window.app().ui().items().at("view.area").rect.width;
}

}  // namespace

SCENARIO("The window is resized while a case is open", "[window][display]") {
    const Screen screen = GENERATE(Screen::None, Screen::Display);
    const auto window = window_on(screen);
    if (!window) return;
    open_file(*window, tube_file());
    const float usual = view_width(*window);
    for (const auto& [width, height] :
         {std::pair{820, 580}, std::pair{1900, 1300}, std::pair{1000, 1200}}) {
        window->resize(width, height);
        REQUIRE(window->settle());
        check_inside(*window, static_cast<float>(width), static_cast<float>(height));
        CHECK((view_width(*window) > usual) == (width > 1280));
        const std::size_t edits = edit_count(*window);
        choose(*window, "smoothing", "smooth");
        REQUIRE(window->fill_item("field.iterations", "1"));
        apply_form(*window);
        CHECK(edit_count(*window) == edits + 1);
    }
    CHECK(glGetError() == GL_NO_ERROR);
}

SCENARIO("The first edit is changed and what follows is run", "[window][display]") {
    const Screen screen = GENERATE(Screen::None, Screen::Display);
    const auto window = window_on(screen);
    if (!window) return;
    const std::string input = tube_file();
    open_file(*window, input);
    const Document& document = document_of(*window);
    choose(*window, "smoothing", "smooth");
    REQUIRE(window->fill_item("field.iterations", "2"));
    apply_form(*window);
    choose(*window, "remeshing", "subdivide");
    apply_form(*window);
    REQUIRE(window->click_item("rail.edit.1"));
    REQUIRE(window->fill_item("field.units", "cm"));
    apply_form(*window);
    CHECK_FALSE(window->has("banner.pending"));
    const Surface shown = *document.shown()->surface;
    const fs::path project = document.project();
    window->app().place().close();
    const std::vector<LogEntry> log = stored_log(project);
    REQUIRE(log.size() == 3);
    CHECK(log[0].edit.edit.revision == 2);
    for (const LogEntry& entry : log) CHECK(entry.status == EditStatus::Done);
    // The same case made in centimetres from the start.
    const std::string typed = temporary_folder() + "/typed.vbench";
    const auto run = [&](const std::vector<std::string>& words) {
        REQUIRE(run_program(program_path(), words).exit_code == 0);
    };
    run({"new", typed, input, "--units", "cm"});
    run({"apply", typed, "smooth", "iterations=2"});
    run({"apply", typed, "subdivide"});
    CHECK(Session::open(typed, session_options()).scene().surface->points() == shown.points());
}

SCENARIO("Parameters are tried for long without growing memory", "[window][display]") {
    const auto window = window_on(Screen::Display);
    if (!window) return;
    open_file(*window, tube_file(120));  // a scene takes some 2 MB
    choose(*window, "smoothing", "smooth");
    const auto look = [&](int i) {
        REQUIRE(window->fill_item("field.iterations", std::to_string(1 + i % 9)));
        window->press_key(keys::letter('P'), {.control = true});
        REQUIRE(window->wait_until_idle());
        REQUIRE(document_of(*window).previewed());
        point_at_view(*window);
        const Eigen::Vector2f from = seen_at(*window, {0, 0, 15});
        window->drag(from.x(), from.y(), from.x() + 30, from.y() + 10);
        REQUIRE(window->settle());
    };
    constexpr int kWarming = 5, kLooks = 15;
    for (int i = 0; i < kWarming; ++i) look(i);
    // Whether a background task holds a scene or two just then makes more difference than a leak in
    // one look does, so the growth is the slope of a line through all readings.
    Eigen::MatrixX2d looks(kLooks, 2);
    Eigen::VectorXd megabytes(kLooks);
    for (int i = 0; i < kLooks; ++i) {
        look(i);
        looks.row(i) << i, 1;
        megabytes[i] = resident_megabytes();
    }
    const double grown_by_a_look = looks.colPivHouseholderQr().solve(megabytes).x();
    CHECK(grown_by_a_look < 1.0);
    CHECK(edit_count(*window) == 1);
    CHECK(glGetError() == GL_NO_ERROR);
}
