#include "geometry/image/missing_voxels.h"

#include <algorithm>
#include <random>

#include <catch2/catch.hpp>

#include "geometry/image/voxel_band.h"
#include "tests/support/image_shapes.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

/// A tube of radius 9 voxels, of which a share is missing.
Image tube_without(double missing) {
    Image mask;
    mask.size = {31, 31, 61};
    mask.index_to_patient = oblique_matrix(Vec3::Constant(1.0), Vec3::Zero());
    std::mt19937 random(3);
    return image_of(mask.size, mask.index_to_patient, [&](const Vec3& p) {
        const Vec3 at = mask.to_index(p) - Vec3(15, 15, 30);
        const bool inside = at.head<2>().norm() < 9.0 && std::abs(at.z()) < 25.0;
        const double draw = static_cast<double>(random()) / 4294967296.0;
        return inside && draw >= missing ? 1.0 : 0.0;
    });
}

std::size_t inside_of(const Image& mask) {
    return static_cast<std::size_t>(std::ranges::count_if(*mask.voxels, is_inside));
}

}  // namespace

SCENARIO("Missing voxels of a mask are filled", "[images][mask-surface]") {
    const double missing = GENERATE(0.06, 0.12, 0.25);
    GIVEN("a tube without " << missing << " of its voxels") {
        const Image mask = tube_without(missing);
        const FilledMask filled = without_missing_voxels(mask);
        CHECK(filled.before == voxel_topology(mask, 0.5));
        CHECK(filled.before.tunnels() + filled.before.cavities > 100);
        CHECK(filled.closing >= 1);
        CHECK(filled.after.tunnels() + filled.after.cavities <= 100);
        const auto whole = static_cast<double>(inside_of(tube_without(0.0)));
        CHECK(static_cast<double>(inside_of(filled.mask)) == Approx(whole).epsilon(0.03));
        CHECK(filled.added == inside_of(filled.mask) - inside_of(mask));
    }
}

SCENARIO("A mask that is whole stays as it is", "[images][mask-surface]") {
    const Image mask = tube_without(0.0);
    const FilledMask filled = without_missing_voxels(mask);
    CHECK(filled.closing == 0);
    CHECK(filled.added == 0);
    CHECK(filled.mask.voxels == mask.voxels);
    THEN("and so does one that is too sparse to be mended") {
        const Image sparse = tube_without(0.97);
        CHECK(without_missing_voxels(sparse).mask.voxels == sparse.voxels);
    }
}
