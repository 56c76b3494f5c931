#include <cmath>
#include <random>

#include <catch2/catch.hpp>

#include "geometry/image/clean_image.h"
#include "geometry/image/crop_image.h"
#include "geometry/image/extract_surface.h"
#include "geometry/image/resample.h"
#include "geometry/image/voxel_topology.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/measure.h"
#include "tests/support/image_shapes.h"
#include "tests/support/shapes.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

Image box_mask(const std::array<int, 3>& size,
               const std::function<bool(int i, int j, int k)>& inside) {
    return image_of(size, Eigen::Matrix4d::Identity(), [&](const Vec3& p) {
        return inside(static_cast<int>(p.x()), static_cast<int>(p.y()), static_cast<int>(p.z()));
    });
}

double count_inside(const Image& mask) {
    double count = 0.0;
    for (const float v : *mask.voxels) count += v >= 0.5f ? 1.0 : 0.0;
    return count;
}

Image noisy(const Image& image, double amount) {
    std::mt19937 generator(7);
    std::vector<float> voxels;
    for (const float v : *image.voxels)  // a sum of uniform numbers, the same on every platform
        voxels.push_back(
            v +
            static_cast<float>(
                amount *
                ((generator() % 1000 + generator() % 1000 + generator() % 1000) / 1500.0 - 1.0)));
    Image result = image;
    result.voxels = std::make_shared<const std::vector<float>>(voxels);
    return result;
}

}  // namespace

SCENARIO("Topology of voxel sets is counted", "[images][topology]") {
    const auto facts = [](const Image& mask) {
        const VoxelTopology t = voxel_topology(mask, 0.5);
        return std::array<std::int64_t, 4>{t.components, t.tunnels(), t.cavities, t.euler};
    };
    using Facts = std::array<std::int64_t, 4>;
    const auto block = [](int i, int j, int k) {
        return i > 0 && i < 6 && j > 0 && j < 6 && k > 0 && k < 6;
    };
    CHECK(facts(box_mask({7, 7, 7}, block)) == Facts{1, 0, 0, 1});
    CHECK(facts(box_mask({7, 7, 7}, [&](int i, int j, int k) {
              return block(i, j, k) && !(i == 3 && j == 3);
          })) == Facts{1, 1, 0, 0});
    CHECK(facts(box_mask({7, 7, 7}, [&](int i, int j, int k) {
              return block(i, j, k) && !(i == 3 && j == 3 && k == 3);
          })) == Facts{1, 0, 1, 2});
    CHECK(facts(box_mask({5, 2, 2}, [](int i, int, int) { return i != 2; })) == Facts{2, 0, 0, 2});
    // Two boxes that share a corner are connected in the 26-neighbourhood only.
    const Image corner = box_mask({2, 2, 2}, [](int i, int j, int k) {
        return (i == 0 && j == 0 && k == 0) || (i == 1 && j == 1 && k == 1);
    });
    CHECK(facts(corner) == Facts{1, 0, 0, 1});
    CHECK(voxel_components(corner, 0.5, Neighbourhood::Faces).sizes.size() == 2);
}

SCENARIO("Opening and closing work on masks and intensities", "[images][cleaning]") {
    const Image mask = box_mask({20, 20, 20}, [](int i, int j, int k) {
        const bool block = i > 4 && i < 15 && j > 4 && j < 15 && k > 4 && k < 15;
        const bool hair = j == 10 && k == 10;
        const bool gap = i == 9 && j == 9 && k == 9;
        return (block && !gap) || hair;
    });
    CHECK(count_inside(opened(mask, 1)) == 1000.0 - 1.0);
    CHECK(count_inside(closed(mask, 1)) == count_inside(mask) + 1.0);
    CHECK(count_inside(dilated(opened(closed(mask, 1), 1), 1)) == 12 * 12 * 12);
    CHECK_THROWS_AS(dilated(mask, -1), InvalidInput);
}

SCENARIO("Gaussian and diffusion remove noise; diffusion keeps the edge", "[images][cleaning]") {
    const Image clean = ball_image(8.0, 30, Vec3(0.8, 0.8, 1.2));
    const Image spoiled = noisy(clean, 15.0);
    const Vec3 middle = middle_of(clean);
    const auto deviation = [&](const Image& image, double from, double to) {
        double sum = 0.0, count = 0.0;
        for (int k = 0; k < clean.size[2]; ++k)
            for (int j = 0; j < clean.size[1]; ++j)
                for (int i = 0; i < clean.size[0]; ++i) {
                    const double r = (clean.to_patient(Vec3(i, j, k)) - middle).norm();
                    if (r < from || r > to) continue;
                    const double d = image.at(i, j, k) - clean.at(i, j, k);
                    sum += d * d;
                    ++count;
                }
        return std::sqrt(sum / count);
    };
    THEN("diffusion halves the noise and keeps the edge") {
        const Image smooth = diffuse(spoiled, {.iterations = 10, .contrast = 14.0});
        CHECK(deviation(smooth, 0.0, 6.0) < 0.5 * deviation(spoiled, 0.0, 6.0));
        CHECK(deviation(smooth, 7.0, 9.0) < deviation(gaussian(spoiled, 1.0), 7.0, 9.0));
    }
    THEN("a Gaussian keeps a constant and the sum") {
        const Image flat =
            image_of({9, 9, 9}, Eigen::Matrix4d::Identity(), [](const Vec3&) { return 5.0; });
        const Image smooth = gaussian(flat, 1.5);
        for (const float v : *smooth.voxels) CHECK(v == Approx(5.0));
    }
    THEN("a Gaussian of a step has the width asked for, whatever the spacing") {
        const Image step = image_of({4, 4, 81}, Vec3(1, 1, 0.25).homogeneous().asDiagonal(),
                                    [](const Vec3& p) { return p.z() < 10.0 ? 0.0 : 1.0; });
        const Image smooth = gaussian(step, 2.0);
        // One standard deviation beyond the middle of the step: 84 %.
        CHECK(smooth.at(1, 1, 48) == Approx(0.8413).margin(0.02));
    }
    THEN("what is given nothing to do does nothing") {
        CHECK(*gaussian(clean, 0.0).voxels == *clean.voxels);
        CHECK(*gaussian(clean, 1e-308).voxels == *clean.voxels);
        CHECK(*diffuse(clean, {.iterations = 0}).voxels == *clean.voxels);
    }
}

SCENARIO("A change of topology by cleaning is reported", "[images][cleaning]") {
    const Image mask = box_mask({24, 12, 12}, [](int i, int j, int k) {
        const auto in = [](int v) { return v > 3 && v < 8; };
        return (in(j) && in(k) && ((i > 2 && i < 9) || (i > 14 && i < 22))) ||
               (j == 5 && k == 5 && i > 2 && i < 22);
    });
    ExtractionParameters parameters;
    parameters.cleaning.opening = 1;
    const Extraction cut = extract_surface(mask, {}, parameters);
    REQUIRE(cut.before);
    CHECK(cut.before->components == 1);
    CHECK(cut.after->components == 2);
}

SCENARIO("Resampling to cubic voxels keeps the place and the shape", "[images][resampling]") {
    GIVEN("smooth intensities") {
        const auto matrix = oblique_matrix(Vec3(1.0, 0.8, 1.6), Vec3(9, 8, 7), true);
        const auto wave = [](const Vec3& p) {
            return std::sin(0.3 * p.x()) + std::cos(0.25 * p.y()) + 0.1 * p.z();
        };
        const Image image = image_of({24, 26, 18}, matrix, wave);
        const Image fine = resample_intensities(image, 0.4);
        THEN("voxels are cubic and lie on the field") {
            CHECK((fine.spacing() - Vec3::Constant(0.4)).norm() < 1e-12);
            double worst = 0.0;
            for (int k = 12; k < fine.size[2] - 12; k += 3)
                for (int j = 6; j < fine.size[1] - 6; j += 3)
                    for (int i = 6; i < fine.size[0] - 6; i += 3)
                        worst = std::max(worst, std::abs(fine.at(i, j, k) -
                                                         wave(fine.to_patient(Vec3(i, j, k)))));
            CHECK(worst < 0.004);
        }
        THEN("the grid's first and last voxels stay") {
            CHECK((fine.to_patient(Vec3::Zero()) - image.to_patient(Vec3::Zero())).norm() == 0.0);
            CHECK(fine.size[1] == 51);
            CHECK((fine.to_patient(Vec3(0, 50, 0)) - image.to_patient(Vec3(0, 25, 0))).norm() <
                  1e-9);
        }
    }
    GIVEN("a cone in thick slices") {
        const Image mask = image_of({41, 41, 9}, Vec3(0.5, 0.5, 4.0).homogeneous().asDiagonal(),
                                    [](const Vec3& p) {
                                        const double r = std::hypot(p.x() - 10.0, p.y() - 10.0);
                                        return r < 2.0 + 0.2 * p.z() ? 1.0 : 0.0;
                                    });
        const Image fine = resample_mask(mask, 0.5);
        THEN("slices between follow the cone, not the nearest slice") {
            for (const int k : {4, 20, 36, 52}) {
                double inside = 0.0;
                for (int j = 0; j < 41; ++j)
                    for (int i = 0; i < 41; ++i) inside += fine.at(i, j, k);
                const double radius = std::sqrt(inside * 0.25 / 3.14159265);
                CHECK(radius == Approx(2.0 + 0.2 * 0.5 * k).margin(0.2));
            }
        }
        THEN("the result is a mask") {
            for (const float v : *fine.voxels) REQUIRE((v == 0.0f || v == 1.0f));
        }
    }
    GIVEN("a mask that ends between slices") {
        const Image mask =
            image_of({12, 12, 6}, Vec3(1, 1, 3).homogeneous().asDiagonal(), [](const Vec3& p) {
                return p.z() < 7.0 && p.x() > 2 && p.x() < 9 && p.y() > 2 && p.y() < 9;
            });
        const Image fine = resample_mask(mask, 1.0);
        THEN("it ends midway") {
            CHECK(fine.at(6, 6, 7) == 1.0f);
            CHECK(fine.at(6, 6, 8) == 0.0f);
        }
    }
    THEN("absurd resolutions are refused") {
        const Image ball = ball_image(5.0, 20, Vec3(1, 1, 1));
        CHECK_THROWS_AS(resample_intensities(ball, 0.0), InvalidInput);
        CHECK_THROWS_AS(resample_intensities(ball, 1e-3), InvalidInput);
        CHECK_THROWS_AS(resample_intensities(ball, 1e308), InvalidInput);
        CHECK_THROWS_AS(resample_mask(ball, 1e308), InvalidInput);
    }
}

SCENARIO("A region of an image keeps the grid", "[images][crop]") {
    const Image image = ball_image(8.0, 30, Vec3(0.8, 0.8, 1.2), true);
    GIVEN("a box around the middle") {
        const Vec3 middle = middle_of(image);
        const Image part = crop_to_box(image, middle - Vec3(2, 2, 2), middle + Vec3(2, 2, 2));
        THEN("voxels keep their places and values") {
            CHECK(part.voxel_count() < image.voxel_count() / 8);
            const Vec3 index = image.to_index(part.to_patient(Vec3(1, 2, 3)));
            const Vec3 rounded = index.array().round();
            CHECK((index - rounded).norm() < 1e-9);
            CHECK(part.at(1, 2, 3) == image.at(static_cast<int>(rounded.x()),
                                               static_cast<int>(rounded.y()),
                                               static_cast<int>(rounded.z())));
        }
        THEN("the box lies inside it") {
            for (int c = 0; c < 8; ++c) {
                const Vec3 corner = middle + Vec3(c & 1 ? 2 : -2, c & 2 ? 2 : -2, c & 4 ? 2 : -2);
                const Vec3 index = part.to_index(corner);
                CHECK(index.minCoeff() > -1e-9);
                for (int a = 0; a < 3; ++a) CHECK(index[a] < part.size[a] - 1 + 1e-9);
            }
        }
    }
    GIVEN("a ball") {
        const Image part = crop_to_sphere(image, middle_of(image), 3.0);
        THEN("its bounding box on the grid is kept") {
            CHECK(part.size == std::array<int, 3>{10, 10, 6});
        }
    }
    THEN("a region outside is refused") {
        CHECK_THROWS_AS(crop_to_sphere(image, Vec3(1e4, 0, 0), 5.0), InvalidInput);
        CHECK_THROWS_AS(crop_to_box(image, Vec3(0, 0, 0), Vec3(1, -1, 1)), InvalidInput);
    }
}
