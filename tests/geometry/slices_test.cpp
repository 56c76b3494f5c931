#include "geometry/image/slices.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <catch2/catch.hpp>

#include "tests/support/image_shapes.h"
#include "tests/support/shapes.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

/// Voxel edges along the patient's axes, of which two run backwards.
Eigen::Matrix4d flipped_matrix() {
    Eigen::Matrix4d matrix = Eigen::Vector4d(-0.5, -0.75, 2.0, 1.0).asDiagonal();
    matrix.topRightCorner<3, 1>() = Vec3(10, 30, -40);
    return matrix;
}

/// 0 but for 100 in one voxel.
Image bright_voxel(const Eigen::Matrix4d& matrix, const std::array<int, 3>& voxel) {
    Image image = image_of({24, 20, 16}, matrix, [](const Vec3&) { return 0.0; });
    std::vector<float> voxels = *image.voxels;
    voxels[image.offset(voxel[0], voxel[1], voxel[2])] = 100.0F;
    image.voxels = std::make_shared<const std::vector<float>>(std::move(voxels));
    return image;
}

/// Linear in space, with fractions: no labels.
Image ramp(const Eigen::Matrix4d& matrix) {
    return image_of({24, 20, 16}, matrix,
                    [](const Vec3& p) { return 0.31 * p.x() - 0.17 * p.y() + 0.53 * p.z(); });
}

Vec3 pixel_place(const ImageSlice& slice, std::size_t pixel) {
    const auto columns = static_cast<std::size_t>(slice.columns);
    const double column = static_cast<double>(pixel % columns) + 0.5;
    const double row = static_cast<double>(pixel / columns) + 0.5;
    return slice.corner + column / slice.columns * slice.across + row / slice.rows * slice.down;
}

std::size_t brightest(const ImageSlice& slice) {
    std::size_t best = 0;
    float most = -1.0F;
    for (std::size_t i = 0; i < slice.values.size(); ++i)
        if (slice.values[i] > most) {
            most = slice.values[i];
            best = i;
        }
    return best;
}

}  // namespace

SCENARIO("Slices lie on the screen as radiologists expect", "[geometry][slices]") {
    using enum SlicePlane;
    CHECK(patient_letter(right_of(Axial)) == 'L');
    CHECK(patient_letter(up_of(Axial)) == 'A');
    CHECK(patient_letter(right_of(Coronal)) == 'L');
    CHECK(patient_letter(up_of(Coronal)) == 'S');
    CHECK(patient_letter(right_of(Sagittal)) == 'P');
    CHECK(patient_letter(up_of(Sagittal)) == 'S');
    CHECK(position_text(2, 12.46) == "S 12.5 mm");
    CHECK(position_text(0, -3.0) == "R 3.0 mm");
    CHECK(position_text(1, -0.01) == "P 0.0 mm");
}

SCENARIO("A bright voxel is seen where it lies in the patient", "[geometry][slices]") {
    const auto matrix = GENERATE(flipped_matrix(), oblique_matrix({0.5, 0.75, 2.0}, {3, -60, 12}),
                                 oblique_matrix({0.5, 0.75, 2.0}, {3, -60, 12}, true));
    const Image image = bright_voxel(matrix, {17, 4, 11});
    const Vec3 place = image.to_patient({17, 4, 11});
    const SliceGrid grid = slice_grid(image);
    for (const SlicePlane plane : kSlicePlanes) {
        const SliceAxes& axes = axes_of(plane);
        const ImageSlice slice = slice_of(image, grid, plane, place[axes.normal], Between::Linear);
        REQUIRE(slice.values.size() ==
                static_cast<std::size_t>(slice.columns) * static_cast<std::size_t>(slice.rows));
        const Vec3 seen = pixel_place(slice, brightest(slice));
        CHECK(seen[axes.normal] == Approx(place[axes.normal]));
        CHECK((seen - place).norm() <= 0.75 * grid.step.norm());
        CHECK(slice.across.normalized().dot(right_of(plane)) == Approx(1));
        CHECK(slice.down.normalized().dot(up_of(plane)) == Approx(-1));
    }
}

SCENARIO("Slices along the voxels show their values exactly", "[geometry][slices]") {
    const Image image = ramp(flipped_matrix());
    const SliceGrid grid = slice_grid(image);
    CHECK(grid.step.isApprox(Vec3(0.5, 0.75, 2.0)));
    CHECK(grid.count == image.size);
    const double position = grid.snapped(2, -25.3);
    CHECK(std::abs(position + 25.3) <= 1.0);
    const ImageSlice slice = slice_of(image, grid, SlicePlane::Axial, position, Between::Linear);
    for (const std::size_t pixel : {std::size_t{0}, std::size_t{100}, slice.values.size() - 1})
        CHECK(slice.values[pixel] == Approx(*voxel_at(image, pixel_place(slice, pixel))));
    CHECK(grid.snapped(2, -1000) == Approx(grid.low.z() + 1.0));
    CHECK(grid.snapped(2, 1000) == Approx(grid.high().z() - 1.0));
}

SCENARIO("An oblique slice has values inside the image alone", "[geometry][slices]") {
    const Image image = ramp(oblique_matrix({0.5, 0.75, 2.0}, {3, -60, 12}));
    const SliceGrid grid = slice_grid(image);
    CHECK(grid.step.isApprox(Vec3::Constant(0.5)));
    const Vec3 middle = middle_of(image);
    const ImageSlice slice =
        slice_of(image, grid, SlicePlane::Coronal, middle.y(), Between::Linear);
    std::size_t outside = 0;
    for (std::size_t i = 0; i < slice.values.size(); ++i) {
        const Vec3 place = pixel_place(slice, i);
        CHECK(std::isnan(slice.values[i]) == !voxel_at(image, place).has_value());
        if (std::isnan(slice.values[i])) ++outside;
        const Vec3 index = image.to_index(place);
        const bool deep =
            (index.array() >= 0).all() && index.x() <= 23 && index.y() <= 19 && index.z() <= 15;
        if (deep)
            CHECK(slice.values[i] ==
                  Approx(0.31 * place.x() - 0.17 * place.y() + 0.53 * place.z()).margin(1e-3));
    }
    CHECK(outside > 0);
    CHECK(outside < slice.values.size());
}

SCENARIO("The automatic window leaves out rare values", "[geometry][slices]") {
    Image image = ramp(flipped_matrix());
    const ImageFigures plain = figures_of(image);
    CHECK(plain.kind == ImageKind::Intensity);
    std::vector<float> voxels = *image.voxels;
    voxels[77] = 1e5F;
    voxels[78] = std::numeric_limits<float>::quiet_NaN();
    image.voxels = std::make_shared<const std::vector<float>>(voxels);
    const ImageFigures figures = figures_of(image);
    CHECK(figures.most == Approx(1e5));
    CHECK(figures.automatic.window == Approx(plain.automatic.window).epsilon(0.02));
    CHECK(figures.automatic.level == Approx(plain.automatic.level).epsilon(0.05));
    CHECK(plain.automatic.window < plain.most - plain.least);
    CHECK(plain.automatic.window > 0.8 * (plain.most - plain.least));
}

SCENARIO("An image of labels is shown from 0 to its largest label", "[geometry][slices]") {
    const Image labels = image_of({24, 20, 16}, flipped_matrix(), [](const Vec3& p) {
        return p.z() < -30 ? 3 : p.x() > 4 ? 7 : 0;
    });
    const ImageFigures figures = figures_of(labels);
    CHECK(figures.kind == ImageKind::Labels);
    CHECK(figures.automatic == GreyWindow{7, 3.5});
}

SCENARIO("A surface's outline lies on it and in the plane", "[geometry][slices]") {
    const Vec3 centre(3, -5, 8);
    const Surface ball = icosphere(6.0, 4, centre);
    const auto lines = outline_of(ball, SlicePlane::Sagittal, 5.0);
    REQUIRE(lines.size() == 1);
    CHECK(lines[0].closed);
    for (const Vec3& point : lines[0].points) {
        CHECK(point.x() == Approx(5));
        CHECK((point - centre).norm() == Approx(6).epsilon(0.01));
    }
    CHECK(outline_of(ball, SlicePlane::Axial, 40.0).empty());
}

SCENARIO("The border of an oblique image's plane is its corners' polygon", "[geometry][slices]") {
    const Image image = ramp(oblique_matrix({0.5, 0.75, 2.0}, {3, -60, 12}));
    const auto border = border_of(image, SlicePlane::Axial, middle_of(image).z());
    REQUIRE(border.size() == 1);
    CHECK(border[0].closed);
    for (const Vec3& point : border[0].points) {
        const Eigen::Array3d index = image.to_index(point).array();
        CHECK((index >= -0.5 - 1e-6).all());
        CHECK((index <= Eigen::Array3d(23.5, 19.5, 15.5) + 1e-6).all());
    }
}
