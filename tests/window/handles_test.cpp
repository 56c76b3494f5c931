#include <algorithm>
#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "geometry/kernel/measure.h"
#include "tests/support/shapes.h"
#include "workbench/operations/shared/opening_arguments.h"
#include "workbench/operations/table.h"
#include "workbench/window/drawing/handle.h"
#include "workbench/window/features/handles/crop_handles.h"
#include "workbench/window/features/handles/cut_handles.h"
#include "workbench/window/features/handles/length_handles.h"
#include "workbench/window/features/handles/tool_handles.h"
#include "workbench/window/features/openings/opening_roles.h"

using namespace vesselbench;
using namespace vesselbench::test;
using Catch::Matchers::Contains;

namespace {

/// From the front: x to the right, z up, half a millimetre a pixel, the origin in the middle.
const PixelView kFront{.camera = {.half_height = 50.0}, .width = 400, .height = 200};

bool near(const Vec3& a, const Vec3& b, double margin = 1e-6) {
    return (a - b).norm() < margin;
}

void fill(OperationForm& form, const std::vector<FieldText>& texts) {
    for (const FieldText& field : texts) form.set(field.parameter, field.text);
}

const Bounds kModel{.min = {0, 0, 0}, .max = {10, 20, 30}};

/// The upper end of a tube of 4 mm radius, to be cut.
struct TubeCut {
    Surface tube = fine_tube(4, 30, 96);
    OperationForm form{find_operation("clip-opening")};

    TubeCut() { form.set("tip", "0,0,30"); }

    [[nodiscard]] Cut find(const std::shared_ptr<const CutBranch>& known = nullptr) const {
        return find_cut(tube, cut_question(form).value(), known);
    }
};

/// The only opening's role and name.
Patch patch_in(const OperationForm& form) {
    return patches_in(records_of(form, "names")).at(0);
}

/// The only opening's plane.
Plane plane_in(const OperationForm& form) {
    return openings_in(records_of(form, "planes")).at(0).place.plane;
}

double tilt_of(const OperationForm& form) {
    return std::acos(plane_in(form).normal.z()) * 180 / std::numbers::pi;
}

}  // namespace

SCENARIO("Handles follow the cursor as far as their paths allow", "[window][handles]") {
    CHECK(kFront.place({10, 5, 20})->isApprox(ViewPixel(220, 60)));
    CHECK(kFront.pixel_at({0, 0, 0}) == Approx(0.5));
    Handle handle{.name = "a", .point = {0, 3, 0}};
    GIVEN("a free one") {
        CHECK(near(dragged_point(handle, kFront, {220, 80}), {10, 3, 10}));
    }
    GIVEN("one on a line") {
        handle.path = HandlePath::Line;
        CHECK(near(dragged_point(handle, kFront, {220, 80}), {0, 3, 10}));
        THEN("it stays if the line is seen from its end") {
            handle.direction = Vec3::UnitY();
            CHECK(near(dragged_point(handle, kFront, {220, 80}), {0, 3, 0}));
            CHECK_FALSE(can_be_dragged(handle, kFront));
            CHECK_FALSE(nearest_handle({handle}, kFront, {200, 100}, 8));
        }
        THEN("it is under the cursor in perspective, too") {
            PixelView view = kFront;
            view.camera.perspective = true;
            handle.direction = Vec3(1, 1, 1).normalized();
            const ViewPixel to = *view.place(handle.point + 7.0 * handle.direction);
            CHECK(near(dragged_point(handle, view, to), handle.point + 7.0 * handle.direction));
        }
    }
    GIVEN("one on a track") {
        handle.path = HandlePath::Track;
        handle.track = {{0, 0, 0}, {0, 0, 20}, {20, 0, 20}};
        CHECK(near(dragged_point(handle, kFront, {222, 50}), {11, 0, 20}));
        CHECK(near(dragged_point(handle, kFront, {200, 190}), {0, 0, 0}));
    }
    GIVEN("one around a pivot") {
        handle.path = HandlePath::Ball;
        handle.point = {0, -10, 0};
        CHECK(near(dragged_point(handle, kFront, {210, 100}), {5, -std::sqrt(75.0), 0}));
        THEN("beside the ball it is on its outline") {
            CHECK(near(dragged_point(handle, kFront, {300, 100}), {10, 0, 0}));
        }
        THEN("one on the far side stays there") {
            handle.point = {0, 10, 0};
            CHECK(near(dragged_point(handle, kFront, {210, 100}), {5, std::sqrt(75.0), 0}));
        }
    }
}

SCENARIO("The handle under the cursor is the nearest one within reach", "[window][handles]") {
    const std::vector<Handle> handles = {{.name = "a", .point = {0, 0, 0}},
                                         {.name = "b", .point = {5, 0, 0}},
                                         {.name = "hidden", .point = {0, 9, 0}}};
    CHECK(nearest_handle(handles, kFront, {203, 100}, 8) == 0U);
    CHECK(nearest_handle(handles, kFront, {207, 100}, 8) == 1U);
    CHECK_FALSE(nearest_handle(handles, kFront, {203, 120}, 8));
}

SCENARIO("A crop box is dragged by its faces and corners", "[window][handles]") {
    OperationForm form(find_operation("crop"));
    REQUIRE(has_field(form, Meaning::Box));
    GIVEN("no region yet") {
        const FormShape offered = crop_shape(form, kModel);
        REQUIRE(offered.handles.size() == 14);
        CHECK(offered.lines.front().faint);
        CHECK(offered.handles[3].name == "crop.face.x1");
        CHECK(offered.handles[3].point.x() == 10);
        THEN("a drag makes a box that keeps the rest of what is offered") {
            fill(form, crop_texts(form, kModel, 3, {6.004, 1, 1}));
            const auto box = form.arguments().list("box");
            CHECK(box[3] == 6.0);
            CHECK(box[0] == 0);
            CHECK(box[5] == 30);
            CHECK_FALSE(crop_shape(form, kModel).lines.front().faint);
        }
    }
    GIVEN("a typed box") {
        form.set("box", "1,2,3,4,6,8");
        CHECK(near(crop_shape(form, kModel).handles[0].point, {1, 4, 5.5}));
        CHECK(crop_texts(form, kModel, 2, {9, 9, 3.25}) ==
              std::vector<FieldText>{{"box", "1,2,3.25,4,6,8"}});
        THEN("its last corner moves three faces") {
            CHECK(crop_texts(form, kModel, 13, {5, 7, 9}) ==
                  std::vector<FieldText>{{"box", "1,2,3,5,7,9"}});
        }
        THEN("a face cannot pass the other one") {
            CHECK(crop_texts(form, kModel, 0, {7, 0, 0}) ==
                  std::vector<FieldText>{{"box", "3.9,2,3,4,6,8"}});
        }
    }
    GIVEN("half a box, as after the first of two clicks") {
        form.set("box", "1,2,3");
        CHECK(crop_shape(form, kModel).handles.empty());
    }
}

SCENARIO("A crop ball is dragged by its centre and its outline", "[window][handles]") {
    OperationForm form(find_operation("crop"));
    form.set("centre", "1,2,3");
    CHECK(crop_shape(form, kModel).lines.front().faint);
    form.set("radius", "5");
    const FormShape shape = crop_shape(form, kModel);
    REQUIRE(shape.handles.size() == 7);
    CHECK(shape.lines.size() == 3);
    for (const RegionLine& line : shape.lines)
        for (const Vec3& point : line.points) CHECK((point - Vec3(1, 2, 3)).norm() == Approx(5));
    CHECK(near(shape.handles[4].point, {6, 2, 3}));
    CHECK(crop_texts(form, kModel, 4, {8.5, 2, 3}) ==
          std::vector<FieldText>{{"centre", "1,2,3"}, {"radius", "7.5"}});
    CHECK(crop_texts(form, kModel, 0, {4, 4, 4}) ==
          std::vector<FieldText>{{"centre", "4,4,4"}, {"radius", "5"}});
    form.set("radius", "-5");
    CHECK(crop_shape(form, kModel).lines.front().faint);
    CHECK_FALSE(has_field(OperationForm(find_operation("smooth")), Meaning::Box));
}

SCENARIO("A cap is dragged along its axis, with whole diameters as detents", "[window][handles]") {
    OperationForm form(find_operation("extrude-opening"));
    const auto patches = measure_patches(closed_tube(4, 30, 96, 10));
    const std::vector<PatchMeasures> openings(patches.begin() + 1, patches.end());
    const double diameter = 2 * std::sqrt(openings[1].area / std::numbers::pi);
    REQUIRE(diameter == Approx(8).epsilon(0.002));
    REQUIRE(has_field(form, Meaning::Openings));
    const FormShape shape = length_shape(form, openings);
    REQUIRE(shape.handles.size() == 2);
    CHECK(shape.handles[1].name == "length.outlet_1");
    CHECK(near(shape.handles[1].point, {0, 0, 30 + 3 * diameter}));
    CHECK_THAT(shape.notes[1].text, Contains("3 diameters"));
    WHEN("it is dragged to 12.345 mm") {
        fill(form, length_texts(form, openings, 1, {0.5, 0, 42.345}, 0.3));
        THEN("only its own length changes") {
            CHECK(form.field("opening").text == "inlet,outlet_1");
            const std::vector<double> lengths = form.arguments().list("lengths");
            CHECK(lengths.at(0) == Approx(3 * diameter).margin(0.0051));
            CHECK(lengths.at(1) == Approx(12.35).margin(0.0051));
            const auto handles = length_shape(form, openings).handles;
            CHECK(handles.at(0).point.z() == Approx(-3 * diameter).margin(0.0051));
            CHECK(handles.at(1).point.z() == Approx(42.35).margin(0.0051));
        }
    }
    WHEN("it is dragged near two diameters") {
        form.set("length", "5");
        fill(form, length_texts(form, openings, 1, {0, 0, 30 + 2 * diameter + 0.2}, 0.3));
        const std::vector<double> lengths = form.arguments().list("lengths");
        CHECK(lengths.at(0) == 5.0);
        CHECK(lengths.at(1) == Approx(2 * diameter).margin(0.0051));
    }
    WHEN("it is dragged into the vessel") {
        fill(form, length_texts(form, openings, 1, {0, 0, 10}, 0.3));
        CHECK(form.arguments().list("lengths").at(1) == Approx(0.8).margin(0.01));
    }
    WHEN("one opening is named") {
        form.set("opening", "inlet");
        CHECK(length_shape(form, openings).handles.size() == 1);
    }
}

SCENARIO("A cut stays perpendicular to the centerline while it slides", "[window][handles]") {
    TubeCut tube;
    tube.form.set("distance", "10");
    const Cut cut = tube.find();
    REQUIRE(cut.problem.empty());
    CHECK(cut.diameter == Approx(8).epsilon(0.002));
    CHECK(cut.area == Approx(std::numbers::pi * 16).epsilon(0.004));
    CHECK(cut.plane.normal.z() == Approx(1).epsilon(1e-4));
    CHECK(cut.plane.point.z() == Approx(20).margin(0.1));
    CHECK(cut.tilt_deg < 1);
    for (const Vec3& point : cut.ring)
        CHECK(std::hypot(point.x(), point.y()) == Approx(4).epsilon(0.003));
    const FormShape shape = cut_shape(tube.form, cut);
    REQUIRE(shape.handles.size() == 2);
    CHECK(near(shape.handles[0].point, {0, 0, 20}, 0.1));
    CHECK_THAT(shape.notes.front().text, Contains("diameter 8.00 mm, area 50.2 mm\u00B2"));
    WHEN("it is dragged") {
        fill(tube.form, cut_texts(tube.form, cut, 0, {0, 0, 17}));
        CHECK(tube.form.arguments().real("distance") == Approx(13).margin(0.1));
        CHECK(near(cut_shape(tube.form, cut).handles[0].point, {0, 0, 17}, 0.1));
        CHECK(tube.find(cut.branch).branch == cut.branch);
    }
    WHEN("it is dragged beyond the tip") {
        fill(tube.form, cut_texts(tube.form, cut, 0, {0, 0, 50}));
        CHECK(tube.form.arguments().real("distance") == Approx(0.01));
    }
    WHEN("the distance is typed") {
        tube.form.set("distance", "5");
        CHECK(near(cut_shape(tube.form, cut).handles[0].point, {0, 0, 25}, 0.1));
    }
}

SCENARIO("A cut is tilted by its normal", "[window][handles]") {
    TubeCut tube;
    tube.form.set("distance", "10");
    const Cut cut = tube.find();
    const Vec3 at = cut.plane.point;
    WHEN("it is hardly tilted") {
        const auto texts = cut_texts(tube.form, cut, 1, at + Vec3(0.2, 0, 8));
        CHECK(texts.front().parameter == "distance");
        CHECK_FALSE(texts.front().text.empty());
    }
    WHEN("it is tilted by 30 degrees") {
        fill(tube.form, cut_texts(tube.form, cut, 1, at + Vec3(4, 0, 4 * std::sqrt(3.0))));
        REQUIRE(tube.form.arguments().records("planes").list().size() == 1);
        CHECK(tilt_of(tube.form) == Approx(30).margin(0.01));
        CHECK(patch_in(tube.form) == Patch{"outlet_1", PatchKind::Outlet});
        CHECK(tube.form.valid());
        THEN("a typed role and name are those of the opening, as without the tilt") {
            OperationForm typed = tube.form;
            typed.set("kind", "inlet");
            fill(typed, cut_texts(typed, cut, 1, at + Vec3(4, 0, 4)));
            CHECK(patch_in(typed) == Patch{"outlet_1", PatchKind::Inlet});
            typed.set("name", "neck");
            fill(typed, cut_texts(typed, cut, 1, at + Vec3(4, 0, 4)));
            CHECK(patch_in(typed) == Patch{"neck", PatchKind::Inlet});
        }
        const Cut tilted = tube.find(cut.branch);
        CHECK(tilted.tilt_deg == Approx(30).margin(1));
        CHECK(tilted.area ==
              Approx(std::numbers::pi * 16 / std::cos(std::numbers::pi / 6)).epsilon(0.005));
        CHECK_THAT(cut_shape(tube.form, tilted).notes.front().text, Contains("tilted 30"));
        THEN("it keeps its tilt when it slides") {
            fill(tube.form, cut_texts(tube.form, tilted, 0, {0, 0, 15}));
            CHECK(plane_in(tube.form).point.z() == Approx(15).margin(0.1));
            CHECK(tilt_of(tube.form) == Approx(30).margin(1));
        }
        THEN("turned back it is perpendicular again") {
            fill(tube.form, cut_texts(tube.form, tilted, 1, at + Vec3(0, 0, 8)));
            CHECK(tube.form.field("planes").text.empty());
            CHECK(tube.form.arguments().real("distance") == Approx(10).margin(0.1));
        }
    }
    WHEN("it is tilted to the side") {
        fill(tube.form, cut_texts(tube.form, cut, 1, at + Vec3(8, 0, 0)));
        CHECK(tilt_of(tube.form) == Approx(60).margin(0.01));
    }
}

SCENARIO("A cut that is not possible says why", "[window][handles]") {
    TubeCut tube;
    tube.form.set("distance", "100");
    const Cut cut = tube.find();
    CHECK_THAT(cut.problem, Contains("long"));
    REQUIRE(cut.branch);
    CHECK(cut_shape(tube.form, cut).handles.size() == 1);
    tube.form.set("tip", "");
    CHECK_FALSE(cut_question(tube.form));
}

SCENARIO("An opening's role is text of the form", "[window][handles]") {
    const Surface tube = closed_tube(4, 30, 24, 10);
    const auto patches = measure_patches(tube);
    OperationForm form(find_operation("clip-opening"));
    REQUIRE(has_field(form, Meaning::Inlet));
    WHEN("the outlet becomes the inlet") {
        form.set("kind", "outlet");
        fill(form, role_texts(patches.at(2), PatchKind::Inlet, tube.patches));
        CHECK(form.field("tip").text == "0,0,30");
        CHECK(form.field("inlet").text == "0,0,30");
        CHECK(form.field("kind").text.empty());
    }
    WHEN("the inlet becomes an outlet") {
        fill(form, role_texts(patches.at(1), PatchKind::Outlet, tube.patches));
        CHECK(form.field("kind").text == "outlet");
        CHECK(form.field("name").text == "outlet_2");
    }
    CHECK(form.valid());
    CHECK(with_name_switched("", "inlet") == "inlet");
    CHECK(with_name_switched("inlet", "outlet_1") == "inlet,outlet_1");
    CHECK(with_name_switched("inlet,outlet_1", "inlet") == "outlet_1");
}

SCENARIO("The handles of a stamp's tool set its place, direction and sizes", "[window][handles]") {
    OperationForm form(find_operation("stamp"));
    CHECK(has_tool(form));
    CHECK_FALSE(has_tool(OperationForm(find_operation("crop"))));
    CHECK(tool_shape(form, kModel).handles.empty());  // nothing is known of it
    form.set_automatic({{"centre", Vec3(1, 2, 3)},
                        {"direction", Vec3(0, 0, 1)},
                        {"along", Vec3(1, 0, 0)},
                        {"thickness", 1.0},
                        {"length", 4.0},
                        {"width", 2.0}});
    const FormShape shape = tool_shape(form, kModel);
    const auto texts = [&](const std::string& name, const Vec3& to) {
        const auto at = std::ranges::find(shape.handles, name, &Handle::name);
        REQUIRE(at != shape.handles.end());
        return tool_texts(form, kModel, static_cast<std::size_t>(at - shape.handles.begin()), to);
    };
    using Texts = std::vector<FieldText>;
    CHECK(texts("tool.centre", {5, 6, 7}) == Texts{{"centre", "5,6,7"}});
    CHECK(texts("tool.direction", {1, 2, 9}) == Texts{{"direction", "0,0,1"}});
    CHECK(texts("tool.direction", {9, 2, 3}) == Texts{{"direction", "1,0,0"}});
    CHECK(texts("tool.thickness", {1, 2, 4}) == Texts{{"thickness", "2"}});
    CHECK(texts("tool.length", {4, 2, 3}) == Texts{{"length", "6"}});
    CHECK(texts("tool.width", {1, 2.5, 3}) == Texts{{"width", "1"}});
    for (const RegionLine& line : shape.lines)
        for (const Vec3& p : line.points) CHECK((p - Vec3(1, 2, 3)).cwiseAbs().maxCoeff() <= 2.0);
}

SCENARIO("The handles of a capsule and of a path", "[window][handles]") {
    OperationForm form(find_operation("stamp"));
    fill(form, {{"shape", "capsule"},
                {"centre", "0,0,5"},
                {"direction", "0,0,1"},
                {"radius", "1"},
                {"length", "4"}});
    const FormShape capsule = tool_shape(form, kModel);
    REQUIRE(capsule.handles.size() == 4);
    CHECK(near(capsule.handles[3].point, {0, 0, 2}));
    CHECK(tool_texts(form, kModel, 3, {0, 0, 1}) == std::vector<FieldText>{{"length", "6"}});
    form.set("shape", "polygon");
    const FormShape offered = tool_shape(form, kModel);
    REQUIRE(offered.handles.size() == 3);
    CHECK(offered.lines.front().faint);
    form.set("path", "0,0,0,4,0,0");
    CHECK_FALSE(tool_shape(form, kModel).lines.front().faint);
    CHECK(tool_texts(form, kModel, 2, {6, 1, 0}) ==
          std::vector<FieldText>{{"path", "0,0,0,4,0,0,6,1,0"}});
}
