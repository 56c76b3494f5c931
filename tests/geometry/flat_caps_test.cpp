#include "geometry/vessel/openings/flat_caps.h"

#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>

#include "geometry/formats/surface_file.h"
#include "geometry/kernel/edges.h"
#include "geometry/vessel/centerlines/centerlines.h"
#include "geometry/vessel/openings/clip_openings.h"
#include "geometry/vessel/openings/opening_axis.h"
#include "geometry/vessel/openings/openings.h"
#include "geometry/vessel/repair/repair.h"
#include "tests/support/iso_surface.h"
#include "tests/support/shapes.h"
#include "tests/support/surface_facts.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

Surface unlabelled(const Surface& surface) {
    return surface.with_patches(PatchLabels(surface.triangle_count(), 0),
                                {{"wall", PatchKind::Wall}});
}

/// A closed tube without labels, oblique by `slope` at its upper end; the middles of its caps are
/// moved inward [mm].
Surface capped_tube(double slope, double dent) {
    const Surface tube = mapped(closed_tube(2.0, 30.0, 40, 90), [&](const Vec3& p) {
        const bool middle = p.head<2>().norm() < 1e-9;
        const double inward = middle ? (p.z() > 15.0 ? -dent : dent) : 0.0;
        return Vec3(p.x(), p.y(),
                    p.z() + std::max(0.0, (p.z() - 15.0) / 15.0) * slope * p.x() + inward);
    });
    return unlabelled(tube);
}

/// A closed tube of radius 2 without labels, whose caps bulge by `height` radii at their middles.
Surface rounded_caps(int around, double height) {
    return unlabelled(mapped(fine_tube(2.0, 30.0, around), [&](const Vec3& p) {
        const double at = std::min(1.0, p.head<2>().squaredNorm() / 4.0);
        const double outward = 2.0 * height * (1.0 - at);
        const bool cap = p.z() < 1e-9 || p.z() > 30.0 - 1e-9;
        return Vec3(p.x(), p.y(), p.z() + (cap ? (p.z() > 15.0 ? outward : -outward) : 0.0));
    }));
}

/// A vessel of radius 2 that leads into a ball of radius 12, which has a mouth of a given radius;
/// the middle of its cap is pushed in by `dent` radii.
Surface chamber(double mouth, double dent) {
    const double length = 27.0 + std::sqrt(144.0 - mouth * mouth);
    return mapped(closed_tube(2.0, length, 40, 120), [=](const Vec3& p) {
        const double beside = p.z() - 27.0;
        const double radius = std::sqrt(std::max(4.0, 144.0 - beside * beside));
        const bool middle = p.head<2>().norm() < 1e-9 && p.z() > 15.0;
        return Vec3(0.5 * radius * p.x(), 0.5 * radius * p.y(),
                    p.z() - (middle ? dent * mouth : 0.0));
    });
}

/// The surface of a shape's voxel mask.
Surface masked(const ImplicitShape& shape, const Eigen::AlignedBox3d& box, double voxel) {
    const auto mask = [&](const Vec3& p) { return shape(p) < 0.0 ? -1.0 : 1.0; };
    return unlabelled(iso_surface(mask, box, voxel));
}

}  // namespace

SCENARIO("Flat caps of a closed surface without labels are kept as its openings",
         "[geometry][openings]") {
    for (const double slope : {0.0, 0.5})
        for (const double dent : {0.0, 0.2, 0.6, -0.6}) {
            CAPTURE(slope, dent);
            const Surface tube = capped_tube(slope, dent);
            const Surface found = label_flat_caps(tube);
            REQUIRE(found.patches.size() == 3);
            for (const std::size_t p : {1, 2}) {
                CHECK(found.patches[p].kind == PatchKind::Cut);
                CHECK(patch_shape(found, p).flatness < 1e-9);
            }
            for (VertexId v = 0; v + 2 < tube.vertex_count(); ++v)
                CHECK(found.points()[v] == tube.points()[v]);
            const auto graph = centerlines_of(found, {}, {});
            const OpeningPlan plan = plan_openings(found, *graph);
            REQUIRE(plan.openings.size() == 2);
            for (const PlannedOpening& opening : plan.openings)
                CHECK(opening.way == OpeningWay::KeepCap);
            const Surface opened = clip_openings(found, plan).surface;
            CHECK(enclosed_volume(opened) == Approx(enclosed_volume(found)).epsilon(1e-9));
            AND_THEN("an image's border is kept only across its vessel") {
                const OpeningPlan border = plan_openings(found, *graph, {.border_cuts = true});
                const auto kept =
                    std::ranges::count(border.openings, OpeningWay::KeepCap, &PlannedOpening::way);
                CHECK(kept == (slope == 0.0 ? 2 : 1));
            }
        }
}

SCENARIO("A cap is known by its sharp and flat rim, however smoothing has bent its middle",
         "[geometry][openings]") {
    for (const int around : {12, 24, 48})
        for (const double height : {-0.4, -0.3, -0.1, 0.1, 0.3, 0.4}) {
            CAPTURE(around, height);
            const Surface found = label_flat_caps(rounded_caps(around, height));
            REQUIRE(found.patches.size() == 3);
            for (const std::size_t p : {1, 2}) {
                const PatchShape cap = patch_shape(found, p);
                CHECK(cap.flatness < 1e-9);
                CHECK(cap.diameter() == Approx(4.0).epsilon(0.05));
                CHECK(std::abs(cap.plane.point.z() - 15.0) == Approx(15.0).epsilon(1e-6));
            }
        }
}

SCENARIO("An oblique cap of a narrowing vessel is found", "[geometry][openings]") {
    // Along a seventh of its rim, cap and wall meet at less than 40 degrees.
    const Surface tube = mapped(closed_tube(2.0, 30.0, 40, 90), [](const Vec3& p) -> Vec3 {
        const double width = 1.0 - 0.26 * std::max(0.0, p.z() - 28.5);
        const double slope = 0.6 * std::max(0.0, (p.z() - 15.0) / 15.0);
        return Vec3(width * p.x(), width * p.y(), p.z() + slope * width * p.x());
    });
    CHECK(label_flat_caps(unlabelled(tube)).patches.size() == 3);
}

SCENARIO("The tip of a coarse rounded end is no cap", "[geometry][openings]") {
    // The last ring is drawn in: the wall turns by 30 degrees around the flat tip.
    const auto tip = [](int segments) {
        return unlabelled(mapped(closed_tube(2.0, 30.0, segments, 90), [](const Vec3& p) {
            const bool last = p.z() > 29.9;
            const double width = last ? 0.75 : 1.0;
            return Vec3(width * p.x(), width * p.y(), last ? 29.667 + 0.2887 : p.z());
        }));
    };
    CHECK(label_flat_caps(tip(6)).patches.size() == 2);
    CHECK(label_flat_caps(tip(24)).patches.size() == 3);
}

SCENARIO("Caps of a vessel with open ends are kept", "[geometry][openings]") {
    const Surface closed = capped_tube(0.3, 0.0);
    std::vector<bool> wall;
    for (const Triangle& t : closed.triangles())
        wall.push_back(
            std::ranges::any_of(t, [&](VertexId v) { return closed.points()[v].z() > 0.1; }));
    const Surface found = label_flat_caps(select_triangles(closed, wall));
    REQUIRE(found.patches.size() == 2);
    const OpeningPlan plan = plan_openings(found, *centerlines_of(found, {}, {}));
    REQUIRE(plan.openings.size() == 2);
    CHECK(std::ranges::count(plan.openings, OpeningWay::KeepCap, &PlannedOpening::way) == 1);
    CHECK(std::ranges::count(plan.openings, OpeningWay::CapRim, &PlannedOpening::way) == 1);
}

SCENARIO("The caps of a short piece of a vessel are found", "[geometry][openings]") {
    CHECK(label_flat_caps(unlabelled(closed_tube(2.0, 4.0, 40, 12))).patches.size() == 3);
}

SCENARIO("The mouth of a chamber beside a vessel is found, flat or dented",
         "[geometry][openings]") {
    // In a mouth of radius 6.5, the wall turns by 33 degrees only from the plane of its rim.
    for (const double mouth : {4.8, 6.5})
        for (const double dent : {0.0, 0.1, 0.2, 0.4}) {
            CAPTURE(mouth, dent);
            const Surface found = label_flat_caps(unlabelled(chamber(mouth, dent)));
            REQUIRE(found.patches.size() == 3);
            const OpeningPlan plan = plan_openings(found, *centerlines_of(found, {}, {}));
            CHECK(std::ranges::count(plan.openings, OpeningWay::KeepCap, &PlannedOpening::way) ==
                  2);
        }
}

SCENARIO("What closes no vessel is no cap", "[geometry][openings]") {
    const auto caps_of = [](const Surface& surface) {
        return label_flat_caps(unlabelled(surface)).patches.size() - 1;
    };
    CHECK(caps_of(icosphere(5.0, 4)) == 0);
    CHECK(caps_of(cube(5.0)) == 0);
    CHECK(caps_of(open_tube(2.0, 30.0, 40, 90)) == 0);
    CHECK(caps_of(capped_tube(0.0, 1.2)) == 0);  // a cone of 31 degrees
    CHECK(caps_of(rounded_caps(24, 0.7)) == 0);
    CHECK(caps_of(mapped(capped_tube(0.0, 0.6), [](const Vec3& p) {  // its rims are not flat
              return Vec3(p.x(), p.y(), p.z() + 0.1 * p.x() * p.x());
          })) == 0);
}

SCENARIO("A step of a voxel mask is no cap", "[geometry][openings]") {
    const Eigen::AlignedBox3d box(Vec3(-7, -7, -15), Vec3(7, 7, 15));
    for (const Vec3& way : {Vec3(0, 0, 10), Vec3(0, 3, 9), Vec3(3, 2, 9)}) {
        CAPTURE(way.transpose());
        const Surface mask =
            masked([&](const Vec3& p) { return capsule(p, -way, way, 2.2); }, box, 0.5);
        REQUIRE(is_closed_manifold(mask));
        CHECK(label_flat_caps(mask).patches.size() == 1);
    }
}

SCENARIO("Capped models without labels keep their ends", "[geometry][openings][data]") {
    for (const auto& [name, caps] :
         {std::pair("surfaces/jk_carotid_left_lumen_capped.stl", 3),
          std::pair("surfaces/vasp_small_aneurysm_fluidboundary.vtp", 3)}) {
        CAPTURE(name);
        const std::string file = shared_data(name);
        if (file.empty()) return;
        const Surface found = label_flat_caps(repair(read_surface(file).surface).surface);
        REQUIRE(found.patches.size() == static_cast<std::size_t>(caps) + 1);
        const OpeningPlan plan = plan_openings(found, *centerlines_of(found, {}, {}));
        CHECK(std::ranges::count(plan.openings, OpeningWay::KeepCap, &PlannedOpening::way) == caps);
    }
}
