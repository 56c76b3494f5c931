#include <algorithm>
#include <cmath>
#include <utility>

#include <catch2/catch.hpp>

#include "geometry/kernel/surface.h"
#include "geometry/vessel/centerlines/centerlines.h"
#include "geometry/vessel/ends/end_profile.h"
#include "geometry/vessel/ends/image_box.h"
#include "geometry/vessel/ends/patch_shape.h"
#include "geometry/vessel/ends/surface_ends.h"
#include "geometry/vessel/repair/repair.h"
#include "tests/support/iso_surface.h"
#include "tests/support/shapes.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

constexpr double kDegree = 0.017453292519943295;

/// With the triangles whose middles are `in_cap` as a patch of kind Cut, number 1.
template <class InCap>
Surface with_cap(const Surface& surface, const InCap& in_cap) {
    PatchLabels labels(surface.triangle_count(), 0);
    for (TriangleId t = 0; t < labels.size(); ++t) {
        const auto& [a, b, c] = surface.triangles()[t];
        labels[t] =
            in_cap((surface.points()[a] + surface.points()[b] + surface.points()[c]) / 3.0) ? 1 : 0;
    }
    return surface.with_patches(std::move(labels),
                                {{"wall", PatchKind::Wall}, {"cap", PatchKind::Cut}});
}

EndProfile face_that_rises(double degrees) {
    EndProfile profile{.kind = EndKind::Face};
    profile.cap_rise = degrees;
    return profile;
}

}  // namespace

SCENARIO("The wall rises from a cap across a tube, and leans into a flat place of a dome",
         "[geometry][ends]") {
    const Surface tube =
        with_cap(closed_tube(2.0, 20.0, 40, 40), [](const Vec3& p) { return p.z() > 20.0 - 1e-6; });
    CHECK(wall_rise_deg(tube, 1) == Approx(90.0).margin(1.0));
    const Surface ball =
        with_cap(icosphere(1.0, 4), [](const Vec3& p) { return p.z() > std::cos(20.0 * kDegree); });
    // Half the cap's radius behind it begins at 37 degrees from the pole, a whole one at 51.
    CHECK(wall_rise_deg(ball, 1) == Approx(44.0).margin(3.0));
}

SCENARIO("A rounded rim does not make the wall lean over a cap", "[geometry][ends]") {
    // A disc that grows by the radius of its rounding.
    constexpr double kRadius = 2.0, kRounding = 0.5, kEnd = 10.07;
    const auto inner = [](const Vec3& p) {
        const double side = std::hypot(p.x(), p.y()) - (kRadius - kRounding);
        const double along = std::abs(p.z()) - (kEnd - kRounding);
        return std::hypot(std::max(side, 0.0), std::max(along, 0.0)) +
               std::min(std::max(side, along), 0.0);
    };
    const auto shape = [&](const Vec3& p) { return inner(p) - kRounding; };
    const Surface surface =
        repair(iso_surface(shape, {Vec3(-3, -3, -11), Vec3(3, 3, 11)}, 0.2)).surface;
    const Surface capped = with_cap(surface, [](const Vec3& p) { return p.z() > kEnd - 0.02; });
    CHECK(wall_rise_deg(capped, 1) == Approx(90.0).margin(4.0));
}

SCENARIO("A face on which the wall stands upright shows a cut, one into which it leans does not",
         "[geometry][ends]") {
    CHECK(face_that_rises(90.0).upright() == Approx(1.0));
    CHECK(face_that_rises(81.0).upright() == Approx(0.5));
    CHECK(face_that_rises(60.0).upright() == 0.0);
    // Towards a face the wall may flare, as where a bend was cut; towards a dome's it never does.
    CHECK(face_that_rises(99.0).upright() == Approx(1.0));
    EndProfile border = face_that_rises(90.0);
    border.kind = EndKind::Border;
    CHECK(border.upright() == 0.0);
}

SCENARIO("What is closed beside two upright faces knows of them", "[geometry][ends]") {
    Surface tube = closed_tube(2.0, 20.0, 40, 40);
    PatchLabels labels(tube.triangle_count(), 0);
    for (TriangleId t = 0; t < labels.size(); ++t) {
        const auto& [a, b, c] = tube.triangles()[t];
        const double low =
            std::min({tube.points()[a].z(), tube.points()[b].z(), tube.points()[c].z()});
        const double high =
            std::max({tube.points()[a].z(), tube.points()[b].z(), tube.points()[c].z()});
        labels[t] = high < 1e-6 ? 1 : low > 20.0 - 1e-6 ? 2 : 0;
    }
    tube = tube.with_patches(
        std::move(labels),
        {{"wall", PatchKind::Wall}, {"cut-1", PatchKind::Cut}, {"cut-2", PatchKind::Cut}});
    const auto graph = centerlines_of(tube);
    const std::vector<SurfaceEnd> ends = find_surface_ends(tube, *graph);
    const EndProfiles profiles = profiles_of({.surface = tube, .graph = *graph}, ends, {});
    REQUIRE(profiles.ends.size() == 2);
    for (const EndProfile& profile : profiles.ends) {
        CHECK(profile.kind == EndKind::Face);
        CHECK(profile.faces_beside == Approx(1.0).margin(0.05));
    }
}

SCENARIO("A cap lies at an image's border, whatever the image's axes", "[geometry][ends]") {
    ImageBox box{.size = {20, 30, 40}};
    CHECK(box.voxel() == Approx(1.0));
    const Vec3 down = -Vec3::UnitZ();
    CHECK(box.ends_at({Vec3(10, 10, 0.5), down}));
    CHECK(box.ends_at({Vec3(10, 10, 38.5), -down}));
    CHECK_FALSE(box.ends_at({Vec3(10, 10, 0.5), -down}));  // it faces inward
    CHECK_FALSE(box.ends_at({Vec3(10, 10, 5.0), down}));
    CHECK_FALSE(box.ends_at({Vec3(10, 10, 0.5), Vec3(1, 0, -1).normalized()}));
    box.index_to_patient.row(2) *= -2.0;  // k runs to the feet, in voxels of 2 mm
    CHECK(box.voxel() == Approx(std::cbrt(2.0)));
    CHECK(box.ends_at({Vec3(10, 10, -1.0), -down}));
    CHECK(box.ends_at({Vec3(10, 10, -77.0), down}));
}
