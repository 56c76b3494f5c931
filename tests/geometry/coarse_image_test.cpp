#include "geometry/image/coarse_image.h"

#include <numeric>

#include <catch2/catch.hpp>

#include "geometry/image/extract_surface.h"
#include "geometry/kernel/measure.h"
#include "tests/support/image_shapes.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

double mean_of(const Image& image) {
    return std::accumulate(image.voxels->begin(), image.voxels->end(), 0.0) /
           static_cast<double>(image.voxel_count());
}

}  // namespace

SCENARIO("A coarse image shows the same ball in the same place", "[images][coarse]") {
    const bool mirrored = GENERATE(false, true);
    const Image image = ball_image(10.0, 48, Vec3(0.6, 0.6, 0.6), mirrored);
    const VoxelSteps steps = coarse_steps(image, image.voxel_count() / 8);
    REQUIRE(steps == VoxelSteps{2, 2, 2});
    const Image coarse = coarse_image(image, steps);
    CHECK(coarse.size == std::array<int, 3>{24, 24, 24});
    CHECK(mean_of(coarse) == Approx(mean_of(image)));
    const Surface fine = extract_surface(image, {}, {.threshold = 50.0}).surface;
    const Surface rough = extract_surface(coarse, {}, {.threshold = 50.0}).surface;
    CHECK(volume(rough) == Approx(volume(fine)).epsilon(0.03));
    CHECK((bounds(rough).centre() - bounds(fine).centre()).norm() < 0.05);
}

SCENARIO("Coarse voxels become as near to cubes as can be", "[images][coarse]") {
    Image image = ball_image(5.0, 40, Vec3(0.5, 0.5, 2.0));
    CHECK(coarse_steps(image, image.voxel_count()) == VoxelSteps{1, 1, 1});
    CHECK(coarse_steps(image, image.voxel_count() / 4) == VoxelSteps{2, 2, 1});
    CHECK(coarse_steps(image, image.voxel_count() / 16) == VoxelSteps{4, 4, 1});
    THEN("two voxels stay along each axis, also of an image with an odd number") {
        image.size = {3, 40, 2};
        CHECK(coarse_steps(image, 1) == VoxelSteps{2, 39, 1});
    }
}

SCENARIO("A coarse mask keeps thin parts", "[images][coarse]") {
    const Image mask = image_of({9, 8, 8}, Eigen::Matrix4d::Identity(), [](const Vec3& p) {
        return p.x() == 8.0 && p.y() == 3.0 ? 1.0 : 0.0;
    });
    const Image coarse = coarse_mask(mask, {2, 2, 2});
    REQUIRE(coarse.size == std::array<int, 3>{5, 4, 4});
    for (int k = 0; k < 4; ++k) CHECK(coarse.at(4, 1, k) == 1.0F);
    CHECK(std::accumulate(coarse.voxels->begin(), coarse.voxels->end(), 0.0) == 4.0);
}
