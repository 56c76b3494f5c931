#include "workbench/window/case/pick_target.h"

#include <cmath>

#include <catch2/catch.hpp>

#include "workbench/operations/table.h"
#include "workbench/window/form/picked_text.h"

using namespace vesselbench;

namespace {

std::optional<PickTarget> target_of(const std::string& operation, const std::string& parameter) {
    return pick_target(find_parameter(find_operation(operation), parameter));
}

}  // namespace

SCENARIO("Parameters that are places can be picked", "[window][picking]") {
    CHECK(target_of("remove-branch", "tip") == PickTarget::Tip);
    CHECK(target_of("clip-opening", "tip") == PickTarget::Tip);
    CHECK(target_of("clip-opening", "inlet") == PickTarget::Opening);
    CHECK(target_of("clip-opening", "open") == PickTarget::Ends);
    CHECK(target_of("clip-opening", "closed") == PickTarget::Ends);
    CHECK(target_of("fill-hole", "near") == PickTarget::Surface);
    CHECK(target_of("brush-smooth", "at") == PickTarget::Surface);
    CHECK(target_of("crop", "centre") == PickTarget::Surface);
    CHECK(target_of("crop", "box") == PickTarget::Corners);
}

SCENARIO("Every place that an operation takes says what it means", "[window][picking]") {
    for (const Operation& operation : operation_table())
        for (const Parameter& parameter : operation.parameters) {
            const bool place = parameter.type == ParameterType::Point && parameter.unit == "mm" &&
                               !std::isfinite(parameter.minimum);
            INFO(operation.name << " " << parameter.name);
            CHECK((!place || parameter.meaning != Meaning::None));
        }
}

SCENARIO("Other parameters cannot be picked", "[window][picking]") {
    CHECK_FALSE(target_of("smooth", "cell"));
    CHECK_FALSE(target_of("smooth", "stack_axis"));
    CHECK_FALSE(target_of("smooth", "iterations"));
    CHECK_FALSE(target_of("clip-opening", "planes"));
    CHECK_FALSE(target_of("crop", "radius"));
    CHECK_FALSE(target_of("extract-surface", "threshold"));
}

SCENARIO("Seeds and labels are picked in slices", "[window][picking]") {
    CHECK(target_of("extract-surface", "seed") == PickTarget::Voxel);
    CHECK(target_of("extract-surface", "labels") == PickTarget::Labels);
    CHECK(is_in_slices(PickTarget::Voxel));
    CHECK_FALSE(is_in_slices(PickTarget::Corners));
    CHECK(picked_labels("", 3) == "3");
    CHECK(picked_labels("3,7", 5) == "3,5,7");
    CHECK(picked_labels("3,5,7", 5) == "3,7");
    CHECK(picked_labels("3", 3).empty());
    CHECK_FALSE(is_complete(PickTarget::Labels, "3,7"));
}

SCENARIO("A picked place is a short text of the command line", "[window][picking]") {
    const std::string text = picked_text(PickTarget::Tip, "", Vec3(1.23456789, -0.00001, 40));
    CHECK(text == "1.23,0,40");
    OperationForm form(find_operation("remove-branch"));
    CHECK_FALSE(form.valid());
    form.set("tip", text);
    CHECK(form.valid());
    CHECK(form.arguments().point("tip") == Vec3(1.23, 0, 40));
    REQUIRE(places_in(form).size() == 1);
    CHECK(places_in(form)[0].name == "Tip");
    CHECK(places_in(form)[0].point == Vec3(1.23, 0, 40));
    CHECK(wants_tips(form));
}

SCENARIO("Openings that are clicked are collected, and removed by another click",
         "[window][picking]") {
    const std::string one = picked_text(PickTarget::Opening, "", Vec3(1, 2, 3));
    const std::string two = picked_text(PickTarget::Opening, one, Vec3(4, 5, 6));
    CHECK(two == "1,2,3,4,5,6");
    OperationForm form(find_operation("clip-opening"));
    form.set("inlet", two);
    CHECK(form.valid());
    REQUIRE(places_in(form).size() == 2);
    CHECK(places_in(form)[1].point == Vec3(4, 5, 6));
    CHECK(picked_text(PickTarget::Opening, two, Vec3(1, 2, 3)) == "4,5,6");
    CHECK(picked_text(PickTarget::Opening, "4,5,6", Vec3(4, 5, 6)).empty());
}

SCENARIO("Two corners make a box", "[window][picking]") {
    const std::string first = picked_text(PickTarget::Corners, "", Vec3(5, 0, 1));
    CHECK(first == "5,0,1");
    CHECK_FALSE(is_complete(PickTarget::Corners, first));
    const std::string box = picked_text(PickTarget::Corners, first, Vec3(1, 2, 9));
    CHECK(box == "1,0,1,5,2,9");
    CHECK(is_complete(PickTarget::Corners, box));
    WHEN("it is picked again") {
        CHECK(picked_text(PickTarget::Corners, box, Vec3(0, 0, 0)) == "0,0,0");
    }
}
