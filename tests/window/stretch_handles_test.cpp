#include "workbench/window/features/handles/stretch_handles.h"

#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "geometry/formats/surface_file.h"
#include "tests/support/shapes.h"
#include "tests/window/window_support.h"
#include "workbench/operations/table.h"
#include "workbench/window/drawing/screen_places.h"
#include "workbench/window/form/field_text.h"

using namespace vesselbench;
using namespace vesselbench::test;
using namespace std::chrono_literals;

namespace {

/// A form whose operation has decided a stretch along z.
OperationForm decided_form() {
    OperationForm form(find_operation("correct-narrowing"));
    form.set("at", "0,0,20");
    form.set_automatic({{"from", Vec3(0, 0, 16)}, {"to", Vec3(0, 0, 24)}, {"radius", 2.0}});
    return form;
}

void fill(OperationForm& form, const std::vector<FieldText>& texts) {
    for (const FieldText& field : texts) form.set(field.parameter, field.text);
}

/// A tube of 2 mm radius along z whose radius is halved at z = 20.
Surface narrow_tube() {
    return mapped(closed_tube(2.0, 40.0, 32, 160), [](const Vec3& p) {
        const double away = std::min(1.0, std::abs(p.z() - 20.0) / 5.0);
        const double width = 1.0 - 0.25 * (1.0 + std::cos(std::numbers::pi * away));
        return Vec3(width * p.x(), width * p.y(), p.z());
    });
}

}  // namespace

SCENARIO("A stretch is shown as the operation decides it, until it is dragged",
         "[window][handles]") {
    OperationForm form = decided_form();
    REQUIRE(has_stretch(form));
    CHECK_FALSE(has_stretch(OperationForm(find_operation("widen"))));
    CHECK(stretch_shape(OperationForm(find_operation("correct-narrowing"))).handles.empty());
    const FormShape shape = stretch_shape(form);
    REQUIRE(shape.handles.size() == 3);
    CHECK(shape.handles[0].point == Vec3(0, 0, 16));
    CHECK(shape.lines.front().faint);
    WHEN("an end is dragged") {
        fill(form, stretch_texts(form, 0, Vec3(3, 0, 14)));
        CHECK(point_of(form, "from") == Vec3(0, 0, 14));
        CHECK(point_of(form, "to") == Vec3(0, 0, 24));
        CHECK_FALSE(stretch_shape(form).lines.front().faint);
        THEN("it does not pass the other one") {
            fill(form, stretch_texts(form, 1, Vec3(0, 0, 2)));
            CHECK(point_of(form, "to")->z() == Approx(15.0));
        }
    }
    WHEN("the radius is dragged") {
        const Vec3 rim = shape.handles[2].point, middle(0, 0, 20);
        fill(form, stretch_texts(form, 2, middle + 1.5 * (rim - middle)));
        CHECK(number_of(form, "radius") == 3.0);
        fill(form, stretch_texts(form, 2, middle - (rim - middle)));
        CHECK(number_of(form, "radius").value() > 0.0);
    }
}

SCENARIO("A narrowing is corrected by mouse", "[window][handles]") {
    const auto shell = test_shell();
    if (!shell) return;
    const std::string file = temporary_folder() + "/narrow.vtp";
    write_surface(narrow_tube(), file);
    open_and_wait(*shell, file);
    REQUIRE(shell->click_item("rail.local-repair"));
    REQUIRE(shell->click_item("choose.correct-narrowing"));
    Workplace& place = shell->app().place();
    place.set_field("at", "0,-1,20");
    place.disarm();
    REQUIRE(shell->settle(60s));
    REQUIRE(shell->has("stretch.radius"));
    const ScreenRect rect = shell->app().ui().items().at("stretch.to").rect;
    const double before = place.form()->field("to").automatic
                              ? std::get<Vec3>(*place.form()->field("to").automatic).z()
                              : 0.0;
    shell->drag(rect.middle_x(), rect.middle_y(), rect.middle_x(), rect.middle_y() - 12);
    REQUIRE(shell->settle(60s));
    const auto to = point_of(*place.form(), "to");
    REQUIRE(to);
    CHECK(to->z() > before + 0.2);
    REQUIRE(shell->click_item("operation.apply"));
    REQUIRE(shell->settle(60s));
    double narrowest = 10.0;
    for (const Vec3& p : place.document.current()->surface->points())
        if (p.z() > 2.0 && p.z() < 38.0) narrowest = std::min(narrowest, std::hypot(p.x(), p.y()));
    CHECK(narrowest > 1.85);
}
