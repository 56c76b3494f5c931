#include "geometry/image/curved_field.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include <catch2/catch.hpp>

#include "geometry/image/extract_surface.h"
#include "geometry/image/iso_surface.h"
#include "geometry/image/mask_volume.h"
#include "geometry/image/separating_field.h"
#include "geometry/image/voxel_band.h"
#include "geometry/image/voxels.h"
#include "geometry/kernel/cross_section.h"
#include "geometry/kernel/mean_curvature.h"
#include "geometry/kernel/measure.h"
#include "tests/support/image_shapes.h"
#include "tests/support/surface_facts.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

constexpr double kPixel = 0.8;

/// A vessel by its distance from the wall, positive inside, between two heights.
struct Solid {
    std::function<double(const Vec3&)> distance;
    double radius = 0.0;
    Vec3 low, high;  ///< of its image [mm]
};

/// Tilted against the slices' axis.
Solid tilted_tube(double radius, double degrees) {
    const double tilt = degrees * std::numbers::pi / 180.0, half = 16.0;
    const Vec3 axis(std::sin(tilt) * std::cos(0.3), std::sin(tilt) * std::sin(0.3), std::cos(tilt));
    const double wide = half * std::tan(tilt) + radius + 4.0;
    return {[=](const Vec3& p) { return radius - (p - p.dot(axis) * axis).norm(); }, radius,
            Vec3(-wide, -0.4 * wide - radius, -half), Vec3(wide, 0.4 * wide + radius, half)};
}

/// Half a torus on two straight legs.
Solid arch(double radius) {
    constexpr double kBend = 20.0;
    const auto distance = [=](const Vec3& q) {
        const Vec3 p = q - Vec3(0.37, 0.21, 0.13);
        const double above = std::hypot(std::hypot(p.x(), p.z()) - kBend, p.y()),
                     below = std::hypot(std::abs(p.x()) - kBend, p.y());
        return radius - (p.z() > 0.0 ? above : below);
    };
    const double wide = kBend + radius + 4.0;
    return {distance, radius, Vec3(-wide, -radius - 4.0, -15.0),
            Vec3(wide, radius + 4.0, kBend + radius + 8.0)};
}

/// In slices so many times as thick as the pixels are wide.
Image mask_of(const Solid& solid, double ratio) {
    const Vec3 spacing(kPixel, kPixel, ratio * kPixel);
    Image grid;
    for (std::size_t a = 0; a < 3; ++a) {
        const auto axis = static_cast<Eigen::Index>(a);
        grid.size[a] = static_cast<int>((solid.high - solid.low)[axis] / spacing[axis]) + 1;
    }
    grid.index_to_patient.diagonal().head<3>() = spacing;
    grid.index_to_patient.block<3, 1>(0, 3) = solid.low + Vec3(0.13, 0.21, 0.08);
    return image_of(grid.size, grid.index_to_patient,
                    [&](const Vec3& p) { return solid.distance(p) > 0.0 ? 1.0 : 0.0; });
}

/// How a surface's wall compares with the truth, away from where the image ends.
struct Likeness {
    double error = 0.0;      ///< mean distance from the wall [mm]
    double curvature = 0.0;  ///< integral of |mean curvature| over that of a tube, 1 / (2 r) [-]
};

Likeness likeness_of(const Image& field, const Solid& solid, double slice) {
    const Surface surface = iso_surface(field, 0.0);
    const MeanCurvature bent = mean_curvature(surface);
    double error = 0.0, integral = 0.0, area = 0.0;
    std::size_t count = 0;
    for (std::size_t v = 0; v < surface.vertex_count(); ++v) {
        const Vec3& p = surface.points()[v];
        if (p.z() < solid.low.z() + 3.0 || p.z() > solid.high.z() - slice - 3.0) continue;
        error += std::abs(solid.distance(p));
        integral += std::abs(bent.values[v]) * bent.areas[v];
        area += bent.areas[v];
        ++count;
    }
    return {error / static_cast<double>(count), integral / area * 2.0 * solid.radius};
}

/// As extract_surface(): slices that are hardly thick need nothing.
Image smooth(const Image& mask) {
    if (!has_thick_slices(mask)) return separating_field(mask);
    const auto curved = curved_field(mask);
    REQUIRE(curved);
    return *curved;
}

}  // namespace

SCENARIO("A mask in thick slices is smooth where its vessel runs obliquely",
         "[images][mask-surface]") {
    struct Case {
        Solid solid;
        double ratio;
    };

    const std::vector<Case> cases = {{tilted_tube(4.0, 30.0), 3.0},
                                     {tilted_tube(4.0, 45.0), 4.0},
                                     {tilted_tube(6.0, 60.0), 4.0},
                                     {tilted_tube(4.0, 45.0), 6.0},
                                     {tilted_tube(8.0, 45.0), 6.0}};
    for (const Case& each : cases) {
        INFO("radius " << each.solid.radius << ", slices of " << each.ratio << " pixels");
        const double slice = each.ratio * kPixel;
        const Image mask = mask_of(each.solid, each.ratio);
        const Likeness likeness = likeness_of(smooth(mask), each.solid, slice);
        CHECK(likeness.curvature == Approx(1.0).margin(0.03));
        CHECK(likeness.error < 0.1 * kPixel);
        if (has_thick_slices(mask))
            CHECK(likeness.error <
                  0.7 * likeness_of(separating_field(mask), each.solid, slice).error);
    }
}

SCENARIO("An arch in thick slices is smooth at its top", "[images][mask-surface]") {
    const double ratio = GENERATE(4.0, 6.0);
    const Solid solid = arch(10.0);
    const Image mask = mask_of(solid, ratio);
    const Likeness likeness = likeness_of(smooth(mask), solid, ratio * kPixel),
                   straight = likeness_of(separating_field(mask), solid, ratio * kPixel);
    CHECK(likeness.curvature < 1.05);
    CHECK(likeness.error < 0.12 * kPixel);
    if (ratio > 5.0) CHECK(likeness.error < 0.85 * straight.error);
}

SCENARIO("A curved surface keeps what the mask says", "[images][mask-surface]") {
    const Image mask = mask_of(tilted_tube(4.0, 45.0), 6.0);
    REQUIRE(has_thick_slices(mask));
    const Image field = curved_field(mask).value();
    const Vec3 first = mask.to_index(field.to_patient(Vec3::Zero()));
    THEN("every voxel centre keeps its side") {
        for (int k = 0; k < field.size[2]; k += 6)
            for (int j = 0; j < field.size[1]; ++j)
                for (int i = 0; i < field.size[0]; ++i) {
                    const auto at = [&](int n, Eigen::Index axis) {
                        return n + static_cast<int>(std::lround(first[axis]));
                    };
                    REQUIRE((field.at(i, j, k) > 0.0f) ==
                            is_inside(mask.at(at(i, 0), at(j, 1), at(k / 6, 2))));
                }
    }
    THEN("it encloses the voxels' volume, is one body, and ends flat where the image does") {
        const Surface surface = iso_surface(field, 0.0);
        CHECK(volume(surface) == Approx(volume_of_voxels(mask)).epsilon(0.01));
        CHECK(is_closed_manifold(surface));
        CHECK(connectivity(*surface.topology).genus == 0);
        const Extraction made = extract_surface(mask, {},
                                                {.method = ExtractionMethod::Labels,
                                                 .mask_surface = MaskSurface::Lumen,
                                                 .between_slices = BetweenSlices::Curved});
        CHECK(made.between_slices == BetweenSlices::Curved);
        CHECK(made.surface.patches.size() == 3);
        CHECK(made.sampling.spacing.maxCoeff() == Approx(6.0 * kPixel));
    }
}

SCENARIO("A stenosis one voxel wide stays as wide as its voxels between curved slices",
         "[images][mask-surface]") {
    // A vessel along i with a chain of single voxels in one slice.
    Image grid;
    grid.size = {40, 17, 9};
    grid.index_to_patient.diagonal().head<3>() = Vec3(kPixel, kPixel, 4.0 * kPixel);
    const Image mask = image_of(grid.size, grid.index_to_patient, [&](const Vec3& p) {
        const Vec3 at = grid.to_index(p).array().round();
        if (at.x() > 15.5 && at.x() < 24.5) return at.y() == 8 && at.z() == 4 ? 1.0 : 0.0;
        return std::hypot(p.y() - 8 * kPixel, p.z() - 16 * kPixel) < 4.5 ? 1.0 : 0.0;
    });
    const auto section = [&](const Surface& surface) {
        const auto found =
            cross_section_at(surface, {mask.to_patient(Vec3(20, 8, 4)), Vec3::UnitX()});
        REQUIRE(found);
        return found->area;
    };
    const ExtractionParameters lumen{.method = ExtractionMethod::Labels,
                                     .mask_surface = MaskSurface::Lumen,
                                     .between_slices = BetweenSlices::Curved};
    const Extraction made = extract_surface(mask, {}, lumen);
    CHECK(made.between_slices == BetweenSlices::Curved);
    CHECK(section(made.surface) > 0.95 * kPixel * 3.0 * kPixel);
    THEN("so it does if the mask is a drawn wall, whose image shows nothing there") {
        const Image image = image_of(grid.size, grid.index_to_patient, [&](const Vec3& p) {
            return std::hypot(p.y() - 8 * kPixel, p.z() - 16 * kPixel) < 4.5 ? 200.0 : 50.0;
        });
        ExtractionParameters wall = lumen;
        wall.method = ExtractionMethod::Wall;
        const Extraction drawn = extract_surface(image, mask, wall);
        CHECK(is_closed_manifold(drawn.surface));
        CHECK(section(drawn.surface) > 0.95 * kPixel * 3.0 * kPixel);
        REQUIRE(drawn.lumen);
        CHECK(drawn.lumen->chain > 5);
    }
}

SCENARIO("A drawn wall in thick slices lies at the image's edge", "[images][wall]") {
    const Solid solid = tilted_tube(5.0, 40.0);
    const Image mask = mask_of(solid, 4.0);
    const Image image = image_of(mask.size, mask.index_to_patient, [&](const Vec3& p) {
        return 50.0 + 150.0 * 0.5 * std::erfc(-solid.distance(p) / (0.8 * kPixel));
    });
    Extraction made = extract_surface(
        image, mask, {.method = ExtractionMethod::Wall, .between_slices = BetweenSlices::Curved});
    CHECK(made.between_slices == BetweenSlices::Curved);
    CHECK(is_closed_manifold(made.surface));
    const auto error_of = [&](const Surface& surface) {
        double error = 0.0;
        std::size_t count = 0;
        for (const Vec3& p : surface.points()) {
            if (std::abs(p.z()) > 10.0) continue;
            error += std::abs(solid.distance(p));
            ++count;
        }
        return error / static_cast<double>(count);
    };
    const Extraction straight = extract_surface(image, mask, {.method = ExtractionMethod::Wall});
    CHECK(error_of(made.surface) < 0.12 * kPixel);
    CHECK(error_of(made.surface) < error_of(straight.surface));
}
