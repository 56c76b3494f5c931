#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>

#include "geometry/formats/image_file.h"
#include "tests/support/image_shapes.h"
#include "tests/support/paths.h"
#include "tests/support/shapes.h"
#include "tests/window/window_support.h"
#include "workbench/window/case/pick_target.h"
#include "workbench/window/drawing/screen_places.h"
#include "workbench/window/features/slices/slice_pane.h"
#include "workbench/window/form/picked_text.h"
#include "workbench/window/keys/keys.h"

using namespace vesselbench;
using namespace vesselbench::test;
using namespace std::chrono_literals;

namespace {

const Vec3 kBright(8, 22, -30);  // [mm]

/// Voxel edges along the patient's axes, of which two run backwards.
Eigen::Matrix4d flipped_matrix() {
    Eigen::Matrix4d matrix = Eigen::Vector4d(-1, -1, 1.5, 1).asDiagonal();
    matrix.topRightCorner<3, 1>() = Vec3(20, 40, -50);
    return matrix;
}

std::string image_file(const Image& image) {
    const std::string file = temporary_folder() + "/image.mha";
    write_image(file, image);
    return file;
}

/// A bright ball on a ground that rises with z.
Image ball_in(const Eigen::Matrix4d& matrix, const Vec3& centre) {
    return image_of({40, 36, 28}, matrix, [&](const Vec3& p) {
        return (p - centre).norm() < 6.0 ? 900.0 : 100.25 + 0.1 * p.z();
    });
}

/// Labels 1 and 2, left and right of x = 0, in a ball.
Image two_labels() {
    return image_of({40, 36, 28}, flipped_matrix(), [](const Vec3& p) {
        return (p - Vec3(0, 22, -30)).norm() > 12 ? 0 : p.x() > 0 ? 1 : 2;
    });
}

ImageSlices& slices_of(OffscreenShell& shell) {
    return shell.app().place().slices();
}

std::string area_of(SlicePlane plane) {
    return std::string("slice.") + axes_of(plane).key + ".area";
}

/// Where a place is seen in a 2D view that shows all of its slice.
Eigen::Vector2f seen_in(OffscreenShell& shell, SlicePlane plane, const Vec3& place) {
    REQUIRE(shell.has(area_of(plane)));
    const ScreenRect rect = shell.app().ui().items().at(area_of(plane)).rect;
    const ImageSlices& slices = slices_of(shell);
    const ViewCamera camera =
        slice_camera(slices.grid(), plane, slices.position(plane), rect.width / rect.height);
    return on_screen(camera, rect).place(place)->cast<float>();
}

void click_in(OffscreenShell& shell, SlicePlane plane, const Vec3& place) {
    const Eigen::Vector2f at = seen_in(shell, plane, place);
    shell.click(at.x(), at.y());
    REQUIRE(shell.settle(10s));
}

int brightness_at(const Picture& picture, const Eigen::Vector2f& at) {
    const auto x = static_cast<std::size_t>(at.x()), y = static_cast<std::size_t>(at.y());
    return picture.rgb[(y * static_cast<std::size_t>(picture.width) + x) * 3 + 1];
}

/// A cursor that is nowhere over the slices.
void leave(OffscreenShell& shell) {
    shell.move_mouse(5, 5);
    REQUIRE(shell.settle(10s));
}

}  // namespace

SCENARIO("An image's slices are shown at its sides of the patient", "[window][slices]") {
    const auto shell = test_shell();
    if (!shell) return;
    const auto matrix = GENERATE(flipped_matrix(), oblique_matrix({1, 1, 1.5}, {-20, 0, -60}),
                                 oblique_matrix({1, 1, 1.5}, {20, 10, -60}, true));
    Image image = ball_in(matrix, kBright);
    const Vec3 ball = middle_of(image) + Vec3(5, -4, 6);
    image = ball_in(matrix, ball);
    open_and_wait(*shell, image_file(image));
    REQUIRE(slices_of(*shell).in_row());
    slices_of(*shell).set_cross(ball);
    leave(*shell);
    const Picture picture = shell->picture();
    for (const SlicePlane plane : kSlicePlanes) {
        const Vec3 right = right_of(plane), up = up_of(plane);
        // Beside the lines of the other planes.
        const Vec3 inside = ball + 1.5 * right + 1.5 * up;
        CHECK(brightness_at(picture, seen_in(*shell, plane, inside)) > 200);
        for (const Vec3& side : {right, up, Vec3(-right), Vec3(-up)}) {
            const Vec3 beside = inside + 9.5 * side;
            CHECK(brightness_at(picture, seen_in(*shell, plane, beside)) < 100);
        }
    }
    CHECK(seen_in(*shell, SlicePlane::Axial, ball + Vec3(1, 0, 0)).x() >
          seen_in(*shell, SlicePlane::Axial, ball).x());
    CHECK(seen_in(*shell, SlicePlane::Axial, ball + Vec3(0, 1, 0)).y() >
          seen_in(*shell, SlicePlane::Axial, ball).y());
    CHECK(seen_in(*shell, SlicePlane::Sagittal, ball + Vec3(0, 1, 0)).x() >
          seen_in(*shell, SlicePlane::Sagittal, ball).x());
}

SCENARIO("Slices are moved by clicks, the wheel and sliders", "[window][slices]") {
    const auto shell = test_shell();
    if (!shell) return;
    open_and_wait(*shell, image_file(ball_in(flipped_matrix(), kBright)));
    ImageSlices& slices = slices_of(*shell);
    const Vec3 before = slices.cross();
    const Vec3 place(10, 15, before.z());
    click_in(*shell, SlicePlane::Axial, place);
    CHECK((slices.cross() - place).cwiseAbs().maxCoeff() <= 0.76);
    CHECK(slices.cross().z() == before.z());
    CHECK(slices.content(SlicePlane::Sagittal)->position == slices.cross().x());
    WHEN("the wheel turns over the coronal slice") {
        const Eigen::Vector2f at = seen_in(*shell, SlicePlane::Coronal, slices.cross());
        const double y = slices.cross().y();
        shell->move_mouse(at.x(), at.y());
        shell->wheel(2);
        REQUIRE(shell->settle(10s));
        CHECK(slices.cross().y() == Approx(y + 2));
        CHECK(slices.content(SlicePlane::Coronal)->position == Approx(y + 2));
    }
    WHEN("the end of a slider is clicked") {
        REQUIRE(shell->has("slice.axial.slider"));
        const ScreenRect rect = shell->app().ui().items().at("slice.axial.slider").rect;
        shell->click(rect.x + rect.width - 2, rect.middle_y());
        CHECK(slices.cross().z() == Approx(slices.grid().high().z() - 0.75));
    }
    WHEN("the view is moved first") {
        const Eigen::Vector2f at = seen_in(*shell, SlicePlane::Axial, place);
        shell->drag(at.x(), at.y(), at.x() + 30, at.y(), MouseButton::Middle);
        CHECK((slices.cross() - place).cwiseAbs().maxCoeff() <= 0.76);
        shell->click(at.x() + 30, at.y());
        CHECK((slices.cross() - place).cwiseAbs().maxCoeff() <= 0.76);
        shell->click(at.x(), at.y());
        CHECK(slices.cross().x() < place.x() - 2);
        THEN("Home shows all of it again") {
            shell->press_key(keys::kHome);
            click_in(*shell, SlicePlane::Axial, place);
            CHECK((slices.cross() - place).cwiseAbs().maxCoeff() <= 0.76);
        }
    }
}

SCENARIO("Window and level are dragged, typed and found", "[window][slices]") {
    const auto shell = test_shell();
    if (!shell) return;
    open_and_wait(*shell, image_file(ball_in(flipped_matrix(), kBright)));
    ImageSlices& slices = slices_of(*shell);
    const GreyWindow automatic = slices.grey();
    CHECK(automatic == slices.figures()->automatic);
    const Vec3 cross = slices.cross();
    const Eigen::Vector2f at = seen_in(*shell, SlicePlane::Axial, cross);
    shell->drag(at.x(), at.y(), at.x() + 40, at.y(), MouseButton::Right);
    CHECK(slices.grey().window > 1.1 * automatic.window);
    CHECK(slices.grey().level == Approx(automatic.level));
    shell->drag(at.x(), at.y(), at.x(), at.y() - 40, MouseButton::Right);
    CHECK(slices.grey().level < automatic.level);
    CHECK(slices.cross() == cross);
    REQUIRE(shell->fill_item("slices.window", "2000"));
    REQUIRE(shell->fill_item("slices.level", "-50"));
    CHECK(slices.grey() == GreyWindow{2000, -50});
    leave(*shell);
    const Eigen::Vector2f ground = seen_in(*shell, SlicePlane::Axial, cross + Vec3(-6, -6, 0));
    const int dark = brightness_at(shell->picture(), ground);
    REQUIRE(shell->fill_item("slices.window", "300"));
    leave(*shell);
    CHECK(brightness_at(shell->picture(), ground) > dark + 50);
    REQUIRE(shell->fill_item("slices.window", "-"));
    CHECK(slices.grey() == GreyWindow{300, -50});
    REQUIRE(shell->click_item("slices.auto"));
    CHECK(slices.grey() == automatic);
}

SCENARIO("The row and the planes are shown and hidden", "[window][slices]") {
    const auto shell = test_shell();
    if (!shell) return;
    open_and_wait(*shell, image_file(ball_in(flipped_matrix(), kBright)));
    CHECK(shell->has("slice.coronal.area"));
    const float low = shell->app().ui().items().at("view.area").rect.height;
    shell->press_key(keys::letter('I'));
    CHECK_FALSE(shell->has("slice.coronal.area"));
    CHECK(shell->app().ui().items().at("view.area").rect.height > low + 100);
    REQUIRE(shell->click_item("tool.slices"));
    CHECK(shell->has("slice.coronal.area"));
    REQUIRE(shell->settle(10s));
    const int drawings = shell->app().drawings();
    for (int i = 0; i < 3; ++i) shell->frame();
    CHECK(shell->app().drawings() == drawings);
    REQUIRE(shell->click_item("slice.axial.space"));
    CHECK_FALSE(slices_of(*shell).in_space(SlicePlane::Axial));
    CHECK(slices_of(*shell).in_space(SlicePlane::Coronal));
    CHECK(shell->app().drawings() > drawings);
    REQUIRE(shell->click_item("view.slices"));
    CHECK_FALSE(slices_of(*shell).any_in_space());
    CHECK(shell->click_item("view.extract"));
}

SCENARIO("A case without an image has no slices", "[window][slices]") {
    const auto shell = test_shell();
    if (!shell) return;
    open_and_wait(*shell, tube_file());
    CHECK_FALSE(shell->click_item("tool.slices"));
    shell->press_key(keys::letter('I'));
    CHECK_FALSE(shell->has("slice.axial.area"));
    CHECK_FALSE(shell->has("view.slices"));
}

SCENARIO("A seed is picked in a slice", "[window][slices][picking]") {
    const auto shell = test_shell();
    if (!shell) return;
    open_and_wait(*shell, image_file(ball_in(flipped_matrix(), kBright)));
    Workplace& place = shell->app().place();
    REQUIRE(shell->click_item("rail.source"));
    REQUIRE(shell->click_item("choose.extract-surface"));
    place.slices().show_row(false);
    REQUIRE(shell->settle(10s));  // what does not apply is hidden
    REQUIRE(shell->click_item("field.seed.pick"));
    CHECK(place.armed() == "seed");
    REQUIRE(shell->settle(10s));
    REQUIRE(place.slices().in_row());
    place.slices().set_cross(kBright);
    const Vec3 seed(kBright.x() + 2, place.slices().cross().y(), kBright.z() - 1);
    const Eigen::Vector2f at = seen_in(*shell, SlicePlane::Coronal, seed);
    WHEN("the view is moved meanwhile") {
        shell->drag(at.x(), at.y(), at.x() + 40, at.y(), MouseButton::Middle);
        CHECK(place.armed() == "seed");
        CHECK(place.form()->field("seed").text.empty());
    }
    WHEN("a place beside the image is clicked") {
        click_in(*shell, SlicePlane::Coronal, place.slices().grid().low - Vec3(0.4, 0, 0.4));
        CHECK(place.armed() == "seed");
    }
    WHEN("the slice is clicked") {
        click_in(*shell, SlicePlane::Coronal, seed);
        CHECK(place.armed().empty());
        const Vec3 picked = place.form()->arguments().point("seed");
        CHECK((picked - seed).norm() < 0.5);
        CHECK(picked.y() == Approx(seed.y()));
        CHECK(place.form()->field("seed").text == picked_text(PickTarget::Voxel, "", picked));
        CHECK(place.command().find("seed=" + place.form()->field("seed").text) !=
              std::string::npos);
    }
}

SCENARIO("Labels are picked in slices", "[window][slices][picking]") {
    const auto shell = test_shell();
    if (!shell) return;
    open_and_wait(*shell, image_file(two_labels()));
    Workplace& place = shell->app().place();
    CHECK(place.slices().shows_labels());
    CHECK_FALSE(shell->has("slices.window"));
    REQUIRE(shell->click_item("rail.source"));
    REQUIRE(shell->click_item("choose.extract-surface"));
    REQUIRE(shell->settle(10s));  // the labels are listed
    REQUIRE(shell->click_item("field.labels.pick"));
    const double z = place.slices().cross().z();
    const auto text = [&] { return place.form()->field("labels").text; };
    click_in(*shell, SlicePlane::Axial, {-5, 22, z});
    CHECK(text() == "2");
    click_in(*shell, SlicePlane::Axial, {5, 22, z});
    CHECK(text() == "1,2");
    click_in(*shell, SlicePlane::Axial, {15, 10, z});
    CHECK(text() == "1,2");
    click_in(*shell, SlicePlane::Axial, {-5, 20, z});
    CHECK(text() == "1");
    CHECK(place.armed() == "labels");
    shell->press_key(keys::kEscape);
    CHECK(place.armed().empty());
}

SCENARIO("The line over the slices has room in a small window", "[window][slices]") {
    const auto shell = test_shell();
    if (!shell) return;
    open_and_wait(*shell, image_file(ball_in(flipped_matrix(), kBright)));
    shell->resize(900, 600);
    const Eigen::Vector2f at = seen_in(*shell, SlicePlane::Axial, kBright);
    shell->move_mouse(at.x(), at.y());
    REQUIRE(shell->settle(10s));
    std::vector<ScreenRect> rects;
    for (const auto& [name, item] : shell->app().ui().items())
        if (name.starts_with("slices.")) rects.push_back(item.rect);
    REQUIRE(rects.size() >= 5);
    std::ranges::sort(rects, {}, &ScreenRect::x);
    for (std::size_t i = 1; i < rects.size(); ++i)
        CHECK(rects[i - 1].x + rects[i - 1].width <= rects[i].x);
}
