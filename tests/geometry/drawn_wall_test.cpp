#include "geometry/image/drawn_wall.h"

#include <cmath>

#include <catch2/catch.hpp>

#include "geometry/image/extract_surface.h"
#include "geometry/image/separating_field.h"
#include "geometry/image/voxel_topology.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/simple_point.h"
#include "tests/support/image_shapes.h"
#include "tests/support/surface_facts.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

constexpr double kRadius = 5.0, kVoxel = 0.8;

/// A ball's image: 200 inside, 50 outside, over a blur of a voxel.
Image ball(double radius = kRadius, double bright = 200.0, double dark = 50.0) {
    Image grid = ball_image(radius, 26, Vec3(kVoxel, kVoxel, kVoxel));
    const Vec3 middle = middle_of(grid);
    return image_of(grid.size, grid.index_to_patient, [&](const Vec3& p) {
        const double away = (p - middle).norm() - radius;
        return dark + (bright - dark) * 0.5 * std::erfc(away / (0.6 * kVoxel * std::sqrt(2.0)));
    });
}

/// What an expert drew: a ball that is too large or too small by so much [mm].
Image drawn(double off, double radius = kRadius) {
    const Image grid = ball();
    const Vec3 middle = middle_of(grid);
    return image_of(grid.size, grid.index_to_patient,
                    [&](const Vec3& p) { return (p - middle).norm() < radius + off ? 1.0 : 0.0; });
}

/// Mean distance of the wall from the ball's surface [mm], outward positive.
double bias_of(const Surface& surface, const Vec3& middle) {
    double sum = 0.0;
    for (const Vec3& p : surface.points()) sum += (p - middle).norm() - kRadius;
    return sum / static_cast<double>(surface.vertex_count());
}

Extraction wall_of(const Image& image, const Image& mask) {
    return extract_surface(image, mask, {.method = ExtractionMethod::Wall});
}

}  // namespace

SCENARIO("A drawn wall is moved to the edge that the image has there", "[images][wall]") {
    for (const double off : {-0.5 * kVoxel, 0.0, 0.5 * kVoxel})
        for (const double bright : {200.0, -100.0}) {  // a vessel may be darker
            INFO(off << " mm, " << bright);
            const Image image = ball(kRadius, bright);
            const Extraction wall = wall_of(image, drawn(off));
            CHECK(wall.method == ExtractionMethod::Wall);
            CHECK(is_closed_manifold(wall.surface));
            CHECK(std::abs(bias_of(wall.surface, middle_of(image))) < 0.12 * kVoxel);
            REQUIRE(wall.from_mask);
            CHECK(wall.from_mask->seen > 0.85);
            CHECK(wall.from_mask->mean == Approx(std::abs(off)).margin(0.25 * kVoxel));
        }
}

SCENARIO("A drawn wall stays where the image shows no edge, and moves by a voxel at most",
         "[images][wall]") {
    GIVEN("an image whose edge is three voxels away") {
        const Extraction wall = wall_of(ball(kRadius), drawn(-3.0 * kVoxel));
        THEN("nobody drew that") {
            CHECK(wall.from_mask->largest < 1.1 * kVoxel);
        }
    }
    GIVEN("noise only") {
        const Image grid = ball();
        unsigned state = 1;
        const Image noise = image_of(grid.size, grid.index_to_patient, [&](const Vec3&) {
            state = state * 1664525U + 1013904223U;
            return static_cast<double>(state >> 16U & 255U);
        });
        const Extraction wall = wall_of(noise, drawn(0.0));
        THEN("the wall is the mask's") {
            CHECK(wall.from_mask->mean < 0.15 * kVoxel);
            CHECK(std::abs(bias_of(wall.surface, middle_of(grid))) < 0.15 * kVoxel);
        }
    }
}

SCENARIO("The image does not change a drawn wall's topology", "[images][wall]") {
    const Image grid = ball();
    const Vec3 middle = middle_of(grid);
    GIVEN("two drawn vessels a voxel apart, which the image shows as one") {
        const auto halves = [&](double gap) {
            return image_of(grid.size, grid.index_to_patient, [&](const Vec3& p) {
                const Vec3 from = p - middle;
                return from.norm() < kRadius && std::abs(from.x()) > gap ? 1.0 : 0.0;
            });
        };
        const Image mask = halves(0.8 * kVoxel);
        REQUIRE(voxel_topology(mask, 0.5).components == 2);
        const DrawnWall wall = drawn_wall(ball(), mask, separating_field(mask));
        THEN("they stay two") {
            CHECK(voxel_topology(wall.field, 0.0).components == 2);
        }
    }
}

SCENARIO("A drawn mask that cleaning empties is no vessel", "[images][wall][bad-input]") {
    const Image grid = ball();
    const Vec3 middle = middle_of(grid);
    const Image sheet = image_of(grid.size, grid.index_to_patient, [&](const Vec3& p) {
        return std::abs(p.x() - middle.x()) < 0.6 * kVoxel ? 1.0 : 0.0;
    });
    CHECK_THROWS_AS(extract_surface(grid, sheet,
                                    {.method = ExtractionMethod::Wall, .cleaning = {.opening = 2}}),
                    AlgorithmFailure);
}

SCENARIO("A simple voxel may change its side", "[images][topology]") {
    const NeighbourBits none = 0, all = (NeighbourBits{1} << 27) - 1;
    const NeighbourBits half = (NeighbourBits{1} << 18) - 1;  // a wall between k and k + 1
    const auto bit = [](int cell) { return NeighbourBits{1} << cell; };
    CHECK_FALSE(is_simple_both_ways(none));  // it would be a new body
    CHECK_FALSE(is_simple_both_ways(all));   // it would be a cavity
    CHECK(is_simple_both_ways(half));
    const NeighbourBits bridge = bit(12) | bit(13) | bit(14);
    CHECK_FALSE(is_simple_both_ways(bridge));  // it would part its neighbours
    CHECK(connects_parts(bridge));
    const NeighbourBits tip = bit(12) | bit(13);
    CHECK(is_simple_both_ways(tip));
    CHECK_FALSE(connects_parts(tip));
}

SCENARIO("A wall needs a mask", "[images][wall][bad-input]") {
    CHECK_THROWS_AS(extract_surface(ball(), std::nullopt, {.method = ExtractionMethod::Wall}),
                    InvalidInput);
}
