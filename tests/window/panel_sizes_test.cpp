#include <algorithm>
#include <array>
#include <vector>

#include <catch2/catch.hpp>

#include "geometry/formats/image_file.h"
#include "tests/support/image_shapes.h"
#include "tests/support/shapes.h"
#include "tests/window/window_support.h"
#include "workbench/window/core/layout.h"
#include "workbench/window/core/settings.h"
#include "workbench/window/keys/keys.h"
#include "workbench/window/workplace/workplace.h"

using namespace vesselbench;
using namespace vesselbench::test;
using namespace std::chrono_literals;

namespace {

bool overlap(const ScreenRect& a, const ScreenRect& b) {
    const float wide = std::min(a.x + a.width, b.x + b.width) - std::max(a.x, b.x);
    const float high = std::min(a.y + a.height, b.y + b.height) - std::max(a.y, b.y);
    return wide > 0.5F && high > 0.5F;
}

/// The area that is covered twice, or outside the window, is none.
void check_parts(const Layout& layout) {
    std::vector<ScreenRect> parts = {layout.tool_bar, layout.rail,      layout.view,
                                     layout.bottom,   layout.operation, layout.status};
    for (const Border& border : layout.borders) parts.push_back(border.rect);
    for (std::size_t i = 0; i < parts.size(); ++i) {
        CHECK(parts[i].x >= 0);
        CHECK(parts[i].x + parts[i].width <= layout.window.width + 0.5F);
        CHECK(parts[i].y + parts[i].height <= layout.window.height + 0.5F);
        for (std::size_t j = i + 1; j < parts.size(); ++j) CHECK_FALSE(overlap(parts[i], parts[j]));
    }
}

PanelSizes shares(double rail, double operation, double bottom) {
    PanelSizes sizes;
    sizes[Panel::Rail].share = rail;
    sizes[Panel::Operation].share = operation;
    sizes[Panel::Bottom].share = bottom;
    return sizes;
}

/// Drags a border's middle.
void drag_border(OffscreenShell& shell, const std::string& name, float dx, float dy) {
    const ScreenRect rect = shell.app().ui().items().at(name).rect;
    const float x = rect.middle_x(), y = rect.y + rect.height / 2;
    shell.move_mouse(x, y);
    shell.press(MouseButton::Left);
    shell.move_mouse(x + dx / 2, y + dy / 2);
    shell.move_mouse(x + dx, y + dy);
    shell.release(MouseButton::Left);
    shell.frame();
}

void double_click(OffscreenShell& shell, float x, float y) {
    shell.click(x, y);
    shell.click(x, y);
    shell.frame();
}

ScreenRect view_of(OffscreenShell& shell) {
    return shell.app().ui().items().at("view.area").rect;
}

}  // namespace

SCENARIO("Parts of the window neither overlap nor lose all their room", "[window][panels]") {
    const auto size = GENERATE(std::array{1024.0F, 700.0F}, std::array{1280.0F, 720.0F},
                               std::array{2560.0F, 1440.0F}, std::array{500.0F, 300.0F});
    const float em = GENERATE(15.0F, 19.0F, 22.5F);
    for (const PanelSizes& sizes : {PanelSizes(), shares(0, 0, 0), shares(1, 1, 1),
                                    shares(0.5, 0.5, 0.9), shares(0.05, 0.9, 0.3)}) {
        const Layout layout = layout_of(size[0], size[1], em, sizes);
        check_parts(layout);
        const float across = size[0] - 2 * border_width(em);
        CHECK(layout.view.width >= std::min(18.0F * em, 0.35F * across) - 2);
        CHECK(layout.view.height > 1);
    }
}

SCENARIO("A folded panel leaves its room to the view", "[window][panels]") {
    PanelSizes sizes;
    const Layout usual = layout_of(1280, 720, 15, sizes);
    for (const Panel panel : {Panel::Rail, Panel::Operation, Panel::Bottom})
        sizes[panel].folded = true;
    const Layout folded = layout_of(1280, 720, 15, sizes);
    check_parts(folded);
    CHECK(folded.view.width == usual.view.width + usual.rail.width + usual.operation.width);
    CHECK(folded.view.height == usual.view.height + usual.bottom.height);
}

SCENARIO("The model and the slices share the view", "[window][panels]") {
    const ScreenRect view{100, 50, 800, 600};
    PanelSizes sizes;
    SECTION("in a row") {
        sizes[Panel::Slices].share = 0.3;
        const ViewParts parts = view_parts(view, 15, sizes);
        CHECK(parts.slices.height == Approx(180));
        CHECK(parts.slices.width == 800);
        CHECK_FALSE(parts.beside);
        CHECK_FALSE(overlap(parts.model, parts.slices));
    }
    SECTION("in quarters") {
        sizes.quarters = true;
        const ViewParts parts = view_parts(view, 15, sizes);
        REQUIRE(parts.beside);
        CHECK(parts.beside->width == Approx(parts.model.width).margin(2));
        CHECK_FALSE(overlap(parts.model, *parts.beside));
        CHECK_FALSE(overlap(*parts.beside, parts.slices));
    }
    SECTION("with a slice enlarged") {
        const ViewParts parts = view_parts(view, 15, sizes, Enlarged::Coronal);
        CHECK(parts.slices.height == 600);
        CHECK(parts.slices.width > 500);
        CHECK(parts.model.width > 200);
        CHECK_FALSE(overlap(parts.model, parts.slices));
    }
}

SCENARIO("The sizes of panels are remembered", "[window][panels]") {
    const std::string folder = temporary_folder();
    Settings settings(folder);
    settings.panels = shares(0.2, 0.3, 0.25);
    settings.panels[Panel::Bottom].folded = true;
    settings.panels.quarters = true;
    REQUIRE(settings.save());
    CHECK(Settings(folder).panels == settings.panels);
}

SCENARIO("Slices are in a row, in quarters with the model, or enlarged", "[window][panels]") {
    const auto shell = test_shell();
    if (!shell) return;
    const std::string file = temporary_folder() + "/image.mha";
    write_image(file, image_of({40, 36, 28}, Eigen::Matrix4d::Identity(), [](const Vec3& p) {
                    return (p - Vec3(20, 18, 14)).norm() < 8 ? 900 : 100;
                }));
    open_and_wait(*shell, file);
    REQUIRE(shell->has("slice.coronal.area"));
    const auto rect = [&](const std::string& name) {
        return shell->app().ui().items().at(name).rect;
    };
    const ScreenRect row = rect("slice.coronal.area");
    WHEN("they are put in quarters") {
        REQUIRE(shell->click_item("slices.quarters"));
        REQUIRE(shell->settle(10s));
        CHECK(rect("slice.axial.area").y == Approx(view_of(*shell).y).margin(2));
        CHECK(rect("slice.axial.area").x > view_of(*shell).x + view_of(*shell).width - 1);
        CHECK(rect("slice.coronal.area").width > 1.3F * row.width);
        CHECK(rect("slice.sagittal.area").y > view_of(*shell).y + view_of(*shell).height);
    }
    WHEN("one is clicked twice") {
        double_click(*shell, row.middle_x(), row.y + row.height / 2);
        REQUIRE(shell->settle(10s));
        CHECK(rect("slice.coronal.area").width > 1.8F * row.width);
        CHECK(rect("slice.coronal.area").height > 1.5F * row.height);
        CHECK_FALSE(shell->has("slice.axial.area"));
        CHECK(shell->has("view.area"));
        shell->press_key(keys::kEscape);
        REQUIRE(shell->settle(10s));
        CHECK(rect("slice.coronal.area") == row);
    }
    WHEN("their border is dragged") {
        drag_border(*shell, "border.slices", 0, -50);
        CHECK(rect("slice.coronal.area").height == Approx(row.height + 50).margin(4));
    }
}

SCENARIO("Borders resize and fold panels by mouse", "[window][panels]") {
    const auto shell = test_shell();
    if (!shell) return;
    open_and_wait(*shell, tube_file());
    const ScreenRect before = view_of(*shell);
    WHEN("the rail's border is dragged") {
        drag_border(*shell, "border.rail", 60, 0);
        CHECK(view_of(*shell).x == Approx(before.x + 60).margin(3));
        CHECK(view_of(*shell).width == Approx(before.width - 60).margin(3));
        THEN("a drag to the window's edge folds it, and a click brings it back") {
            drag_border(*shell, "border.rail", -2000, 0);
            CHECK(view_of(*shell).x < 20);
            REQUIRE(shell->click_item("border.rail"));
            shell->frame();
            CHECK(view_of(*shell).x == Approx(before.x + 60).margin(4));
        }
    }
    WHEN("the borders are clicked") {
        REQUIRE(shell->click_item("border.operation"));
        shell->frame();
        CHECK(view_of(*shell).width > before.width + 200);
        CHECK_FALSE(shell->app().ui().items().contains("choose.smooth"));
        THEN("a form that is opened is seen") {
            shell->app().place().choose("smooth");
            shell->frame();
            shell->frame();
            CHECK(shell->app().ui().items().contains("operation.apply"));
        }
    }
    WHEN("there is a double click beside the model") {
        double_click(*shell, before.x + 30, before.y + before.height - 40);
        REQUIRE(shell->settle(30s));
        CHECK(view_of(*shell).height > before.height + 60);
        THEN("Esc gives the panels their room") {
            shell->press_key(keys::kEscape);
            shell->frame();
            CHECK(view_of(*shell).height == Approx(before.height).margin(1));
        }
    }
}
