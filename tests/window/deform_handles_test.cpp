#include "workbench/window/features/handles/deform_handles.h"

#include <algorithm>

#include <catch2/catch.hpp>

#include "geometry/formats/surface_file.h"
#include "tests/support/shapes.h"
#include "tests/window/window_support.h"
#include "workbench/operations/table.h"
#include "workbench/window/form/field_text.h"

using namespace vesselbench;
using namespace vesselbench::test;
using namespace std::chrono_literals;

namespace {

/// A tube of 2 mm radius along z whose middle is to be moved.
struct TubeForm {
    Surface tube = fine_tube(2.0, 60.0, 24);
    OperationForm form{find_operation("deform-branch")};

    TubeForm() { form.set("at", "2,0,35"); }

    [[nodiscard]] BranchPreview find() const {
        return preview_of(tube, deformation_in(form).value());
    }

    void fill(const std::vector<FieldText>& texts) {
        for (const FieldText& field : texts) form.set(field.parameter, field.text);
    }
};

}  // namespace

SCENARIO("A place of a branch is dragged off its axis", "[window][handles]") {
    TubeForm tube;
    REQUIRE(deforms_branch(tube.form));
    const BranchPreview rest = tube.find();
    CHECK(rest.problem.empty());
    const FormShape shape = deform_shape(tube.form, rest);
    REQUIRE(shape.handles.size() == 2);
    CHECK(shape.handles[0].name == "deform.move");
    CHECK((shape.handles[0].point - Vec3(0, 0, 35)).norm() < 0.2);
    WHEN("it is dragged by 2 mm") {
        tube.fill(deform_texts(rest, 0, rest.from + Vec3(2, 0, 0)));
        CHECK(tube.form.arguments().point("move") == Vec3(2, 0, 0));
        const BranchPreview bent = tube.find();
        CHECK(bent.problem.empty());
        CHECK(bent.axis.bent != bent.axis.rest);
        CHECK(bent.rings.size() > 5);
        CHECK(deform_shape(tube.form, bent).lines.size() > 7);
    }
    WHEN("it is dragged too far") {
        tube.form.set("reach", "4");
        tube.fill(deform_texts(rest, 0, rest.from + Vec3(6, 0, 0)));
        const BranchPreview bent = tube.find();
        CHECK(!bent.problem.empty());
        CHECK(bent.axis.bent == bent.axis.rest);
    }
    WHEN("the reach is dragged along the axis") {
        tube.fill(deform_texts(rest, 1, rest.from - Vec3(0, 0, 10)));
        CHECK(tube.form.arguments().real("reach") == Approx(10.0).margin(0.5));
    }
}

SCENARIO("Forms without a place have no bent branch", "[window][handles]") {
    CHECK_FALSE(deforms_branch(OperationForm(find_operation("crop"))));
    CHECK_FALSE(deformation_in(OperationForm(find_operation("deform-branch"))));
}

SCENARIO("A branch is bent by mouse", "[window][handles]") {
    const auto shell = test_shell();
    if (!shell) return;
    const Surface tube = fine_tube(2.0, 60.0, 24);
    const std::string file = temporary_folder() + "/tube.vtp";
    write_surface(tube, file);
    open_and_wait(*shell, file);
    REQUIRE(shell->click_item("rail.deformation"));
    REQUIRE(shell->click_item("choose.deform-branch"));
    Workplace& place = shell->app().place();
    place.set_field("at", "0,-2,35");
    place.disarm();
    REQUIRE(shell->settle(60s));
    REQUIRE(shell->has("deform.move"));
    const auto drag = [&](const char* handle, float right, float down) {
        const ScreenRect rect = shell->app().ui().items().at(handle).rect;
        shell->drag(rect.middle_x(), rect.middle_y(), rect.middle_x() + right,
                    rect.middle_y() + down);
        REQUIRE(shell->settle(60s));
    };
    drag("deform.move", 24, 0);
    const auto move = point_of(*place.form(), "move");
    REQUIRE(move);
    CHECK(move->x() > 0.5);
    WHEN("the reach is dragged towards the root") {
        const double before = place.form()->field("reach").automatic
                                  ? std::get<double>(*place.form()->field("reach").automatic)
                                  : 16.0;
        drag("deform.reach", 0, 10);
        const auto reach = number_of(*place.form(), "reach");
        REQUIRE(reach);
        CHECK(*reach != before);
    }
    WHEN("it is applied") {
        REQUIRE(shell->click_item("operation.apply"));
        REQUIRE(shell->settle(60s));
        const auto& moved = place.document.current()->surface->points();
        double largest = 0.0;
        for (std::size_t v = 0; v < moved.size(); ++v)
            largest = std::max(largest, (moved[v] - tube.points()[v]).norm());
        CHECK(largest > 0.8 * move->norm());
    }
}
