#include <chrono>
#include <thread>

#include <catch2/catch.hpp>

#include "tests/support/image_shapes.h"
#include "tests/support/shapes.h"
#include "workbench/window/features/slices/image_slices.h"

using namespace vesselbench;
using namespace vesselbench::test;
using namespace std::chrono_literals;

namespace {

/// Voxel edges along the patient's axes, of which two run backwards.
Eigen::Matrix4d flipped_matrix() {
    Eigen::Matrix4d matrix = Eigen::Vector4d(-0.5, -0.75, 2.0, 1.0).asDiagonal();
    matrix.topRightCorner<3, 1>() = Vec3(10, 30, -40);
    return matrix;
}

/// Linear in space, with fractions: no labels.
Image ramp(const Eigen::Matrix4d& matrix) {
    return image_of({24, 20, 16}, matrix,
                    [](const Vec3& p) { return 0.31 * p.x() - 0.17 * p.y() + 0.53 * p.z(); });
}

void make_all(ImageSlices& slices, const Scene& scene) {
    const auto end = std::chrono::steady_clock::now() + 10s;
    slices.update(&scene);
    while (slices.pending() && std::chrono::steady_clock::now() < end) {
        std::this_thread::sleep_for(1ms);
        slices.update(&scene);
    }
    REQUIRE_FALSE(slices.pending());
}

}  // namespace

SCENARIO("Slices are made when they are shown, and made again when they move", "[window][slices]") {
    ImageSlices slices(nullptr);
    Scene scene{.surface = icosphere(3.0, 3, Vec3(5, 20, -25)), .image = ramp(flipped_matrix())};
    make_all(slices, scene);
    CHECK(slices.has_image());
    CHECK_FALSE(slices.in_row());
    CHECK_FALSE(slices.content(SlicePlane::Axial));
    slices.show_row(true);
    CHECK(slices.pending());
    make_all(slices, scene);
    const auto axial = slices.content(SlicePlane::Axial);
    const auto coronal = slices.content(SlicePlane::Coronal);
    REQUIRE(axial);
    REQUIRE(coronal);
    CHECK(axial->outline.size() == 1);
    CHECK(slices.grey() == slices.figures()->automatic);
    WHEN("a plane moves") {
        slices.step(SlicePlane::Axial, 1);
        CHECK(slices.position(SlicePlane::Axial) == Approx(axial->position + 2));
        make_all(slices, scene);
        CHECK(slices.content(SlicePlane::Axial)->position == Approx(axial->position + 2));
        CHECK(slices.content(SlicePlane::Coronal) == coronal);
    }
    WHEN("nothing has changed") {
        make_all(slices, scene);
        CHECK(slices.content(SlicePlane::Axial) == axial);
    }
    WHEN("the surface changes") {
        const Vec3 cross = slices.cross();
        scene.surface.reset();
        make_all(slices, scene);
        CHECK(slices.content(SlicePlane::Axial)->outline.empty());
        CHECK(slices.cross() == cross);
    }
    WHEN("the user sets the window, and the image changes") {
        slices.set_grey({3, 4});
        scene.image = ramp(oblique_matrix({0.5, 0.75, 2.0}, {3, -60, 12}));
        make_all(slices, scene);
        CHECK(slices.grey() == GreyWindow{3, 4});
        slices.reset_grey();
        CHECK(slices.grey() == slices.figures()->automatic);
    }
    WHEN("the window is no window") {
        slices.set_grey({0, 4});
        CHECK(slices.grey() == slices.figures()->automatic);
    }
}

SCENARIO("An image without a surface is shown at once", "[window][slices]") {
    ImageSlices slices(nullptr);
    const Scene scene{.image = ramp(flipped_matrix())};
    make_all(slices, scene);
    CHECK(slices.in_row());
    CHECK(slices.any_in_space());
    slices.show_row(false);
    make_all(slices, scene);
    CHECK_FALSE(slices.in_row());
    slices.clear();
    CHECK_FALSE(slices.has_image());
    CHECK_FALSE(slices.pending());
}

SCENARIO("A label is read from the mask, else from an image of labels", "[window][slices]") {
    ImageSlices slices(nullptr);
    const auto two = [](const Vec3& p) { return p.z() < -25 ? 2.0 : 0.0; };
    const Vec3 inside(5, 22, -35), outside(5, 22, -15);
    Scene scene{.image = ramp(flipped_matrix())};
    make_all(slices, scene);
    CHECK_FALSE(slices.label_at(inside));
    WHEN("there is a mask") {
        scene.mask = image_of({24, 20, 16}, flipped_matrix(), two);
        make_all(slices, scene);
        CHECK(slices.label_at(inside) == 2);
        CHECK_FALSE(slices.label_at(outside));
        CHECK(slices.content(SlicePlane::Axial)->mask);
    }
    WHEN("the image is a label map") {
        scene.image = image_of({24, 20, 16}, flipped_matrix(), two);
        make_all(slices, scene);
        CHECK(slices.shows_labels());
        CHECK(slices.label_at(inside) == 2);
        CHECK_FALSE(slices.label_at(outside));
    }
}
