#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>

#include "geometry/kernel/cross_section.h"
#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/measure.h"
#include "geometry/kernel/self_intersections.h"
#include "geometry/vessel/centerlines/centerlines.h"
#include "geometry/vessel/posing/deform_branch.h"
#include "geometry/vessel/posing/part_branches.h"
#include "tests/support/posing_phantoms.h"
#include "tests/support/shapes.h"
#include "tests/support/surface_facts.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

constexpr double kRadius = 2.0;  // mm

/// A tube along z with an inlet at z = 0 and an outlet at z = 60.
Surface tube() {
    return fine_tube(kRadius, 60.0, 24);
}

/// A quarter of a ring of 30 mm radius, from the x axis to the y axis.
Surface quarter_ring() {
    return mapped(fine_tube(kRadius, 15.0 * M_PI, 24), [](const Vec3& p) {
        const double angle = p.z() / 30.0, far = 30.0 - p.x();
        return Vec3(far * std::cos(angle), far * std::sin(angle), p.y());
    });
}

DeformedBranch deformed(const Surface& surface, const BranchDeformation& deformation) {
    return deform_branch(surface, *centerlines_of(surface), deformation);
}

double equal_radius(const Surface& surface, const Positions& axis, std::size_t i) {
    const auto curve =
        cross_section_at(surface, {axis[i], (axis[i + 1] - axis[i - 1]).normalized()});
    REQUIRE(curve);
    return std::sqrt(std::abs(curve->area) / M_PI);
}

void check_sections(const Surface& before, const Surface& after, const BentAxis& axis) {
    for (std::size_t i = 3; i + 3 < axis.rest.size(); i += 4)
        CHECK(equal_radius(after, axis.bent, i) ==
              Approx(equal_radius(before, axis.rest, i)).epsilon(0.01));
}

/// The caps are as flat as they were; those of phantoms are samples of a field, and not quite flat.
void check_flat_caps(const Surface& before, const Surface& after) {
    const auto were = measure_patches(before), are = measure_patches(after);
    REQUIRE(are.size() == were.size());
    for (std::size_t i = 0; i < are.size(); ++i)
        if (are[i].kind != PatchKind::Wall)
            CHECK(are[i].flatness == Approx(were[i].flatness).margin(1e-5));
}

std::string refusal(const Surface& surface, const BranchDeformation& deformation) {
    try {
        (void)deformed(surface, deformation);
    } catch (const DiagnosedFailure& failure) {
        CHECK(failure.diagnostics().front().place);
        return failure.diagnostics().front().code;
    }
    return "done";
}

}  // namespace

SCENARIO("A place of a branch is moved and carries what lies beyond it", "[geometry][posing]") {
    const Surface before = tube();
    const DeformedBranch result =
        deformed(before, {.at = {0, 0, 40}, .move = {3.0, 0, 0}, .reach = 15.0});
    const Surface& after = result.surface;
    CHECK((result.to - result.from).x() == Approx(3.0).margin(0.01));
    CHECK(result.to.z() < result.from.z());  // vessels keep their length
    CHECK(result.volume_after == Approx(result.volume_before).epsilon(0.001));
    check_sections(before, after, result.axis);
    check_flat_caps(before, after);
    CHECK(after.patch_labels == before.patch_labels);
    CHECK(is_closed_manifold(after));
    CHECK(self_intersections(after).empty());
    std::size_t carried = 0;
    for (std::size_t v = 0; v < before.vertex_count(); ++v) {
        const bool beyond = before.points()[v].z() < 40.0 - 15.0;
        if (beyond) CHECK(after.points()[v] == before.points()[v]);
        carried += after.points()[v] != before.points()[v];
    }
    CHECK(carried == result.moved_vertices);
}

SCENARIO("The end of a branch follows rigidly", "[geometry][posing]") {
    const Surface before = tube();
    const Surface after =
        deformed(before, {.at = {0, 0, 30}, .move = {0, 2.5, 0}, .reach = 12.0}).surface;
    std::vector<std::size_t> end;
    for (std::size_t v = 0; v < before.vertex_count(); ++v)
        if (before.points()[v].z() > 44.0) end.push_back(v);
    for (const std::size_t v : end)
        CHECK((after.points()[v] - after.points()[end[0]]).norm() ==
              Approx((before.points()[v] - before.points()[end[0]]).norm()).margin(1e-9));
}

SCENARIO("A free end that is near moves along and keeps its direction", "[geometry][posing]") {
    const Surface after =
        deformed(tube(), {.at = {0, 0, 54}, .move = {2.0, 0, 0}, .reach = 15.0}).surface;
    const auto patches = measure_patches(after);
    const auto outlet = std::ranges::find(patches, PatchKind::Outlet, &PatchMeasures::kind);
    REQUIRE(outlet != patches.end());
    CHECK(outlet->centroid.x() == Approx(2.0).margin(0.6));
    CHECK(std::abs(outlet->normal.x()) < 0.15);
}

SCENARIO("A bend is straightened", "[geometry][posing]") {
    const Surface before = quarter_ring();
    const DeformedBranch result =
        deformed(before, {.at = Vec3(21.2, 21.2, 0), .straighten = 1.0, .reach = 40.0});
    const auto chord = [](const Positions& line) { return (line.back() - line.front()).norm(); };
    double length = 0.0;
    for (std::size_t i = 1; i < result.axis.rest.size(); ++i)
        length += (result.axis.rest[i] - result.axis.rest[i - 1]).norm();
    CHECK(chord(result.axis.rest) < 0.95 * length);
    CHECK(chord(result.axis.bent) > 0.995 * length);
    CHECK(result.volume_after == Approx(result.volume_before).epsilon(0.002));
    check_sections(before, result.surface, result.axis);
    check_flat_caps(before, result.surface);
}

SCENARIO("Half of a bend is left", "[geometry][posing]") {
    const BranchDeformation half{.at = Vec3(21.2, 21.2, 0), .straighten = 0.5, .reach = 40.0};
    const DeformedBranch result = deformed(quarter_ring(), half);
    const auto turn = [](const Positions& line) {
        const Vec3 first = line[5] - line[0], last = line.back() - line[line.size() - 6];
        return std::atan2(first.cross(last).norm(), first.dot(last));
    };
    CHECK(turn(result.axis.bent) == Approx(0.5 * turn(result.axis.rest)).epsilon(0.1));
}

SCENARIO("What cannot be posed is refused with its place", "[geometry][posing]") {
    CHECK(refusal(tube(), {.at = {0, 0, 40}, .move = {4.0, 0, 0}, .reach = 6.0}) ==
          "move-not-reached");
    CHECK(refusal(tube(), {.at = {30, 0, 40}, .move = {1.0, 0, 0}}) == "no-branch-here");
    CHECK(refusal(tube(), {.at = {0, 0, 1}, .move = {1.0, 0, 0}}) == "place-is-rigid");
    CHECK(refusal(fine_tube(2.0, 4.0, 24), {.at = {0, 0, 2}, .move = {0.5, 0, 0}}) ==
          "branch-too-short-to-bend");
    const PosingPhantom loop = deform_phantom(3);
    REQUIRE(loop.kind == "loop");
    CHECK(refusal(loop.surface, {.at = loop.at, .move = loop.move}) == "branch-in-loop");
    CHECK(deformed(tube(), {.at = {0, 0, 40}}).surface.points() == tube().points());
    CHECK_THROWS_AS(deformed(tube(), {.at = {0, 0, 40}, .straighten = 1.5}), InvalidInput);
    CHECK_THROWS_AS(deformed(tube(), {.at = {0, 0, 40}, .straighten = 0.5, .reach = -1.0}),
                    InvalidInput);
}

SCENARIO("Branches are pushed apart until the gap is reached", "[geometry][posing]") {
    const PosingPhantom phantom = gap_phantom(8);
    const PartedBranches result =
        part_branches(phantom.surface, *centerlines_of(phantom.surface), 1.0);
    REQUIRE(!result.gaps.empty());
    CHECK(result.gaps.front().before < 1.0);
    CHECK(result.gaps.front().after >= 1.0);
    CHECK(result.smallest_after >= 1.0);
    REQUIRE(!result.shifts.empty());
    CHECK(result.shifts.front().largest < 1.0);
    CHECK(result.volume_after == Approx(result.volume_before).epsilon(0.001));
    CHECK(self_intersections(result.surface).empty());
    check_flat_caps(phantom.surface, result.surface);
    for (const BentAxis& axis : result.axes) check_sections(phantom.surface, result.surface, axis);
}

SCENARIO("Branches that are apart stay where they are", "[geometry][posing]") {
    const PosingPhantom phantom = gap_phantom(8);
    const PartedBranches result =
        part_branches(phantom.surface, *centerlines_of(phantom.surface), 0.3);
    CHECK(result.gaps.empty());
    CHECK(result.shifts.empty());
    CHECK(result.surface.points() == phantom.surface.points());
}

SCENARIO("Branches that join again cannot be parted", "[geometry][posing]") {
    const PosingPhantom phantom = gap_phantom(3);
    REQUIRE(phantom.kind == "loop");
    try {
        (void)part_branches(phantom.surface, *centerlines_of(phantom.surface), 1.0);
        FAIL("parted");
    } catch (const DiagnosedFailure& failure) {
        CHECK(failure.diagnostics().front().code == "gap-not-reached");
        CHECK(failure.diagnostics().front().place);
    }
}
