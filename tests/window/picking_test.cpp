#include <algorithm>

#include <catch2/catch.hpp>

#include "geometry/formats/surface_file.h"
#include "geometry/kernel/measure.h"
#include "tests/support/paths.h"
#include "tests/support/program.h"
#include "tests/support/shapes.h"
#include "tests/support/touching_vessels.h"
#include "tests/window/window_support.h"
#include "workbench/window/case/pick_target.h"
#include "workbench/window/drawing/screen_places.h"
#include "workbench/window/form/picked_text.h"
#include "workbench/window/keys/keys.h"

using namespace vesselbench;
using namespace vesselbench::test;
using namespace std::chrono_literals;

namespace {

/// The closed surface of the phantom with three vessels that meet.
std::string y_file() {
    const std::string folder = temporary_folder();
    REQUIRE(run_program(program_path(), {"phantom", "y", "--out", folder}).exit_code == 0);
    return folder + "/exact.vtp";
}

std::string capped_tube_file() {
    const std::string file = temporary_folder() + "/tube.vtp";
    write_surface(fine_tube(4.0, 30.0, 24), file);
    return file;
}

void choose(OffscreenShell& shell, const std::string& step, const std::string& operation) {
    REQUIRE(shell.click_item("rail." + step));
    REQUIRE(shell.click_item("choose." + operation));
    REQUIRE(shell.settle(60s));
}

/// Where a point is seen in the window.
Eigen::Vector2f seen_at(OffscreenShell& shell, const Vec3& point) {
    REQUIRE(shell.has("view.area"));
    const PixelView screen =
        on_screen(shell.app().camera(), shell.app().ui().items().at("view.area").rect);
    const auto place = screen.place(point);
    REQUIRE(place);
    return place->cast<float>();
}

void click_at(OffscreenShell& shell, const Vec3& point) {
    const Eigen::Vector2f at = seen_at(shell, point);
    shell.move_mouse(at.x(), at.y());
    shell.click(at.x(), at.y());
    REQUIRE(shell.settle(10s));
}

std::string text_of(OffscreenShell& shell, const std::string& parameter) {
    return shell.app().place().form()->field(parameter).text;
}

/// Arms a parameter and clicks the vessel end that points most to the patient's left. \return the
/// text that it should have now
std::string pick_left_end(OffscreenShell& shell, const std::string& parameter) {
    const Workplace& place = shell.app().place();
    if (place.armed().empty()) REQUIRE(shell.click_item("field." + parameter + ".pick"));
    CHECK(place.armed() == parameter);
    const auto& tips = place.surface_places().tips;
    REQUIRE(tips.size() == 3);
    const Vec3 tip = std::ranges::max_element(tips, {}, [](const NamedPlace& end) {
                         return end.point.x();
                     })->point;
    click_at(shell, tip);
    CHECK(place.armed().empty());
    return picked_text(PickTarget::Tip, "", tip);
}

/// The surface after the same edit by the command line.
Surface by_command_line(const std::string& input, const std::vector<std::string>& edit) {
    const std::string project = temporary_folder() + "/typed.vbench";
    REQUIRE(run_program(program_path(), {"new", project, input}).exit_code == 0);
    std::vector<std::string> words = {"apply", project};
    words.insert(words.end(), edit.begin(), edit.end());
    REQUIRE(run_program(program_path(), words).exit_code == 0);
    return *Session::open(project, session_options()).scene().surface;
}

}  // namespace

SCENARIO("A branch whose tip is clicked is removed", "[window][picking]") {
    const auto shell = test_shell();
    if (!shell) return;
    const std::string input = y_file();
    open_and_wait(*shell, input);
    choose(*shell, "branches", "remove-branch");
    CHECK_FALSE(shell->app().place().form()->valid());
    const std::string tip = pick_left_end(*shell, "tip");
    CHECK(text_of(*shell, "tip") == tip);
    CHECK(shell->app().place().form()->valid());
    REQUIRE(shell->click_item("operation.apply"));
    REQUIRE(wait_until_idle(*shell));
    const Document& document = shell->app().place().document;
    REQUIRE(document.snapshot()->log.size() == 2);
    CHECK(document.shown()->surface->points() ==
          by_command_line(input, {"remove-branch", "tip=" + tip}).points());
}

SCENARIO("A vessel end that is clicked is opened", "[window][picking]") {
    const auto shell = test_shell();
    if (!shell) return;
    const std::string input = y_file();
    open_and_wait(*shell, input);
    choose(*shell, "openings", "clip-opening");
    const std::string tip = pick_left_end(*shell, "tip"), inlet = pick_left_end(*shell, "inlet");
    CHECK(text_of(*shell, "tip") == tip);
    CHECK(inlet == tip);
    CHECK(text_of(*shell, "inlet") == inlet);
    REQUIRE(shell->click_item("operation.apply"));
    REQUIRE(wait_until_idle(*shell));
    const Surface& made = *shell->app().place().document.shown()->surface;
    CHECK(made.patches.size() == 2);
    CHECK(made.points() ==
          by_command_line(input, {"clip-opening", "tip=" + tip, "inlet=" + inlet}).points());
}

SCENARIO("Escape stops picking, then closes the form", "[window][picking]") {
    const auto shell = test_shell();
    if (!shell) return;
    open_and_wait(*shell, tube_file());
    choose(*shell, "branches", "remove-branch");
    CHECK(shell->app().place().armed() == "tip");  // it is required
    shell->press_key(keys::kEscape);
    CHECK(shell->app().place().armed().empty());
    CHECK(shell->app().place().form());
    click_at(*shell, {0, 0, 15});
    CHECK(text_of(*shell, "tip").empty());
    shell->press_key(keys::kEscape);
    CHECK_FALSE(shell->app().place().form());
}

SCENARIO("A place on the surface is picked, not beside it", "[window][picking]") {
    const auto shell = test_shell();
    if (!shell) return;
    open_and_wait(*shell, tube_file());
    choose(*shell, "local-repair", "brush-smooth");
    REQUIRE(shell->click_item("field.at.pick"));
    click_at(*shell, {7, 0, 15});
    CHECK(shell->app().place().armed() == "at");
    WHEN("the view is turned meanwhile") {
        const Eigen::Vector2f from = seen_at(*shell, {0, 0, 15});
        shell->drag(from.x(), from.y(), from.x() + 60, from.y());
        CHECK(shell->app().place().armed() == "at");
        CHECK(text_of(*shell, "at").empty());
    }
    WHEN("the surface is clicked") {
        const ViewCamera before = shell->app().camera();
        click_at(*shell, {1, 0, 15});
        CHECK(shell->app().place().armed().empty());
        const Vec3 at = shell->app().place().form()->arguments().point("at");
        CHECK(std::hypot(at.x(), at.y()) == Approx(4).epsilon(0.02));
        CHECK(at.y() < 0);
        CHECK(at.x() == Approx(1).margin(0.2));
        CHECK(shell->app().camera() == before);
        CHECK(shell->app().place().document.snapshot()->log.size() == 1);  // not painted, too
    }
}

SCENARIO("Two vessels are separated by a click on their contact", "[window][picking]") {
    const auto shell = test_shell();
    if (!shell) return;
    const std::string file = temporary_folder() + "/contact.vtp";
    write_surface(touching_vessels(), file);
    open_and_wait(*shell, file);
    choose(*shell, "local-repair", "separate");
    REQUIRE(shell->click_item("field.at.pick"));
    click_at(*shell, {0, -kTouchingBridge, 0});
    CHECK(shell->app().place().form()->arguments().point("at").norm() < 1.2);
    REQUIRE(shell->click_item("operation.preview"));
    REQUIRE(wait_until_idle(*shell));
    const auto shown = [&] { return *shell->app().place().document.shown()->surface; };
    REQUIRE(shell->app().place().document.previewed());
    CHECK(connectivity(*shown().topology).components == 2);
    REQUIRE(shell->click_item("operation.apply"));
    REQUIRE(wait_until_idle(*shell));
    CHECK(connectivity(*shown().topology).components == 2);
    CHECK(shell->app().place().document.snapshot()->log.size() == 2);
}

SCENARIO("A brush does not light up openings", "[window][picking]") {
    const auto shell = test_shell();
    if (!shell) return;
    open_and_wait(*shell, capped_tube_file());
    const Eigen::Vector2f middle = seen_at(*shell, {0, 0, 15});
    shell->move_mouse(middle.x(), middle.y());
    shell->press_key(keys::k0 + 7);
    const Eigen::Vector2f cap = seen_at(*shell, {0, 0, 30});
    shell->move_mouse(cap.x(), cap.y());
    REQUIRE(shell->settle(10s));
    REQUIRE(shell->has("view.opening.outlet_1"));
    choose(*shell, "local-repair", "brush-smooth");
    shell->move_mouse(cap.x(), cap.y());
    REQUIRE(shell->settle(10s));
    CHECK_FALSE(shell->has("view.opening.outlet_1"));
}

SCENARIO("Two clicks make a box, which is drawn", "[window][picking]") {
    const auto shell = test_shell();
    if (!shell) return;
    open_and_wait(*shell, tube_file());
    choose(*shell, "source", "crop");
    REQUIRE(shell->click_item("field.box.pick"));
    click_at(*shell, {2, 0, 10});
    CHECK(shell->app().place().armed() == "box");
    const int drawings = shell->app().drawings();
    click_at(*shell, {-3.5, 0, 20});
    CHECK(shell->app().place().armed().empty());
    CHECK(shell->app().drawings() > drawings);
    const auto box = shell->app().place().form()->arguments().list("box");
    REQUIRE(box.size() == 6);
    for (std::size_t i = 0; i < 3; ++i) CHECK(box[i] < box[i + 3]);
}

SCENARIO("An opening under the cursor shows its figures", "[window][picking]") {
    const auto shell = test_shell();
    if (!shell) return;
    open_and_wait(*shell, capped_tube_file());
    const Eigen::Vector2f middle = seen_at(*shell, {0, 0, 15});
    shell->move_mouse(middle.x(), middle.y());
    REQUIRE(shell->settle(10s));
    CHECK_FALSE(shell->has("view.opening.outlet_1"));
    shell->press_key(keys::k0 + 7);
    const Eigen::Vector2f cap = seen_at(*shell, {0, 0, 30});
    shell->move_mouse(cap.x(), cap.y());
    REQUIRE(shell->settle(10s));
    CHECK(shell->has("view.opening.outlet_1"));
    shell->move_mouse(cap.x() + 300, cap.y());
    REQUIRE(shell->settle(10s));
    CHECK_FALSE(shell->has("view.opening.outlet_1"));
}
