// The box that is offered for cropping, and how it is drawn in slices.

#include <catch2/catch.hpp>

#include "geometry/formats/image_file.h"
#include "tests/support/image_shapes.h"
#include "tests/support/paths.h"
#include "tests/support/shapes.h"
#include "tests/window/window_support.h"
#include "workbench/operations/table.h"
#include "workbench/window/drawing/screen_places.h"
#include "workbench/window/features/handles/crop_handles.h"
#include "workbench/window/features/slices/slice_pane.h"
#include "workbench/window/keys/keys.h"

using namespace vesselbench;
using namespace vesselbench::test;
using namespace std::chrono_literals;

namespace {

const Bounds kOffered{.min = {0, 0, 0}, .max = {10, 20, 30}};

/// 40 x 36 x 28 voxels of 1 x 1 x 1.5 mm from 0, 0, 0 on, with a bright ball.
Image image() {
    const Eigen::Matrix4d matrix = Eigen::Vector4d(1, 1, 1.5, 1).asDiagonal();
    return image_of({40, 36, 28}, matrix, [](const Vec3& p) {
        return (p - Vec3(20, 18, 20)).norm() < 8.0 ? 900.0 : 100.0;
    });
}

void fill(OperationForm& form, const std::vector<FieldText>& texts) {
    for (const FieldText& field : texts) form.set(field.parameter, field.text);
}

std::string box_in(const std::vector<FieldText>& texts) {
    return texts.front().parameter == "box" ? texts.front().text : "";
}

/// The form that crops an opened image.
struct Cropping {
    Cropping() : shell(test_shell()) {
        if (!shell) return;
        const std::string file = temporary_folder() + "/image.mha";
        write_image(file, image());
        open_and_wait(*shell, file);
        place().slices().show_row(false);
        place().choose("crop");
        REQUIRE(shell->settle(30s));
    }

    [[nodiscard]] Workplace& place() const { return shell->app().place(); }

    [[nodiscard]] std::vector<double> box() const { return list_of(*place().form(), "box"); }

    /// Where a place is seen in a slice that is shown as a whole.
    [[nodiscard]] Eigen::Vector2f seen(SlicePlane plane, const Vec3& point) const {
        const ScreenRect rect =
            shell->app().ui().items().at(std::string("slice.") + axes_of(plane).key + ".area").rect;
        const ImageSlices& slices = place().slices();
        const ViewCamera camera =
            slice_camera(slices.grid(), plane, slices.position(plane), rect.width / rect.height);
        return on_screen(camera, rect).place(point)->cast<float>();
    }

    void drag(SlicePlane plane, const Vec3& from, const Vec3& to) const {
        const Eigen::Vector2f a = seen(plane, from), b = seen(plane, to);
        shell->drag(a.x(), a.y(), b.x(), b.y());
        REQUIRE(shell->settle(30s));
    }

    std::unique_ptr<OffscreenShell> shell;
};

}  // namespace

SCENARIO("The offered box holds all that is cropped", "[window][crop]") {
    const OperationForm form(find_operation("crop"));
    OfferedBox offered;
    Scene scene;
    scene.surface = icosphere(5.0, 2);
    offered.update(&scene, &form);
    REQUIRE(offered.bounds());
    CHECK(offered.bounds()->max.x() > 5.0);
    scene.image = image();
    offered.update(&scene, &form);
    CHECK(offered.bounds()->min == Vec3(-0.5, -0.5, -0.75));
    CHECK(offered.bounds()->max == Vec3(39.5, 35.5, 41.25));
    const OperationForm other(find_operation("smooth"));
    offered.update(&scene, &other);
    CHECK_FALSE(offered.bounds());
    offered.update(nullptr, &form);
    CHECK_FALSE(offered.bounds());
}

SCENARIO("A crop box is changed in a slice", "[window][crop]") {
    OperationForm form(find_operation("crop"));
    GIVEN("no box yet") {
        const FormShape shape = crop_slice_shape(form, kOffered, SlicePlane::Axial, 12.0);
        REQUIRE(shape.handles.size() == 8);
        CHECK(shape.handles[1].name == "crop.axial.x1");
        CHECK(shape.handles[1].point == Vec3(10, 10, 12));
        CHECK(shape.handles[7].name == "crop.axial.x1y1");
        CHECK(shape.handles[7].point == Vec3(10, 20, 12));
        REQUIRE(shape.lines.size() == 1);
        CHECK(shape.lines[0].faint);
        THEN("a rectangle sets two axes, and the third is the offered one's") {
            CHECK(box_in(crop_rectangle_texts(form, kOffered, SlicePlane::Axial, {7, 3, 12},
                                              {2, 9, 12})) == "2,3,0,7,9,30");
            CHECK(box_in(crop_rectangle_texts(form, kOffered, SlicePlane::Sagittal, {5, 3, 12},
                                              {5, 9, 2})) == "0,3,2,10,9,12");
        }
    }
    GIVEN("a box") {
        form.set("box", "1,2,3,4,6,8");
        THEN("a rectangle in another slice keeps its third axis") {
            CHECK(box_in(crop_rectangle_texts(form, kOffered, SlicePlane::Coronal, {0, 5, 1},
                                              {9, 5, 7})) == "0,2,1,9,6,7");
        }
        THEN("its sides and corners are dragged, whatever the slice's position") {
            const auto dragged = [&](std::size_t handle, const Vec3& to) {
                return box_in(crop_slice_texts(form, kOffered, SlicePlane::Axial, handle, to));
            };
            CHECK(dragged(1, {5, 0, 20}) == "1,2,3,5,6,8");
            CHECK(dragged(4, {0, 1, 20}) == "0,1,3,4,6,8");
            CHECK(dragged(0, {7, 0, 0}) == "3.9,2,3,4,6,8");  // a side cannot pass the other one
        }
        THEN("it is faint in slices beside it") {
            const auto faint = [&](double position) {
                return crop_slice_shape(form, kOffered, SlicePlane::Axial, position)
                    .lines.at(0)
                    .faint;
            };
            CHECK(faint(2.0));
            CHECK_FALSE(faint(5.0));
        }
    }
    GIVEN("a ball") {
        form.set("centre", "5,5,5");
        form.set("radius", "5");
        const FormShape shape = crop_slice_shape(form, kOffered, SlicePlane::Axial, 8.0);
        CHECK(shape.handles.empty());
        for (const Vec3& point : shape.lines.at(0).points)
            CHECK((point - Vec3(5, 5, 8)).norm() == Approx(4.0));
        CHECK(crop_slice_shape(form, kOffered, SlicePlane::Axial, 11.0).lines.empty());
        THEN("a rectangle makes a box of it") {
            fill(form,
                 crop_rectangle_texts(form, kOffered, SlicePlane::Axial, {2, 3, 8}, {7, 9, 8}));
            CHECK(form.arguments() == Arguments{{"box", std::vector<double>{2, 3, 0, 7, 9, 30}}});
        }
    }
}

SCENARIO("The image's box has handles in space and in every slice", "[window][crop]") {
    const Cropping crop;
    if (!crop.shell) return;
    CHECK(crop.place().slices().in_row());
    for (const char* handle : {"crop.face.x1", "crop.corner.0", "crop.axial.x1", "crop.coronal.z0",
                               "crop.sagittal.y1z1"}) {
        INFO(handle);
        CHECK(crop.shell->has(handle));
    }
    CHECK(crop.box().empty());
    WHEN("a rectangle is dragged in a slice") {
        crop.drag(SlicePlane::Axial, {10, 8, 0}, {30, 28, 0});
        THEN("it is the box, as high as the image") {
            const std::vector<double> box = crop.box();
            REQUIRE(box.size() == 6);
            CHECK(box[0] == Approx(10).margin(0.5));
            CHECK(box[1] == Approx(8).margin(0.5));
            CHECK(box[3] == Approx(30).margin(0.5));
            CHECK(box[4] == Approx(28).margin(0.5));
            CHECK(box[2] == Approx(-0.75).margin(0.01));
            CHECK(box[5] == Approx(41.25).margin(0.01));
        }
        THEN("its side is dragged in another slice") {
            const Vec3 side(20, 0, 41.25);
            crop.drag(SlicePlane::Coronal, side, {20, 0, 30});
            CHECK(crop.box().at(5) == Approx(30).margin(0.5));
            CHECK(crop.box().at(0) == Approx(10).margin(0.5));
            REQUIRE(crop.place().take_back_drag());
            CHECK(crop.box().at(5) == Approx(41.25).margin(0.01));
        }
    }
    WHEN("a drag is cancelled") {
        const Eigen::Vector2f at = crop.seen(SlicePlane::Axial, {10, 8, 0});
        crop.shell->move_mouse(at.x(), at.y());
        crop.shell->press(MouseButton::Left);
        crop.shell->move_mouse(at.x() + 40, at.y() + 30);
        CHECK(crop.box().size() == 6);
        crop.shell->press_key(keys::kEscape);
        crop.shell->move_mouse(at.x() + 50, at.y() + 30);
        crop.shell->release(MouseButton::Left);
        CHECK(crop.box().empty());
        CHECK(crop.place().form());
    }
    WHEN("a slice is clicked") {
        const Eigen::Vector2f at = crop.seen(SlicePlane::Axial, {12, 9, 0});
        crop.shell->click(at.x(), at.y());
        REQUIRE(crop.shell->settle(30s));
        CHECK((crop.place().slices().cross().head<2>() - Eigen::Vector2d(12, 9)).norm() < 1.0);
        CHECK(crop.box().empty());
    }
}
