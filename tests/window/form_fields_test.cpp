// The fields of a form as they are drawn: what they show while they are empty, and which are seen.

#include <catch2/catch.hpp>

#include "geometry/formats/image_file.h"
#include "tests/support/image_shapes.h"
#include "tests/support/paths.h"
#include "tests/support/shapes.h"
#include "tests/window/window_support.h"
#include "workbench/window/form/label_list.h"

using namespace vesselbench;
using namespace vesselbench::test;
using namespace std::chrono_literals;

namespace {

/// Labels 2, 5 and 9 side by side in a ball, in voxels of 1 mm^3.
Image three_labels() {
    return image_of({40, 40, 40}, Eigen::Matrix4d::Identity(), [](const Vec3& p) {
        if ((p - Vec3(20, 20, 20)).norm() > 14) return 0;
        return p.x() < 15 ? 2 : p.x() < 25 ? 5 : 9;
    });
}

void open_remesh(OffscreenShell& shell) {
    open_and_wait(shell, tube_file());
    REQUIRE(shell.click_item("rail.remeshing"));
    REQUIRE(shell.click_item("choose.remesh"));
    REQUIRE(shell.settle(60s));
}

}  // namespace

SCENARIO("A field shows the value that is automatic", "[window][form]") {
    const auto shell = test_shell();
    if (!shell) return;
    open_remesh(*shell);
    const OperationForm& form = *shell->app().place().form();
    REQUIRE(form.field("edge").automatic);
    const double edge = std::get<double>(*form.field("edge").automatic);
    CHECK(edge == Approx(0.28 * 4.0).epsilon(0.05));
    CHECK(std::get<double>(*form.field("max_edge").automatic) == Approx(2.0 * edge));
    WHEN("it is given, another one follows") {
        shell->app().place().set_field("edge", "1.5");
        REQUIRE(shell->settle(60s));
        CHECK_FALSE(form.field("edge").automatic);
        CHECK(std::get<double>(*form.field("max_edge").automatic) == Approx(3.0));
    }
    WHEN("a field does not apply") {
        shell->app().place().set_field("mode", "uniform");
        REQUIRE(shell->settle(60s));
        THEN("it is hidden, and can be set all the same") {
            CHECK_FALSE(shell->has("field.max_edge"));
            shell->app().place().set_field("max_edge", "2");
            shell->app().place().set_field("mode", "");
            REQUIRE(shell->settle(60s));
            CHECK(shell->has("field.max_edge"));
            CHECK(form.arguments().real("max_edge") == 2.0);
        }
    }
}

SCENARIO("Fields that are seldom needed are folded away", "[window][form]") {
    const auto shell = test_shell();
    if (!shell) return;
    open_remesh(*shell);
    CHECK(shell->has("field.edge"));
    CHECK_FALSE(shell->has("field.gradation"));
    WHEN("they are unfolded") {
        REQUIRE(shell->click_item("field.more"));
        CHECK(shell->has("field.gradation"));
        CHECK_FALSE(shell->has("field.feature_size"));  // needs an angle
        REQUIRE(shell->click_item("field.more"));
        CHECK_FALSE(shell->has("field.gradation"));
    }
    WHEN("one is given") {
        shell->app().place().set_field("gradation", "1.3");
        shell->frame();
        CHECK(shell->has("field.gradation"));
        CHECK_FALSE(shell->has("field.feature_angle"));
        CHECK(shell->app().place().form()->arguments().real("gradation") == 1.3);
    }
}

SCENARIO("Decisions are no fields, and can be dropped", "[window][form]") {
    const auto shell = test_shell();
    if (!shell) return;
    open_and_wait(*shell, tube_file());
    REQUIRE(shell->click_item("rail.openings"));
    REQUIRE(shell->click_item("choose.extrude-opening"));
    REQUIRE(shell->settle(60s));
    Workplace& place = shell->app().place();
    CHECK_FALSE(shell->has("field.lengths"));
    CHECK_FALSE(shell->has("field.decide"));
    place.set_field("lengths", "5,6");
    REQUIRE(shell->settle(60s));
    CHECK_FALSE(shell->has("field.lengths"));
    REQUIRE(shell->click_item("field.decide"));
    CHECK(place.form()->field("lengths").text.empty());
    REQUIRE(shell->settle(60s));
    CHECK_FALSE(shell->has("field.decide"));
    WHEN("a brush's form holds a stroke") {
        place.leave_form();
        place.choose("brush-smooth");
        place.set_field("dabs", "2,0,15,1,0,0,2,1,0.5,1");
        REQUIRE(shell->settle(60s));
        CHECK(shell->has("field.passes"));
        CHECK_FALSE(shell->has("field.dabs"));
    }
}

SCENARIO("Labels are switched one by one, and the last one stays", "[window][form]") {
    const std::vector<LabelRow> all = {{2, 1.0, true}, {5, 1.0, true}};
    CHECK(switched_label(all, 5) == "2");
    CHECK(switched_label({{2, 1.0, true}, {5, 1.0, false}}, 5) == "2,5");
    CHECK(switched_label({{2, 1.0, true}, {5, 1.0, false}}, 2) == "2");
    CHECK(name_of(all[1]) == "Label 5");
}

SCENARIO("The labels of an image are a list with check boxes", "[window][form]") {
    const auto shell = test_shell();
    if (!shell) return;
    const std::string file = temporary_folder() + "/labels.mha";
    write_image(file, three_labels());
    open_and_wait(*shell, file);
    REQUIRE(shell->click_item("rail.source"));
    REQUIRE(shell->click_item("choose.extract-surface"));
    REQUIRE(shell->settle(60s));
    Workplace& place = shell->app().place();
    const auto rows = [&] { return place.labels().rows(place.form()->field("labels")); };
    REQUIRE(rows().size() == 3);
    double sum = 0.0;
    for (const LabelRow& row : rows()) {
        CHECK(row.taken);  // as the operation decides
        sum += row.volume;
    }
    CHECK(sum == Approx(4.0 / 3.0 * 3.14159 * 14 * 14 * 14).epsilon(0.02));
    CHECK_FALSE(shell->has("field.threshold"));  // of intensities
    CHECK_FALSE(shell->has("field.labels"));
    WHEN("one is switched off") {
        REQUIRE(shell->click_item("field.labels.5"));
        CHECK(place.form()->field("labels").text == "2,9");
        REQUIRE(shell->settle(60s));
        CHECK_FALSE(rows()[1].taken);
        REQUIRE(shell->click_item("field.labels.5"));
        CHECK(place.form()->field("labels").text == "2,5,9");
    }
    WHEN("they are given by a text") {
        place.set_field("labels", "9");
        shell->frame();
        CHECK(rows()[2].taken);
        CHECK_FALSE(rows()[0].taken);
    }
}
