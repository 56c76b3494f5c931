#include "geometry/image/voxel_chains.h"

#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>

#include "geometry/image/iso_surface.h"
#include "geometry/image/separating_field.h"
#include "geometry/image/shells.h"
#include "geometry/image/voxel_band.h"
#include "geometry/kernel/cross_section.h"
#include "tests/support/image_shapes.h"
#include "tests/support/surface_facts.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

using Index = std::array<int, 3>;

constexpr int kHalf = 6;  ///< voxels of a chain on each side of its middle
const Vec3 kVoxel(0.4, 0.4, 0.4);

/// Two balls of radius 5 voxels, joined by a chain along `step`.
Image two_balls(const Index& step, const Vec3& spacing = kVoxel) {
    constexpr int kSize = 41, kMiddle = 20;
    Image mask;
    mask.size = {kSize, kSize, kSize};
    mask.index_to_patient = oblique_matrix(spacing, Vec3(3, -8, 5));
    const Vec3 direction(step[0], step[1], step[2]), middle = Vec3::Constant(kMiddle);
    return image_of(mask.size, mask.index_to_patient, [&](const Vec3& p) {
        const Vec3 at = mask.to_index(p).array().round();
        const Vec3 ball = (kHalf + 5.0 / direction.norm()) * direction;
        if (((at - middle) - ball).norm() < 5.0 || ((at - middle) + ball).norm() < 5.0) return 1.0;
        for (int n = -kHalf; n <= kHalf; ++n)
            if (at == middle + n * direction) return 1.0;
        return 0.0;
    });
}

Surface smooth_lumen(const Image& mask) {
    const Image joined = joined_chains(mask).mask;
    return iso_surface(with_voxel_width(joined, separating_field(joined)), 0.0);
}

/// Area of the section across the chain's middle [mm^2].
double section_area(const Image& mask, const Surface& surface, const Index& step) {
    const Vec3 middle = mask.to_patient(Vec3::Constant(20.0));
    const Vec3 ahead = mask.to_patient(Vec3(20.0 + step[0], 20.0 + step[1], 20.0 + step[2]));
    const auto section = cross_section_at(surface, {middle, (ahead - middle).normalized()});
    REQUIRE(section);
    return section->area;
}

}  // namespace

SCENARIO("A chain of voxels is as wide as a voxel's face", "[images][mask-surface]") {
    const Index step = GENERATE(Index{0, 0, 1}, Index{1, 0, 0}, Index{1, 0, 1}, Index{1, 0, -1},
                                Index{1, 1, 1}, Index{1, -1, 1});
    GIVEN("one along " << step[0] << ", " << step[1] << ", " << step[2]) {
        const Image mask = two_balls(step);
        const Surface surface = smooth_lumen(mask);
        CHECK(is_closed_manifold(surface));
        CHECK(largest_body(surface).bodies == 1);
        CHECK(section_area(mask, surface, step) > 0.95 * 0.4 * 0.4);
        THEN("all voxels keep their sides, but for those that join") {
            const JoinedMask joined = joined_chains(mask);
            const Image field = with_voxel_width(joined.mask, separating_field(joined.mask));
            for (std::size_t v = 0; v < mask.voxel_count(); ++v) {
                if (is_inside((*mask.voxels)[v])) REQUIRE(is_inside((*joined.mask.voxels)[v]));
                REQUIRE(((*field.voxels)[v] > 0.0f) == is_inside((*joined.mask.voxels)[v]));
            }
        }
    }
}

SCENARIO("A chain in thick slices is as wide as its voxels' faces", "[images][mask-surface]") {
    const Vec3 spacing(0.4, 0.4, 1.2);
    const Index step = {1, 0, 0};
    const Image mask = two_balls(step, spacing);
    CHECK(section_area(mask, smooth_lumen(mask), step) > 0.95 * 0.4 * 1.2);
}

SCENARIO("Only chains are joined", "[images][mask-surface]") {
    THEN("chains that have faces in common need nothing") {
        CHECK(joined_chains(two_balls({0, 0, 1})).added == 0);
    }
    THEN("each step along an edge gets a voxel, and each along a corner two") {
        // From the last voxel of the one ball to the first of the other.
        const std::size_t edges = joined_chains(two_balls({1, 0, 1})).added;
        CHECK(edges >= 2 * kHalf);
        CHECK(edges <= 2 * kHalf + 2);
        const std::size_t corners = joined_chains(two_balls({1, 1, 1})).added;
        CHECK(corners >= 2 * 2 * kHalf);
        CHECK(corners <= 2 * (2 * kHalf + 2));
    }
    THEN("a single voxel beside a wide part stays apart, and so do wide parts that touch") {
        const Image grid = two_balls({0, 0, 1});
        const auto block = [](const Vec3& at, int low, int high) {
            return at.minCoeff() > low - 0.5 && at.maxCoeff() < high + 0.5;
        };
        const Image speck = image_of(grid.size, grid.index_to_patient, [&](const Vec3& p) {
            const Vec3 at = grid.to_index(p).array().round();
            return block(at, 10, 15) || at == Vec3(16, 16, 12) ? 1.0 : 0.0;
        });
        CHECK(joined_chains(speck).added == 0);
        const Image blocks = image_of(grid.size, grid.index_to_patient, [&](const Vec3& p) {
            const Vec3 at = grid.to_index(p).array().round();
            return block(at, 10, 15) || block(at, 16, 21) ? 1.0 : 0.0;
        });
        CHECK(joined_chains(blocks).added == 0);
    }
}

SCENARIO("Wide parts of a mask keep their surface", "[images][mask-surface]") {
    const Image mask = two_balls({0, 0, 1});
    const Image field = separating_field(mask), widened = with_voxel_width(mask, field);
    for (std::size_t v = 0; v < mask.voxel_count(); ++v) {
        const auto layer =
            static_cast<std::size_t>(mask.size[0]) * static_cast<std::size_t>(mask.size[1]);
        const auto k = static_cast<int>(v / layer) - 20;
        if (std::abs(k) > kHalf + 2) REQUIRE((*field.voxels)[v] == (*widened.voxels)[v]);
    }
    CHECK(chain_voxels(mask).size() >= 2 * kHalf - 1);
    CHECK(chain_voxels(mask).size() <= 2 * kHalf + 3);
}
