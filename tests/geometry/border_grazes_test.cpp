#include "geometry/image/border_grazes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "geometry/image/extract_surface.h"
#include "geometry/image/voxel_band.h"
#include "geometry/kernel/measure.h"
#include "tests/support/image_shapes.h"
#include "tests/support/shapes.h"
#include "tests/support/surface_facts.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

using Solid = std::function<bool(const Vec3&)>;  ///< by voxel index

Image mask_of(const std::array<int, 3>& size, const Solid& solid) {
    Image grid;
    grid.size = size;
    grid.index_to_patient = oblique_matrix(Vec3(0.5, 0.5, 0.5), Vec3(3, -40, 7), true);
    return image_of(size, grid.index_to_patient,
                    [&](const Vec3& p) { return solid(grid.to_index(p)) ? 1.0 : 0.0; });
}

/// Of radius 8 voxels around a line along z, tilted by an angle, in a box of 41 x 41 x 41.
Image tilted_tube(double degrees) {
    const double angle = degrees * std::numbers::pi / 180.0;
    const Vec3 axis(std::sin(angle), 0.0, std::cos(angle));
    return mask_of({41, 41, 41}, [axis](const Vec3& at) {
        const Vec3 from = at - Vec3::Constant(20.0);
        return (from - from.dot(axis) * axis).norm() < 8.0;
    });
}

/// A half ring of radius 20 voxels and thickness 12, with its ends at z = 0.
Solid arch(double over) {
    return [over](const Vec3& at) {
        const Vec3 from = at - Vec3(26.0, 6.0, over);
        const double ring = std::hypot(std::hypot(from.x(), from.z()) - 20.0, from.y());
        return ring < 6.2;
    };
}

Extraction lumen_of(const Image& mask, FreedSides sides = FreedSides::All) {
    return extract_surface(mask, {},
                           {.method = ExtractionMethod::Labels,
                            .mask_surface = MaskSurface::Lumen,
                            .freed_sides = sides});
}

}  // namespace

SCENARIO("A vessel that crosses an image's border is no graze", "[images][mask-surface]") {
    const double tilt = GENERATE(0.0, 20.0, 40.0);
    GIVEN("a tube, " << tilt << " degrees from a side's normal") {
        const Image mask = tilted_tube(tilt);
        const FreedMask freed = without_grazes(mask, FreedSides::All);
        CHECK(freed.grazes == 0);
        CHECK(freed.mask.voxels == mask.voxels);
    }
}

SCENARIO("A vessel whose outermost layer is ragged is no graze", "[images][mask-surface]") {
    const Image whole = tilted_tube(10.0);
    std::vector<float> voxels = *whole.voxels;
    for (std::size_t v = 0; v < 41 * 41; ++v)
        if (v % 41 != 12) voxels[v] = 0.0f;
    Image ragged = whole;
    ragged.voxels = std::make_shared<const std::vector<float>>(std::move(voxels));
    CHECK(without_grazes(ragged, FreedSides::All).grazes == 0);
}

SCENARIO("A wall that touches the border is no end", "[images][mask-surface]") {
    GIVEN("a ball in its own box") {
        const Image tight = mask_of(
            {17, 17, 17}, [](const Vec3& at) { return (at - Vec3::Constant(8.0)).norm() < 8.5; });
        const FreedMask freed = without_grazes(tight, FreedSides::All);
        CHECK(freed.grazes == 6);
        CHECK(freed.mask.size == std::array<int, 3>{19, 19, 19});
        for (const Vec3& at : {Vec3(0, 0, 0), Vec3(8, 8, 8), Vec3(16, 3, 5)})
            CHECK((freed.mask.to_patient(at + Vec3::Ones()) - tight.to_patient(at)).norm() < 1e-9);
        CHECK(std::ranges::count_if(*freed.mask.voxels, is_inside) ==
              std::ranges::count_if(*tight.voxels, is_inside));
        THEN("its surface is closed, without caps") {
            const Extraction found = lumen_of(tight);
            CHECK(found.lumen->grazes == 6);
            CHECK(found.surface.patches.size() == 1);
            CHECK(is_closed_manifold(found.surface));
        }
    }
    GIVEN("an arch in its own box, cut at both ends") {
        // Of its sides, five touch the wall, and one cuts both ends.
        const Extraction found = lumen_of(mask_of({53, 13, 27}, arch(0.0)));
        CHECK(found.lumen->grazes == 5);
        CHECK(found.surface.patches.size() == 3);
        for (const PatchMeasures& patch : measure_patches(found.surface))
            if (patch.kind == PatchKind::Cut)
                CHECK(patch.area == Approx(std::numbers::pi * 6.2 * 6.2 * 0.25).epsilon(0.1));
    }
}

SCENARIO("Cropping a mask to its own box leaves its cut ends where they are",
         "[images][mask-surface]") {
    const Image tight = mask_of({53, 13, 27}, arch(0.0));
    const Image roomy =
        mask_of({63, 23, 32}, [](const Vec3& at) { return arch(0.0)(at - Vec3(5.0, 5.0, 0.0)); });
    const FreedMask freed = without_grazes(tight, FreedSides::Touched);
    CHECK(freed.grazes == 5);
    CHECK(freed.mask.size == std::array<int, 3>{55, 15, 28});
    CHECK((freed.mask.to_patient(Vec3(1, 1, 0)) - tight.to_patient(Vec3::Zero())).norm() < 1e-9);
    const double whole = volume(lumen_of(roomy).surface);
    CHECK(volume(lumen_of(tight, FreedSides::Touched).surface) == Approx(whole).epsilon(2e-3));
    CHECK(volume(lumen_of(tight).surface) > 1.02 * whole);  // a voxel longer at both ends
}
