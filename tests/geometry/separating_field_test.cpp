#include "geometry/image/separating_field.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stop_token>

#include <catch2/catch.hpp>
#include <tbb/global_control.h>

#include "geometry/image/extract_surface.h"
#include "geometry/image/iso_surface.h"
#include "geometry/image/voxel_band.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/measure.h"
#include "tests/support/image_shapes.h"
#include "tests/support/surface_facts.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

using Solid = std::function<double(const Vec3&)>;  ///< above 0 inside

/// Where a solid's origin lies in mask_of(): off the voxel centres.
Vec3 solid_middle(const Image& mask) {
    return middle_of(mask) + Vec3(0.13, 0.21, 0.08);
}

/// 24 mm wide, with the given voxel edges [mm].
Image mask_of(const Vec3& spacing, const Solid& solid, bool mirrored = false) {
    std::array<int, 3> size = {};
    for (std::size_t a = 0; a < 3; ++a)
        size[a] = static_cast<int>(std::lround(24.0 / spacing[static_cast<Eigen::Index>(a)])) + 1;
    Image grid;
    grid.size = size;
    grid.index_to_patient = oblique_matrix(spacing, Vec3(3.1, -40.2, 7.3), mirrored);
    const Vec3 middle = solid_middle(grid);
    return image_of(size, grid.index_to_patient,
                    [&](const Vec3& p) { return solid(p - middle) > 0.0 ? 1.0 : 0.0; });
}

Solid ball(double radius) {
    return [radius](const Vec3& p) { return radius - p.norm(); };
}

/// A tube of the given radius along an axis.
Solid tube(double radius, const Vec3& axis) {
    return [radius, axis](const Vec3& p) { return radius - (p - p.dot(axis) * axis).norm(); };
}

/// A ball, and a thread one voxel wide through its middle along the i axis.
Image ball_on_thread() {
    Image grid;
    grid.size = {25, 17, 17};
    grid.index_to_patient = oblique_matrix(Vec3::Constant(1.0), Vec3::Zero());
    return image_of(grid.size, grid.index_to_patient, [&](const Vec3& p) {
        const Vec3 q = grid.to_index(p) - Vec3(12, 8, 8);
        return q.tail<2>().norm() < 0.5 || q.norm() < 4.0 ? 1.0 : 0.0;
    });
}

Surface midway(const Image& mask) {
    return iso_surface(mask, 0.5);
}

Surface smooth(const Image& mask) {
    return iso_surface(separating_field(mask), 0.0);
}

/// Mean distance of the vertices from the solid's surface [mm].
double mean_error(const Surface& surface, const Vec3& middle, const Solid& distance) {
    double sum = 0.0;
    for (const Vec3& p : surface.points()) sum += std::abs(distance(p - middle));
    return sum / static_cast<double>(surface.vertex_count());
}

double voxel_volume(const Image& mask) {
    return mask.spacing().prod() * static_cast<double>(std::ranges::count(*mask.voxels, 1.0f));
}

}  // namespace

SCENARIO("A separating field is nearer to the truth than the middle between voxels",
         "[images][mask-surface]") {
    const double thick = GENERATE(1.0, 2.0, 3.0);
    const bool mirrored = GENERATE(false, true);
    GIVEN("a ball in slices " << thick << " times as thick as the voxels") {
        const Image mask = mask_of(Vec3(0.8, 0.8, 0.8 * thick), ball(8.0), mirrored);
        const Vec3 middle = solid_middle(mask);
        CHECK(mean_error(smooth(mask), middle, ball(8.0)) <
              0.5 * mean_error(midway(mask), middle, ball(8.0)));
    }
}

SCENARIO("A separating field has the topology of the mask's surface", "[images][mask-surface]") {
    const Image mask = mask_of(Vec3(0.5, 0.5, 1.5), [](const Vec3& p) {
        const double ring = std::hypot(std::hypot(p.x(), p.y()) - 6.0, p.z());
        const bool corner = p.x() > 5.0 && p.y() > 5.0 && p.z() > 4.0;
        return ring < 2.0 || corner ? 1.0 : 0.0;
    });
    const Surface before = midway(mask), after = smooth(mask);
    THEN("the surfaces differ by the places of their vertices only") {
        CHECK(std::ranges::equal(after.triangles(), before.triangles()));
        CHECK(is_closed_manifold(after));
    }
    THEN("every voxel centre keeps its side") {
        const Image field = separating_field(mask);
        for (std::size_t v = 0; v < mask.voxel_count(); ++v)
            REQUIRE(((*field.voxels)[v] > 0.0f) == is_inside((*mask.voxels)[v]));
    }
}

SCENARIO("A separating field encloses the volume of the voxels", "[images][mask-surface]") {
    const double radius = GENERATE(2.5, 4.0, 8.0);
    const Image mask = mask_of(Vec3(0.6, 0.6, 1.2), ball(radius));
    CHECK(volume(smooth(mask)) == Approx(voxel_volume(mask)).epsilon(0.005));
}

SCENARIO("A separating field keeps parts of one voxel's width", "[images][mask-surface]") {
    const Image mask = ball_on_thread();
    const Surface raw = midway(mask), surface = smooth(mask);
    CHECK(std::ranges::equal(surface.triangles(), raw.triangles()));
    double least = 1e9;
    for (const Vec3& p : surface.points()) {
        const Vec3 q = mask.to_index(p) - Vec3(12, 8, 8);
        if (std::abs(q.x()) > 6.0 && std::abs(q.x()) < 11.0)
            least = std::min(least, q.tail<2>().norm());
    }
    CHECK(least > 0.2);
}

SCENARIO("A vessel that leaves the image is smooth up to the border", "[images][mask-surface]") {
    const Eigen::Matrix4d matrix = oblique_matrix(Vec3(0.8, 0.8, 1.6), Vec3::Zero());
    const Vec3 axis =
        (matrix.block<3, 1>(0, 2).normalized() + 0.3 * matrix.block<3, 1>(0, 0).normalized())
            .normalized();
    const Image mask = mask_of(Vec3(0.8, 0.8, 1.6), tube(4.0, axis));
    const Extraction found = extract_surface(
        mask, {}, {.method = ExtractionMethod::Labels, .mask_surface = MaskSurface::Smooth});
    CHECK(found.mask_surface == MaskSurface::Smooth);
    CHECK(is_closed_manifold(found.surface));
    CHECK(found.surface.patches.size() == 3);
    double largest = 0.0;
    for (TriangleId t = 0; t < found.surface.triangle_count(); ++t)
        if (found.surface.patch_of(t).kind == PatchKind::Wall)
            for (const VertexId v : found.surface.triangles()[t])
                largest = std::max(largest, std::abs(tube(4.0, axis)(found.surface.points()[v] -
                                                                     solid_middle(mask))));
    CHECK(largest < 0.4);
}

SCENARIO("A separating field does not depend on threads or units", "[images][mask-surface]") {
    const Image mask = mask_of(Vec3(0.9, 0.9, 1.8), ball(6.0));
    const Image field = separating_field(mask);
    THEN("one thread gives the same bits") {
        const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
        CHECK(*separating_field(mask).voxels == *field.voxels);
    }
    THEN("the same mask in another unit gives the same surface in that unit") {
        Image large = mask;
        large.index_to_patient.topRows<3>() *= 8.0;  // exact in floating point
        const Image scaled = separating_field(large);
        float most = 0.0f;
        for (std::size_t v = 0; v < mask.voxel_count(); ++v)
            most = std::max(most, std::abs((*scaled.voxels)[v] / 8.0f - (*field.voxels)[v]));
        CHECK(most < 1e-3f);
    }
}

SCENARIO("A separating field can be cancelled", "[images][mask-surface]") {
    std::stop_source stop;
    const Progress progress(
        [&](double fraction, std::string_view) {
            if (fraction > 0.3) stop.request_stop();
        },
        stop.get_token());
    CHECK_THROWS_AS(separating_field(mask_of(Vec3::Constant(0.8), ball(8.0)), progress), Cancelled);
}

SCENARIO("A band of voxels knows its layers and neighbours", "[images][mask-surface]") {
    const Image mask = mask_of(Vec3(1.0, 1.0, 2.0), ball(6.0));
    const VoxelBand band = voxel_band(mask, 2);
    for (std::size_t v = 0; v < band.size(); ++v) {
        const bool at_outline =
            std::ranges::any_of(std::span(band.neighbours[v]).first(6), [&](std::int32_t n) {
                return n >= 0 && band.inside[static_cast<std::size_t>(n)] != band.inside[v];
            });
        REQUIRE((band.layer[v] == 1) == at_outline);
        REQUIRE((band.depth[v] == 0.0f) == at_outline);
        REQUIRE(band.depth[v] < 2.5f);  // the diagonal of a voxel
        for (std::size_t n = 0; n < VoxelBand::kNeighbours; n += 2)
            if (band.neighbours[v][n] >= 0)
                REQUIRE(band.neighbours[static_cast<std::size_t>(band.neighbours[v][n])][n + 1] ==
                        static_cast<std::int32_t>(v));
    }
    CHECK_THROWS_AS(voxel_band(mask, 0), InvalidInput);
    CHECK_THROWS_AS(voxel_band(mask, 9), InvalidInput);
}
