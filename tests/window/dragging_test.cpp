#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "geometry/formats/surface_file.h"
#include "geometry/kernel/measure.h"
#include "tests/support/shapes.h"
#include "tests/window/window_support.h"
#include "workbench/operations/shared/opening_arguments.h"
#include "workbench/window/drawing/screen_places.h"
#include "workbench/window/form/field_text.h"
#include "workbench/window/keys/keys.h"

using namespace vesselbench;
using namespace vesselbench::test;
using namespace std::chrono_literals;

namespace {

/// A capped tube along z, seen from the front, with the form of an operation.
struct Dragging {
    Dragging(const std::string& step, const std::string& operation) : shell(test_shell()) {
        if (!shell) return;
        const std::string file = temporary_folder() + "/tube.vtp";
        write_surface(fine_tube(4.0, 30.0, 24), file);
        open_and_wait(*shell, file);
        if (operation.empty()) return;
        REQUIRE(shell->click_item("rail." + step));
        REQUIRE(shell->click_item("choose." + operation));
        REQUIRE(shell->settle(60s));
    }

    [[nodiscard]] Workplace& place() const { return shell->app().place(); }

    [[nodiscard]] std::string text(const std::string& parameter) const {
        return place().form()->field(parameter).text;
    }

    [[nodiscard]] double number(const std::string& parameter) const {
        return place().form()->arguments().real(parameter);
    }

    /// Types a text into the form.
    void type(const std::string& parameter, const std::string& text) const {
        place().set_field(parameter, text);
        REQUIRE(shell->settle(60s));
    }

    [[nodiscard]] PixelView screen() const {
        return on_screen(shell->app().camera(), shell->app().ui().items().at("view.area").rect);
    }

    [[nodiscard]] Eigen::Vector2f seen(const Vec3& point) const {
        return screen().place(point).value().cast<float>();
    }

    [[nodiscard]] Eigen::Vector2f at(const std::string& handle) const {
        REQUIRE(shell->has(handle));
        const ScreenRect rect = shell->app().ui().items().at(handle).rect;
        return {rect.middle_x(), rect.middle_y()};
    }

    /// Drags a handle by a way that the view shows in its plane [mm].
    void drag(const std::string& handle, const Vec3& way) const {
        const Eigen::Vector2f from = at(handle), to = from + seen(way) - seen({0, 0, 0});
        shell->drag(from.x(), from.y(), to.x(), to.y());
        REQUIRE(shell->settle(60s));
    }

    std::unique_ptr<OffscreenShell> shell;
};

double pixel(const Dragging& view) {
    return 1.0 / view.screen().length({0, 0, 15}, 1.0);
}

}  // namespace

SCENARIO("The crop box is dragged in the view", "[window][handles]") {
    const Dragging view("source", "crop");
    if (!view.shell) return;
    const ViewCamera before = view.shell->app().camera();
    const double from = view.seen({0, 0, 0}).x();
    view.drag("crop.face.x1", {-3, 0, 0});
    const auto box = view.place().form()->arguments().list("box");
    REQUIRE(box.size() == 6);
    CHECK(box[0] < -4);
    CHECK(box[3] < 3);
    CHECK(view.at("crop.face.x1").x() == Approx(from + box[3] / pixel(view)).margin(1.5));
    CHECK(view.shell->app().camera() == before);
    WHEN("a drag is cancelled") {
        const std::string text = view.text("box");
        const Eigen::Vector2f at = view.at("crop.face.z1");
        view.shell->move_mouse(at.x(), at.y());
        view.shell->press(MouseButton::Left);
        view.shell->move_mouse(at.x(), at.y() + 80);
        CHECK(view.text("box") != text);
        view.shell->press_key(keys::kEscape);
        CHECK(view.text("box") == text);
        view.shell->move_mouse(at.x(), at.y() + 120);
        view.shell->release(MouseButton::Left);
        CHECK(view.text("box") == text);
        CHECK(view.place().form());
        CHECK(view.shell->app().camera() == before);
    }
    WHEN("another box is typed") {
        view.type("box", "-2,-2,5,2,2,12");
        CHECK((view.at("crop.face.z1") - view.seen({0, 0, 12})).norm() < 1.5);
    }
}

SCENARIO("A cap is dragged in the view", "[window][handles]") {
    const Dragging view("openings", "extrude-opening");
    if (!view.shell) return;
    const double diameter = 2 * std::sqrt(192 * std::sin(std::numbers::pi / 12) / std::numbers::pi);
    view.drag("length.outlet_1", {0, 0, -1.5 * diameter});
    const auto lengths = [&] { return list_of(*view.place().form(), "lengths"); };
    REQUIRE(lengths().size() == 2);
    CHECK(lengths()[0] == Approx(3 * diameter).margin(0.006));
    CHECK(lengths()[1] == Approx(1.5 * diameter).margin(4 * pixel(view)));
    view.drag("length.outlet_1", {0, 0, 0.5 * diameter + 0.1});
    CHECK(lengths()[1] == Approx(2 * diameter).margin(0.006));
    REQUIRE(view.shell->click_item("operation.apply"));
    REQUIRE(wait_until_idle(*view.shell));
    const Bounds made = bounds(*view.place().document.shown()->surface);
    CHECK(made.max.z() == Approx(30 + 2 * diameter).margin(0.2));
}

SCENARIO("An undo while a cap is dragged takes nothing from under the cursor",
         "[window][handles]") {
    const Dragging view("openings", "extrude-opening");
    if (!view.shell) return;
    REQUIRE(view.shell->click_item("operation.apply"));
    REQUIRE(wait_until_idle(*view.shell));
    view.place().choose("extrude-opening");
    REQUIRE(view.shell->settle(60s));
    const Eigen::Vector2f from = view.at("length.outlet_1");
    view.shell->move_mouse(from.x(), from.y());
    view.shell->press(MouseButton::Left);
    for (int i = 0; i < 2; ++i) {  // the extrusion, then the tube with its openings
        view.shell->press_key(keys::letter('Z'), {.control = true});
        REQUIRE(view.shell->settle(60s));
        view.shell->move_mouse(from.x() + 5.0F * static_cast<float>(i + 1), from.y());
    }
    view.shell->release(MouseButton::Left);
    REQUIRE(view.shell->settle(60s));
    for (const Message& message : view.place().document.messages())
        CHECK(message.kind != MessageKind::Error);
}

SCENARIO("A cut is slid and tilted in the view", "[window][handles]") {
    const Dragging view("openings", "clip-opening");
    if (!view.shell) return;
    CHECK_FALSE(view.shell->has("cut.slide"));
    view.type("tip", "0,0,30");
    view.type("distance", "6");
    CHECK((view.at("cut.slide") - view.seen({0, 0, 24})).norm() < 3);
    view.drag("cut.slide", {0, 0, -4});
    CHECK(view.number("distance") == Approx(10).margin(2 * pixel(view)));
    CHECK(view.text("planes").empty());
    WHEN("it is tilted and made") {
        const Eigen::Vector2f from = view.at("cut.tilt");
        const Eigen::Vector2f to = view.seen({6, 0, 20 + 6});
        view.shell->drag(from.x(), from.y(), to.x(), to.y());
        REQUIRE(view.shell->settle(60s));
        const auto planes = openings_in(records_of(*view.place().form(), "planes"));
        REQUIRE(planes.size() == 1);
        const Vec3 normal = planes[0].place.plane.normal;
        CHECK(normal.x() == Approx(std::sqrt(0.5)).margin(0.05));
        REQUIRE(view.shell->click_item("operation.apply"));
        REQUIRE(wait_until_idle(*view.shell));
        const auto patches = measure_patches(*view.place().document.shown()->surface);
        REQUIRE(patches.size() == 3);
        CHECK(patches[2].name == "outlet_1");
        CHECK(patches[2].normal.x() == Approx(normal.x()).margin(1e-3));
    }
}

SCENARIO("An opening that is clicked becomes the inlet", "[window][handles]") {
    const Dragging view("", "");
    if (!view.shell) return;
    OffscreenShell& shell = *view.shell;
    const Eigen::Vector2f middle = view.seen({0, 0, 15});
    shell.move_mouse(middle.x(), middle.y());
    shell.press_key(keys::k0 + 7);
    const Eigen::Vector2f cap = view.seen({0, 0, 30});
    shell.click(cap.x(), cap.y());
    REQUIRE(shell.settle(10s));
    REQUIRE(shell.has("role.inlet"));
    WHEN("Escape is pressed") {
        shell.press_key(keys::kEscape);
        CHECK_FALSE(shell.has("role.inlet"));
    }
    WHEN("its role is chosen and applied") {
        REQUIRE(shell.click_item("role.inlet"));
        REQUIRE(shell.settle(60s));
        CHECK(view.text("inlet") == "0,0,30");
        CHECK(view.place().command().find("inlet=0,0,30") != std::string::npos);
        REQUIRE(shell.click_item("operation.apply"));
        REQUIRE(wait_until_idle(shell));
        const auto patches = measure_patches(*view.place().document.shown()->surface);
        REQUIRE(patches.size() == 3);
        CHECK(patches[1].name == "inlet");
        CHECK(patches[1].kind == PatchKind::Inlet);
        CHECK(patches[1].centroid.z() == Approx(30));
        CHECK(patches[2].kind == PatchKind::Outlet);
    }
}

SCENARIO("Clicked openings are those to be lengthened", "[window][handles]") {
    const Dragging view("openings", "extrude-opening");
    if (!view.shell) return;
    OffscreenShell& shell = *view.shell;
    const Eigen::Vector2f middle = view.seen({0, 0, 15});
    shell.move_mouse(middle.x(), middle.y());
    shell.press_key(keys::k0 + 7);
    const Eigen::Vector2f beside = view.seen({2.5, 0, 30});
    shell.click(beside.x(), beside.y());
    REQUIRE(shell.settle(10s));
    CHECK(view.text("opening") == "outlet_1");
    CHECK_FALSE(shell.has("role.inlet"));
    shell.click(beside.x(), beside.y());
    REQUIRE(shell.settle(10s));
    CHECK(view.text("opening").empty());
}

SCENARIO("An edit that is pointed at is lit up where it was made", "[window][picking]") {
    const Dragging view("local-repair", "brush-smooth");
    if (!view.shell) return;
    OffscreenShell& shell = *view.shell;
    view.type("at", "0,-4,10");
    view.type("radius", "2");
    REQUIRE(shell.click_item("operation.apply"));
    REQUIRE(wait_until_idle(shell));
    REQUIRE(shell.settle(60s));
    REQUIRE_FALSE(view.place().form());
    CHECK_FALSE(shell.has("view.edit.2"));
    WHEN("it is pointed at in the view") {
        const Eigen::Vector2f at = view.seen({0, -4, 10});
        shell.move_mouse(at.x() + 3, at.y());
        CHECK(shell.has("view.edit.2"));
        CHECK_FALSE(shell.has("view.edit.1"));
    }
    WHEN("it is pointed at in the rail") {
        const ScreenRect row = shell.app().ui().items().at("rail.edit.2").rect;
        shell.move_mouse(row.middle_x(), row.middle_y());
        CHECK(shell.has("view.edit.2"));
    }
}

SCENARIO("A stamp's tool is dragged in the view, and applied", "[window][handles]") {
    const Dragging view("local-repair", "stamp");
    if (!view.shell) return;
    view.type("shape", "capsule");
    view.type("mode", "add");
    view.type("at", "4,0,15");
    CHECK(view.text("centre").empty());
    view.drag("tool.centre", {1, 0, 2});
    const Vec3 centre = view.place().form()->arguments().point("centre");
    CHECK((centre - Vec3(5, 0, 17)).norm() < 4 * pixel(view));
    view.drag("tool.direction", {0, 0, 1});
    CHECK(view.place().form()->arguments().point("direction").z() > 0.1);
    const double before = volume(*view.place().document.shown()->surface);
    REQUIRE(view.shell->click_item("operation.apply"));
    REQUIRE(wait_until_idle(*view.shell));
    CHECK(volume(*view.place().document.shown()->surface) > before + 1.0);
}

SCENARIO("A stamp's path is drawn in the view", "[window][handles]") {
    const Dragging view("local-repair", "stamp");
    if (!view.shell) return;
    view.type("shape", "polygon");
    REQUIRE(view.shell->has("tool.path.1"));
    view.drag("tool.path.1", {1, 0, 3});
    CHECK(list_of(*view.place().form(), "path").size() == 6);
    view.drag("tool.path.add", {0, 0, 2});
    CHECK(list_of(*view.place().form(), "path").size() == 9);
    REQUIRE(view.shell->has("tool.path.2"));
}
