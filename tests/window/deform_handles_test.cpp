#include <catch2/catch.hpp>

#include "tests/support/shapes.h"
#include "workbench/operations/table.h"
#include "workbench/window/features/handles/deform_handles.h"

using namespace vesselbench;
using namespace vesselbench::test;

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
        tube.fill(deform_texts(tube.form, rest, 0, rest.from + Vec3(2, 0, 0)));
        CHECK(tube.form.arguments().point("move") == Vec3(2, 0, 0));
        const BranchPreview bent = tube.find();
        CHECK(bent.problem.empty());
        CHECK(bent.axis.bent != bent.axis.rest);
        CHECK(bent.rings.size() > 5);
        CHECK(deform_shape(tube.form, bent).lines.size() > 7);
    }
    WHEN("it is dragged too far") {
        tube.form.set("reach", "4");
        tube.fill(deform_texts(tube.form, rest, 0, rest.from + Vec3(6, 0, 0)));
        const BranchPreview bent = tube.find();
        CHECK(!bent.problem.empty());
        CHECK(bent.axis.bent == bent.axis.rest);
    }
    WHEN("the reach is dragged along the axis") {
        tube.fill(deform_texts(tube.form, rest, 1, rest.from - Vec3(0, 0, 10)));
        CHECK(tube.form.arguments().real("reach") == Approx(10.0).margin(0.5));
    }
}

SCENARIO("Forms without a place have no bent branch", "[window][handles]") {
    CHECK_FALSE(deforms_branch(OperationForm(find_operation("crop"))));
    CHECK_FALSE(deformation_in(OperationForm(find_operation("deform-branch"))));
}
