#include "meshing/stamp/stamp.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include <catch2/catch.hpp>

#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/measure.h"
#include "geometry/kernel/self_intersections.h"
#include "meshing/stamp/contact.h"
#include "tests/support/shapes.h"
#include "tests/support/touching_vessels.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

using Box = Eigen::AlignedBox3d;

constexpr double kVessel = kTouchingRadius, kBridge = kTouchingBridge;

Surface torus() {
    return solid_of(
        [](const Vec3& p) {
            const double ring = std::hypot(p.x(), p.y()) - 8.0;
            return std::hypot(ring, p.z()) - 2.0;
        },
        Box(Vec3(-11, -11, -3), Vec3(11, 11, 3)), 0.35);
}

struct ByPlace {
    bool operator()(const Vec3& a, const Vec3& b) const {
        return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
    }
};

/// Closed, manifold, oriented, free of crossings; what is beyond the influence keeps its bits.
void check_sound(const Surface& before, const Stamped& after, const ToolBody& tool) {
    const Connectivity parts = connectivity(*after.surface.topology);
    CHECK(parts.closed);
    CHECK(parts.manifold);
    CHECK(parts.oriented);
    CHECK(self_intersections(after.surface).empty());
    const std::set<Vec3, ByPlace> places(after.surface.points().begin(),
                                         after.surface.points().end());
    const SurfaceDistance body(tool.surface);
    CHECK(std::ranges::none_of(before.points(), [&](const Vec3& p) {
        return body.signed_distance(p) > after.report.influence && !places.contains(p);
    }));
}

Stamped stamped(const Surface& surface, const ToolBody& tool, StampMode mode, double blend) {
    const Stamped after =
        stamp(surface, SurfaceDistance(surface), tool, {.mode = mode, .blend = blend});
    check_sound(surface, after, tool);
    return after;
}

/// The code with which a stamp is refused; empty: it is not.
std::string refusal(const Surface& surface, const ToolBody& tool, StampMode mode) {
    try {
        static_cast<void>(stamp(surface, SurfaceDistance(surface), tool, {.mode = mode}));
    } catch (const DiagnosedFailure& failure) {
        CHECK(failure.diagnostics().front().place.has_value());
        return failure.diagnostics().front().code;
    }
    return "";
}

}  // namespace

SCENARIO("A tool's body is closed, outward, and as large as asked", "[meshing][stamp]") {
    const ToolBody box = box_body(
        {.direction = {1, 1, 0}, .along = {0, 0, 1}, .thickness = 1, .length = 4, .width = 3});
    CHECK(volume(box.surface) == Approx(12.0));
    CHECK(box.thickness == 1.0);
    const ToolBody capsule = capsule_body({.direction = {0, 1, 2}, .length = 3, .radius = 2});
    CHECK(volume(capsule.surface) ==
          Approx(std::numbers::pi * (4.0 * 3.0 + 4.0 / 3.0 * 8.0)).epsilon(0.04));
    CHECK(volume(capsule_body({.length = 0, .radius = 2}).surface) ==
          Approx(4.0 / 3.0 * std::numbers::pi * 8.0).epsilon(0.04));
    const Positions path = {{0, 0, 0}, {5, 0, 0}, {5, 5, 0}};
    const ToolBody swept = swept_body({.path = path, .sides = 4, .radius = 1});
    CHECK(volume(swept.surface) == Approx(2.0 * 10.0));
    for (const ToolBody* body : {&box, &capsule, &swept}) {
        CHECK(connectivity(*body->surface.topology).closed);
        CHECK(connectivity(*body->surface.topology).oriented);
        CHECK(self_intersections(body->surface).empty());
    }
}

SCENARIO("A tool without extent, direction or way is refused", "[meshing][stamp]") {
    CHECK_THROWS_WITH(box_body({.thickness = 0}), Catch::Contains("thickness"));
    CHECK_THROWS_WITH(box_body({.direction = Vec3::Zero()}), Catch::Contains("direction"));
    CHECK_THROWS_WITH(box_body({.direction = Vec3::UnitX()}), Catch::Contains("parallel"));
    CHECK_THROWS_WITH(capsule_body({.radius = -1}), Catch::Contains("radius"));
    const Positions point = {{0, 0, 0}}, back = {{0, 0, 0}, {5, 0, 0}, {0, 0.1, 0}},
                    tight = {{0, 0, 0}, {5, 0, 0}, {5, 1, 0}, {0, 1, 0}};
    CHECK_THROWS_WITH(swept_body({.path = point}), Catch::Contains("two points"));
    CHECK_THROWS_WITH(swept_body({.path = back}), Catch::Contains("turns back"));
    CHECK_THROWS_WITH(swept_body({.path = tight, .radius = 2}), Catch::Contains("tightly"));
    CHECK_THROWS_WITH(swept_body({.path = tight, .sides = 2}), Catch::Contains("sides"));
}

SCENARIO("The plane and the waist of a contact are found from its wall", "[meshing][stamp]") {
    const Surface surface = touching_vessels();
    const SurfaceDistance places(surface);
    for (const double angle : {0.3, 1.9, 4.4}) {
        const Vec3 at(kBridge * std::cos(angle), kBridge * std::sin(angle), 0.1);
        const auto contact = contact_at(surface, places, at);
        REQUIRE(contact);
        CHECK(contact->direction.z() > 0.99);
        CHECK(contact->centre.norm() < 0.3);
        CHECK(contact->area == Approx(std::numbers::pi * kBridge * kBridge).epsilon(0.1));
        CHECK(contact->length == Approx(2.0 * kBridge).epsilon(0.1));
        CHECK(contact->width == Approx(2.0 * kBridge).epsilon(0.1));
    }
    CHECK_FALSE(contact_at(surface, places, Vec3(6, 0, -4.5)));
    CHECK_FALSE(contact_at(icosphere(5, 3), SurfaceDistance(icosphere(5, 3)), Vec3(0, 0, 5)));
}

SCENARIO("A slab separates two vessels that touch", "[meshing][stamp]") {
    const Surface before = touching_vessels();
    for (const double blend : {0.0, 0.3, 1.0}) {
        CAPTURE(blend);
        const ToolBody slab = box_body({.thickness = 0.6, .length = 2.6, .width = 2.6});
        const Stamped after = stamped(before, slab, StampMode::Subtract, blend);
        CHECK(after.report.components_before == 1);
        CHECK(after.report.components_after == 2);
        CHECK(after.report.genus_after == 0);
        CHECK(after.report.volume_change < 0.0);
        for (const Vec3& p : after.surface.points())  // the gap is as wide as asked
            if (std::hypot(p.x(), p.y()) < 1.2) CHECK(std::abs(p.z()) > 0.3 - 1e-6);
    }
}

SCENARIO("A ring that is cut once has no handle left", "[meshing][stamp]") {
    const Surface before = torus();
    REQUIRE(connectivity(*before.topology).genus == 1);
    const ToolBody slab = box_body(
        {.centre = {8, 0, 0}, .direction = {0, 1, 0}, .thickness = 1, .length = 6, .width = 6});
    const Stamped after = stamped(before, slab, StampMode::Subtract, 0.4);
    CHECK(after.report.genus_before == 1);
    CHECK(after.report.genus_after == 0);
    CHECK(after.report.components_after == 1);
}

SCENARIO("A bump is stamped off a vessel", "[meshing][stamp]") {
    const auto tube = [](const Vec3& p) { return capsule(p, {-8, 0, 0}, {8, 0, 0}, kVessel); };
    const Box box(Vec3(-11, -4, -4), Vec3(11, 4, 5));
    const Surface smooth = solid_of(tube, box, 0.3);
    const Surface bumpy = solid_of(
        [&](const Vec3& p) { return std::min(tube(p), (p - Vec3(1, 0, 2.2)).norm() - 1.0); }, box,
        0.3);
    const ToolBody plane =
        box_body({.centre = {1, 0, 3.0}, .thickness = 2.0, .length = 3.0, .width = 2.6});
    const Stamped after = stamped(bumpy, plane, StampMode::Subtract, 0.3);
    const double bump = volume(bumpy) - volume(smooth);
    CHECK(-after.report.volume_change == Approx(bump).epsilon(0.15));
    CHECK(after.report.components_after == 1);
}

SCENARIO("A capsule is added to a vessel and faired into it", "[meshing][stamp]") {
    const Surface before = fine_tube(2.0, 20.0, 36);
    const ToolBody capsule =
        capsule_body({.centre = {2, 0, 10}, .direction = {1, 0, 0}, .length = 3, .radius = 0.8});
    const double sharp = stamped(before, capsule, StampMode::Add, 0.0).report.volume_change;
    const Stamped after = stamped(before, capsule, StampMode::Add, 0.6);
    CHECK(sharp ==
          Approx(std::numbers::pi * 0.64 * 1.6 + 2.0 / 3 * std::numbers::pi * 0.512).epsilon(0.15));
    CHECK(after.report.volume_change > sharp);  // the fillet
    CHECK(after.report.genus_after == 0);
    CHECK(after.surface.patches == before.patches);
    for (const Vec3& p : after.surface.points())
        CHECK(SurfaceDistance(capsule.surface).signed_distance(p) > -1e-6);
}

SCENARIO("A stamp that cannot do its whole job is refused, with its place", "[meshing][stamp]") {
    const Surface tube = fine_tube(2.0, 20.0, 24);
    const auto box_at = [](const Vec3& centre, double size) {
        return box_body({.centre = centre, .thickness = size, .length = size, .width = size});
    };
    CHECK(refusal(tube, box_at({9, 0, 10}, 1.0), StampMode::Subtract) == "stamp-touches-nothing");
    CHECK(refusal(tube, box_at({0, 0, 10}, 1.0), StampMode::Subtract) == "stamp-touches-nothing");
    CHECK(refusal(tube, box_at({0, 0, 10}, 60.0), StampMode::Subtract) == "stamp-cuts-opening");
    CHECK(refusal(tube, box_at({0, 0, 20}, 1.0), StampMode::Subtract) == "stamp-cuts-opening");
    CHECK(refusal(icosphere(2.0, 3), box_at({0, 0, 0}, 8.0), StampMode::Subtract) ==
          "stamp-swallows");
    CHECK(refusal(icosphere(2.0, 3), box_at({0, 0, 1}, 4.5), StampMode::Subtract) ==
          "stamp-swallows");
    CHECK(refusal(tube,
                  box_body({.centre = {2, 0, 10}, .thickness = 0.05, .length = 1, .width = 1}),
                  StampMode::Subtract) == "stamp-too-thin");
}
