#include <fstream>
#include <iterator>

#include <catch2/catch.hpp>

#include "geometry/formats/image_file.h"
#include "geometry/formats/surface_file.h"
#include "tests/support/image_shapes.h"
#include "tests/support/shapes.h"
#include "tests/window/window_support.h"
#include "workbench/report/measure_table.h"
#include "workbench/window/drawing/screen_places.h"
#include "workbench/window/features/measures/measure_list.h"
#include "workbench/window/features/openings/openings_feature.h"
#include "workbench/window/keys/keys.h"

using namespace vesselbench;
using namespace vesselbench::test;
using namespace std::chrono_literals;
using Catch::Matchers::Contains;

namespace {

const MeasuredModel kSurface{.on = MeasuredOn::Surface, .state = 1, .variant = "cfd"};
const MeasuredModel kSlice{.on = MeasuredOn::AxialSlice, .state = 1, .variant = "cfd"};

MeasureList& measures_of(OffscreenShell& shell) {
    return shell.app().place().measures();
}

std::string text_in(const std::string& file) {
    std::ifstream stream(file);
    return {std::istreambuf_iterator<char>(stream), {}};
}

/// A click on a place of the view.
void click_at(OffscreenShell& shell, const Vec3& point) {
    REQUIRE(shell.has("view.area"));
    const ScreenRect view = shell.app().ui().items().at("view.area").rect;
    const auto at = on_screen(shell.app().camera(), view).place(point);
    REQUIRE(at);
    shell.click(static_cast<float>(at->x()), static_cast<float>(at->y()));
    REQUIRE(shell.settle(30s));
}

}  // namespace

SCENARIO("Clicks become measures", "[window][measures]") {
    MeasureList measures({});
    measures.click(Vec3(0, 0, 0), kSurface);
    CHECK(measures.all().empty());
    CHECK(measures.first_point() == Vec3(0, 0, 0));
    measures.click(Vec3(3, 4, 0), kSurface);
    REQUIRE(measures.all().size() == 1);
    CHECK(measures.all()[0].name == "Distance 1");
    CHECK(measures.all()[0].length == Approx(5));
    CHECK(measures.all()[0].state == 1);
    CHECK(measures.all()[0].time.size() == 20);
    WHEN("further points are clicked") {
        measures.click(Vec3(3, 4, 2), kSurface);
        THEN("they lengthen it") {
            REQUIRE(measures.all().size() == 1);
            CHECK(measures.all()[0].length == Approx(7));
            CHECK(measures.all()[0].points.size() == 3);
        }
    }
    WHEN("a point of another model is clicked") {
        measures.click(Vec3(0, 0, 9), kSlice);
        measures.click(Vec3(0, 1, 9), kSlice);
        THEN("it begins another distance") {
            REQUIRE(measures.all().size() == 2);
            CHECK(measures.all()[0].length == Approx(5));
            CHECK(measures.all()[1].name == "Distance 2");
            CHECK(measures.all()[1].on == MeasuredOn::AxialSlice);
        }
    }
    WHEN("a diameter is measured") {
        measures.add({.centre = Vec3(1, 1, 1), .inscribed = 8, .area = 50, .equivalent = 8},
                     kSlice);
        THEN("the next click does not lengthen it") {
            CHECK(measures.all()[1].name == "Diameter 1");
            CHECK(middle_of(measures.all()[1]) == Vec3(1, 1, 1));
            measures.click(Vec3(0, 0, 0), kSurface);
            CHECK(measures.all().size() == 2);
        }
    }
    WHEN("one is removed") {
        measures.begin_next();
        measures.click(Vec3(0, 0, 0), kSurface);
        measures.click(Vec3(1, 0, 0), kSurface);
        measures.rename(1, "neck");
        measures.remove(0);
        THEN("the others stay, and its name is free") {
            REQUIRE(measures.all().size() == 1);
            CHECK(measures.all()[0].name == "neck");
            measures.begin_next();
            measures.click(Vec3(0, 0, 0), kSurface);
            measures.click(Vec3(1, 0, 0), kSurface);
            CHECK(measures.all()[1].name == "Distance 1");
        }
    }
    WHEN("the last one is taken back while a point waits") {
        measures.begin_next();
        measures.click(Vec3(0, 0, 0), kSurface);
        measures.take_back();
        CHECK(measures.all().size() == 1);
        measures.take_back();
        CHECK(measures.all().empty());
        CHECK_FALSE(measures.can_take_back());
    }
}

SCENARIO("Measures are exported as a table", "[window][measures]") {
    const KeptMeasure distance{.name = "neck, \"wide\"",
                               .points = {Vec3(0, 0, 0), Vec3(3, 4, 0), Vec3(3, 4, 2)},
                               .length = 7.0,
                               .on = MeasuredOn::AxialSlice,
                               .state = 1};
    const KeptMeasure diameter{.name = "Diameter 1",
                               .kind = MeasureKind::Diameter,
                               .points = {Vec3(1, 2, 3), Vec3(2, 2, 3)},
                               .length = 8.0,
                               .area = 51.0,
                               .equivalent = 8.06};
    CHECK_THAT(measures_csv({distance, diameter}),
               Contains("\"neck, \"\"wide\"\"\",distance,7.0000,,,axial-slice,1,") &&
                   Contains("\"0.0000 0.0000 0.0000; 3.0000 4.0000 0.0000; ") &&
                   Contains("\"Diameter 1\",diameter,8.0000,51.0000,8.0600,surface,0,") &&
                   Contains(",\"1.0000 2.0000 3.0000\"\r\n"));
    CHECK(measure_text(distance) == "7.00 mm along 2 segments");
}

SCENARIO("Measures of a project come back", "[window][measures]") {
    const std::string project = temporary_folder() + "/kept.vbench";
    Session::unsaved(session_options()).save_as(project);
    {
        MeasureList measures({});
        measures.open(project, "");
        measures.click(Vec3(0, 0, 0), kSurface);  // before what is stored is known
        measures.click(Vec3(1, 0, 0), kSurface);
        CHECK(measures.close().empty());
    }
    MeasureList again({});
    again.open(project, "");
    CHECK_FALSE(again.can_take_back());
    again.click(Vec3(0, 0, 0), kSurface);
    again.click(Vec3(2, 0, 0), kSurface);
    CHECK(again.close().empty());
    const std::vector<KeptMeasure> stored = stored_measures(project);
    REQUIRE(stored.size() == 2);
    CHECK(stored[0].length == Approx(1));
    CHECK(stored[1].length == Approx(2));
    WHEN("the project can only be read") {
        again.open(project, "it cannot be written");
        again.click(Vec3(0, 0, 0), kSurface);
        again.click(Vec3(3, 0, 0), kSurface);
        CHECK(again.not_stored() == "it cannot be written");
        CHECK(again.close().empty());
        CHECK(stored_measures(project) == stored);
    }
}

SCENARIO("Measures are listed, renamed, looked at, exported and removed", "[window][measures]") {
    const auto shell = test_shell();
    if (!shell) return;
    open_and_wait(*shell, tube_file());
    REQUIRE(shell->run_until([&] { return measures_of(*shell).is_read(); }, 20s));
    shell->press_key(keys::letter('M'));
    click_at(*shell, {0, -4, 10});
    click_at(*shell, {0, -4, 20});
    REQUIRE(measures_of(*shell).all().size() == 1);
    CHECK(measures_of(*shell).all()[0].length == Approx(10).margin(0.5));
    CHECK(measures_of(*shell).all()[0].on == MeasuredOn::Surface);
    shell->press_key(keys::kEscape);
    REQUIRE(shell->click_item("tab.measures"));
    REQUIRE(shell->fill_item("measures.name.0", "neck"));
    const int looks = shell->app().place().looks();
    REQUIRE(shell->click_item("measures.look.0"));
    CHECK(shell->app().place().looks() == looks + 1);
    WHEN("the project is closed and opened again, and an edit is undone") {
        const auto project = shell->app().place().document.project();
        shell->app().place().close();
        REQUIRE(shell->settle(60s));
        CHECK(measures_of(*shell).all().empty());
        open_and_wait(*shell, project.string());
        REQUIRE(shell->run_until([&] { return measures_of(*shell).is_read(); }, 20s));
        shell->app().place().document.undo();
        REQUIRE(wait_until_idle(*shell));
        THEN("they are there") {
            REQUIRE(measures_of(*shell).all().size() == 1);
            CHECK(measures_of(*shell).all()[0].name == "neck");
        }
    }
    WHEN("they are exported") {
        const std::string file = temporary_folder() + "/measures.csv";
        REQUIRE(shell->click_item("measures.export"));
        shell->app().place().answer(file);
        REQUIRE(wait_until_idle(*shell));
        CHECK_THAT(text_in(file), Contains("\"neck\",distance,"));
    }
    WHEN("one is removed") {
        REQUIRE(shell->click_item("measures.remove.0"));
        REQUIRE(shell->settle(30s));
        CHECK(measures_of(*shell).all().empty());
        CHECK(stored_measures(shell->app().place().document.project()).empty());
    }
}

SCENARIO("No click for a measure opens another tool", "[window][measures]") {
    const auto shell = test_shell();
    if (!shell) return;
    const std::string file = temporary_folder() + "/tube.vtp";
    write_surface(fine_tube(4.0, 30.0, 24), file);
    open_and_wait(*shell, file);
    shell->press_key(keys::letter('M'));
    REQUIRE(shell->run_until([&] { return !shell->app().place().searches_places(); }, 30s));
    for (const PatchMeasures& opening : shell->app().place().surface_places().openings) {
        INFO(opening.name);
        click_at(*shell, opening.centroid);
        CHECK_FALSE(shell->app().place().get<OpeningsFeature>().role_question());
        CHECK_FALSE(shell->app().place().form());
    }
    CHECK(shell->app().place().has_click_tool());
}

SCENARIO("Distances are measured in slices", "[window][measures]") {
    const auto shell = test_shell();
    if (!shell) return;
    const std::string file = temporary_folder() + "/image.mha";
    write_image(file, image_of({40, 36, 28}, Eigen::Matrix4d::Identity(),
                               [](const Vec3& p) { return (p - Vec3(20, 18, 14)).norm(); }));
    open_and_wait(*shell, file);
    REQUIRE(shell->run_until([&] { return measures_of(*shell).is_read(); }, 20s));
    if (!shell->has("slice.axial.area")) REQUIRE(shell->click_item("tool.slices"));
    REQUIRE(shell->settle(30s));
    shell->app().place().view.tool = ClickTool::Distance;
    shell->frame();
    REQUIRE(shell->has("slice.axial.area"));
    const Vec3 cross = shell->app().place().slices().cross();
    const ScreenRect rect = shell->app().ui().items().at("slice.axial.area").rect;
    shell->click(rect.middle_x() - 10, rect.middle_y());
    shell->click(rect.middle_x() + 10, rect.middle_y());
    REQUIRE(shell->settle(30s));
    REQUIRE(measures_of(*shell).all().size() == 1);
    const KeptMeasure& measure = measures_of(*shell).all()[0];
    CHECK(measure.on == MeasuredOn::AxialSlice);
    CHECK(measure.length > 0.5);
    CHECK(measure.points[0].z() == Approx(cross.z()));
    THEN("the clicks do not move the cross") {
        CHECK(shell->app().place().slices().cross() == cross);
    }
}
