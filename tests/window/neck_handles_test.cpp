#include "workbench/window/features/handles/neck_handles.h"

#include <catch2/catch.hpp>

#include "workbench/operations/table.h"
#include "workbench/window/form/field_text.h"

using namespace vesselbench;

namespace {

/// A form whose operation has decided a neck perpendicular to z.
OperationForm decided_form() {
    OperationForm form(find_operation("mark-neck"));
    form.set_automatic(
        {{"dome", Vec3(0, 0, 6)}, {"at", Vec3(0, 0, 2)}, {"normal", Vec3(0, 0, -1)}});
    return form;
}

void fill(OperationForm& form, const std::vector<FieldText>& texts) {
    for (const FieldText& field : texts) form.set(field.parameter, field.text);
}

}  // namespace

SCENARIO("A neck is shown as the operation decides it, until it is dragged", "[window][handles]") {
    OperationForm form = decided_form();
    REQUIRE(has_field(form, Meaning::Neck));
    CHECK(neck_shape(OperationForm(find_operation("mark-neck"))).handles.empty());
    const FormShape shape = neck_shape(form);
    REQUIRE(shape.handles.size() == 2);
    CHECK(shape.handles[0].point == Vec3(0, 0, 2));
    CHECK(shape.handles[1].point.z() > 2.0);
    CHECK(shape.lines.front().faint);
    WHEN("it is moved") {
        fill(form, neck_texts(form, 0, Vec3(3, 0, 2.5)));
        CHECK(point_of(form, "at") == Vec3(0, 0, 2.5));
        CHECK(point_of(form, "normal") == Vec3(0, 0, 1));
        CHECK(point_of(form, "dome") == Vec3(0, 0, 6));
        CHECK_FALSE(neck_shape(form).lines.front().faint);
        CHECK(form.valid());
    }
    WHEN("it is turned") {
        fill(form, neck_texts(form, 1, Vec3(3, 0, 6)));
        CHECK(point_of(form, "at") == Vec3(0, 0, 2));
        CHECK(point_of(form, "normal") == Vec3(0.6, 0, 0.8));
    }
}
