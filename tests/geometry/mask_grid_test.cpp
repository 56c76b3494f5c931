#include "geometry/image/mask_grid.h"

#include <algorithm>
#include <numeric>

#include <catch2/catch.hpp>

#include "geometry/image/threshold.h"
#include "geometry/kernel/errors.h"
#include "tests/support/image_shapes.h"

using namespace vesselbench;
using namespace vesselbench::test;
using Catch::Matchers::Contains;

namespace {

const Vec3 kSpacing(0.8, 0.8, 1.2);

/// Two half balls, of labels 1 and 2.
double two_halves(const Vec3& p) {
    const Vec3 from = p - Vec3(12.13, 12.07, 14.11);
    return from.norm() > 6.03 ? 0.0 : from.x() < 0.0 ? 1.0 : 2.0;
}

Eigen::Matrix4d upright(const Vec3& spacing, const Vec3& first) {
    Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
    matrix.diagonal().head<3>() = spacing;
    matrix.topRightCorner<3, 1>() = first;
    return matrix;
}

Image image() {
    return image_of({31, 31, 25}, upright(kSpacing, Vec3::Zero()), two_halves);
}

double volume_of(const Image& mask, int label) {
    return label_volumes(mask).at(label);
}

}  // namespace

SCENARIO("A mask on its image's lattice keeps its voxels", "[images][mask]") {
    const Image whole = image();
    GIVEN("the same grid") {
        const PlacedMask placed = mask_on_grid(whole, whole);
        CHECK(placed.grid == MaskGrid::Same);
        CHECK(placed.mask.voxels == whole.voxels);
    }
    GIVEN("a part of it, as 3D Slicer saves it") {
        const Vec3 first = Vec3(7, 7, 5).cwiseProduct(kSpacing);
        const Image part = image_of({16, 16, 13}, upright(kSpacing, first), two_halves);
        const PlacedMask placed = mask_on_grid(whole, part);
        CHECK(placed.grid == MaskGrid::Lattice);
        CHECK(placed.beyond == 0.0);
        CHECK(*placed.mask.voxels == *whole.voxels);
    }
    GIVEN("an axis in the other direction, and two exchanged") {
        Eigen::Matrix4d turned = Eigen::Matrix4d::Identity();
        turned.block<3, 1>(0, 0) = Vec3(0, 0, 1.2);
        turned.block<3, 1>(0, 1) = Vec3(0, 0.8, 0);
        turned.block<3, 1>(0, 2) = Vec3(-0.8, 0, 0);
        turned.topRightCorner<3, 1>() = Vec3(30 * 0.8, 0, 0);
        const PlacedMask placed = mask_on_grid(whole, image_of({25, 31, 31}, turned, two_halves));
        CHECK(placed.grid == MaskGrid::Lattice);
        CHECK(*placed.mask.voxels == *whole.voxels);
    }
    GIVEN("a mask that reaches beyond the image") {
        const Image half = image_of({16, 31, 25}, upright(kSpacing, Vec3::Zero()), two_halves);
        const PlacedMask placed = mask_on_grid(half, whole);
        CHECK(placed.beyond > 0.3);
        CHECK(placed.beyond < 0.6);
        CHECK(volume_of(placed.mask, 1) == volume_of(whole, 1));
    }
}

SCENARIO("A mask on another lattice is resampled by shape", "[images][mask]") {
    const Image whole = image();
    const double exact = 0.5 * 4.0 / 3.0 * 3.14159265 * 219.3;
    GIVEN("coarser voxels, in another place") {
        const Image coarse =
            image_of({18, 18, 14}, upright({1.5, 1.5, 2.1}, {-0.4, -0.3, 0.2}), two_halves);
        const PlacedMask placed = mask_on_grid(whole, coarse);
        THEN("each label keeps its volume and its side") {
            CHECK(placed.grid == MaskGrid::Resampled);
            for (const int label : {1, 2})
                CHECK(volume_of(placed.mask, label) == Approx(exact).epsilon(0.06));
            CHECK(labels_of(placed.mask) == std::vector<int>{1, 2});
        }
        THEN("few voxels differ from the shape itself") {
            std::size_t different = 0;
            for (std::size_t v = 0; v < whole.voxel_count(); ++v)
                if ((*placed.mask.voxels)[v] != (*whole.voxels)[v]) ++different;
            const auto inside = std::ranges::count_if(*whole.voxels, [](float x) { return x > 0; });
            CHECK(static_cast<double>(different) < 0.15 * static_cast<double>(inside));
        }
    }
    GIVEN("an oblique grid") {
        const Image oblique =
            image_of({70, 70, 70}, oblique_matrix({0.6, 0.6, 0.6}, {-5, -14, -5}), two_halves);
        const PlacedMask placed = mask_on_grid(whole, oblique);
        CHECK(placed.grid == MaskGrid::Resampled);
        CHECK(volume_of(placed.mask, 1) + volume_of(placed.mask, 2) ==
              Approx(label_volumes(oblique).at(1) + label_volumes(oblique).at(2)).epsilon(0.03));
    }
}

SCENARIO("A mask beside its image is refused with the way through 3D Slicer",
         "[images][mask][bad-input]") {
    const Image elsewhere = image_of({31, 31, 25}, upright(kSpacing, {0, 0, 0}), two_halves);
    Image image = elsewhere;
    image.index_to_patient = upright(kSpacing, {200, 0, 0});
    CHECK_THROWS_WITH(mask_on_grid(image, elsewhere),
                      Contains("beside the image") && Contains("3D Slicer"));
}
