#include "geometry/vessel/openings/remove_branch.h"

#include <cmath>
#include <functional>

#include <catch2/catch.hpp>

#include "geometry/formats/surface_file.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/measure.h"
#include "geometry/kernel/surface_distance.h"
#include "geometry/phantoms/exact_surface.h"
#include "geometry/vessel/centerlines/branch_queries.h"
#include "geometry/vessel/centerlines/centerlines.h"
#include "geometry/vessel/ends/surface_ends.h"
#include "geometry/vessel/openings/branch_part.h"
#include "geometry/vessel/openings/clip.h"
#include "geometry/vessel/openings/clip_openings.h"
#include "geometry/vessel/openings/lost_vessels.h"
#include "geometry/vessel/openings/opening_axis.h"
#include "geometry/vessel/openings/openings.h"
#include "geometry/vessel/repair/repair.h"
#include "tests/support/iso_surface.h"
#include "tests/support/shapes.h"
#include "tests/support/surface_facts.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

/// A vessel along z from 0 to 40 and a branch from its axis at z = 20; closed by flat ends.
Surface branched(const Vec3& tip, double parent, double branch, double fillet) {
    const std::vector<PhantomPart> parts = {
        {.name = "parent",
         .shape = VesselShape{.points = {Vec3(0, 0, 0), Vec3(0, 0, 20), Vec3(0, 0, 40)},
                              .radii = {parent, parent, parent},
                              .flat_ends = true}},
        {.name = "branch",
         .shape =
             VesselShape{
                 .points = {Vec3(0, 0, 20), tip}, .radii = {branch, branch}, .flat_ends = true},
         .blend = fillet}};
    const PhantomField field(parts);
    return repair(exact_surface(field, field.bounds(), 0.25 * branch)).surface;
}

/// Largest and mean distance of the wall from the unbranched tube, away from its ends, [radii].
struct Deviation {
    double largest = 0.0, mean = 0.0;
};

Deviation from_tube(const Surface& surface, double radius) {
    Deviation result;
    double count = 0.0;
    for (const Vec3& p : surface.points()) {
        if (p.z() < 4.0 || p.z() > 36.0) continue;
        const double off = std::abs(std::hypot(p.x(), p.y()) - radius) / radius;
        result.largest = std::max(result.largest, off);
        result.mean += off;
        count += 1.0;
    }
    result.mean /= count;
    return result;
}

BranchRemoval removed_at(const Surface& surface, const Vec3& tip) {
    const auto graph = compute_centerlines(surface);
    return remove_branch(surface, graph, nearest_tip(graph, tip).value());
}

}  // namespace

SCENARIO("A side branch is removed without a trace", "[geometry][remove-branch]") {
    struct Case {
        const char* name;
        Vec3 tip;
        double parent, branch, fillet;
    };

    const auto c = GENERATE(Case{"T", Vec3(16, 0, 20), 3.0, 1.5, 0.0},
                            Case{"T with a fillet", Vec3(16, 0, 20), 3.0, 1.5, 1.0},
                            Case{"slanted", Vec3(12, 0, 32), 3.0, 1.5, 0.5},
                            Case{"wide", Vec3(0, 16, 20), 3.0, 2.4, 0.5});
    INFO(c.name);
    const Surface surface = branched(c.tip, c.parent, c.branch, c.fillet);
    const BranchRemoval removal = removed_at(surface, c.tip);
    const Deviation off = from_tube(removal.surface, c.parent);
    INFO("largest " << off.largest << " mean " << off.mean);
    CHECK(is_closed_manifold(removal.surface));
    CHECK(removal.follows_parent);
    CHECK(off.largest < 0.02);
    CHECK(off.mean < 0.001);
}

SCENARIO("A vessel without a parent is not removed", "[geometry][remove-branch]") {
    const Surface tube = open_tube(2.0, 30.0, 40, 90);
    CHECK_THROWS_WITH(removed_at(tube, Vec3(0, 0, 30)), Catch::Contains("no parent"));
}

SCENARIO("The sac of the ideal bifurcation is removed", "[geometry][remove-branch]") {
    const auto sick = shared_data("surfaces/v4a_ideal_bifurcation_aneurysm.stl");
    const auto sound = shared_data("surfaces/v4a_ideal_bifurcation_healthy.stl");
    if (sick.empty() || sound.empty()) return;
    const Surface surface = read_surface(sick).surface;
    const Surface healthy = read_surface(sound).surface;
    const SurfaceDistance truth(healthy);
    Vec3 dome = Vec3::Zero();
    double farthest = 0.0;
    for (const Vec3& p : surface.points())
        if (const double d = truth.closest_point(p).distance; d > farthest) {
            farthest = d;
            dome = p;
        }
    const auto graph = compute_centerlines(surface, {.ends = {dome}});
    const auto removal = remove_branch(surface, graph, nearest_tip(graph, dome).value());
    double largest = 0.0;
    for (const Vec3& p : removal.surface.points())
        largest = std::max(largest, truth.closest_point(p).distance);
    INFO("dome " << farthest << " mm, left " << largest << " mm");
    CHECK(removal.surface.topology->boundary_loops().size() == 3);
    CHECK(farthest > 3.0);
    CHECK(largest < 0.2);
}

SCENARIO("A branch is named by a point at its tip", "[geometry][remove-branch]") {
    const Vec3 tip(16, 0, 20);
    const Surface surface = branched(tip, 3.0, 1.5, 0.5);
    const NamedBranch branch = branch_at_tip(surface, tip + Vec3(0.5, 0.5, 0));
    CHECK((branch.graph->nodes[branch.tip].position - tip).norm() < 1.5);
    THEN("its part is what its removal cuts off") {
        const Surface part = branch_part(surface, tip, 0.4);
        const BranchRemoval removal =
            remove_branch(surface, *branch.graph, branch.tip, {.margin = 0.4});
        CHECK(measure(part).area == Approx(removal.removed_area));
        CHECK(bounds(part).min.x() > -3.0);
        CHECK(bounds(part).max.x() > 15.0);
    }
    THEN("a point that is far from the vessels names none") {
        CHECK_THROWS(branch_at_tip(surface, Vec3(40, 0, 20)));
        CHECK_THROWS(branch_part(surface, Vec3(40, 0, 20), 0.4));
    }
    THEN("a vessel without a parent has no part") {
        CHECK_THROWS_WITH(branch_part(fine_tube(4, 30, 24), Vec3(0, 0, 30), 0.4),
                          Catch::Contains("no parent"));
    }
}

SCENARIO("A vessel that a later surface has no longer is found", "[geometry][openings]") {
    const Surface with_branch = branched(Vec3(16, 0, 20), 2.0, 1.0, 0.3);
    const auto graph = centerlines_of(with_branch);
    const auto node = nearest_tip(*graph, Vec3(16, 0, 20));
    REQUIRE(node);
    THEN("one is, with its place, if the branch is removed") {
        const auto lost = lost_vessels(*graph, remove_branch(with_branch, *graph, *node).surface);
        REQUIRE(lost.size() == 1);
        CHECK(lost[0].length == Approx(13.5).margin(1.5));
        CHECK(lost[0].diameter == Approx(2.0).epsilon(0.1));
        CHECK((lost[0].place - Vec3(9, 0, 20)).norm() < 1.5);
    }
    THEN("none is if the ends are cut") {
        const OpeningPlan plan = plan_openings(with_branch, *graph);
        const Surface opened = clip_openings(with_branch, plan, {}, graph.get()).surface;
        CHECK(lost_vessels(*graph, opened).empty());
        CHECK(openings_in_walls(with_branch, opened).empty());
    }
}

SCENARIO("A lost subtree is found, though each of its branches is short", "[geometry][openings]") {
    // A branch 2.5 diameters long beyond its parent's wall, and two of as many behind its end.
    const auto tree = [](const Vec3& p) {
        return std::min({capsule(p, Vec3(0, 0, -20), Vec3(0, 0, 20), 2.0),
                         capsule(p, Vec3::Zero(), Vec3(7, 0, 0), 1.0),
                         capsule(p, Vec3(7, 0, 0), Vec3(10, 0, 4), 1.0),
                         capsule(p, Vec3(7, 0, 0), Vec3(10, 0, -4), 1.0)});
    };
    const Surface whole =
        repair(iso_surface(tree, {Vec3(-4, -4, -24), Vec3(13, 4, 24)}, 0.4)).surface;
    const Surface rest = mapped(closed_tube(2.0, 44.0, 40, 90),
                                [](const Vec3& p) { return Vec3(p - Vec3(0, 0, 22)); });
    const auto line = [](std::size_t from, std::size_t to, const Vec3& a, const Vec3& b) {
        CenterlineBranch branch{.start_node = from, .end_node = to, .points = {}, .radii = {}};
        for (int i = 0; i <= 20; ++i) {
            branch.points.emplace_back(a + i / 20.0 * (b - a));
            branch.radii.push_back(a.x() == 0.0 && b.x() == 0.0 ? 2.0 : 1.0);
        }
        return branch;
    };
    const Vec3 root = Vec3::Zero(), fork(7, 0, 0), up(10, 0, 4), down(10, 0, -4), top(0, 0, 20);
    const CenterlineGraph graph = {
        .nodes = {{root, 2.0, {0, 1, 4}},
                  {fork, 1.0, {1, 2, 3}},
                  {up, 1.0, {2}},
                  {down, 1.0, {3}},
                  {top, 2.0, {0}},
                  {-top, 2.0, {4}}},
        .branches = {line(0, 4, root, top), line(0, 1, root, fork), line(1, 2, fork, up),
                     line(1, 3, fork, down), line(0, 5, root, -top)}};
    REQUIRE(lost_vessels(graph, whole).empty());
    const auto lost = lost_vessels(graph, rest);
    REQUIRE(lost.size() == 1);
    CHECK(lost[0].length == Approx(9.7).margin(0.5));
    CHECK(lost[0].diameter == Approx(2.0));
    CHECK(lost[0].root.x() == Approx(2.3).margin(0.4));
    CHECK(lost[0].tip.x() == Approx(10.0));
    THEN("not if it was taken away as asked") {
        CHECK(lost_vessels(graph, rest, std::vector<Removal>{{whole, rest}}).empty());
        CHECK(lost_vessels(graph, rest, std::vector<Removal>{{rest, rest}}).size() == 1);
    }
}

SCENARIO("The trunk is not removed", "[geometry][remove-branch]") {
    const auto fork = [](const Vec3& p) {
        return std::min({capsule(p, Vec3(0, 0, -18), Vec3::Zero(), 2.5),
                         capsule(p, Vec3::Zero(), Vec3(8, 0, 16), 1.8),
                         capsule(p, Vec3::Zero(), Vec3(-8, 0, 16), 1.8)});
    };
    const Surface surface =
        repair(iso_surface(fork, {Vec3(-12, -5, -22), Vec3(12, 5, 20)}, 0.5)).surface;
    CHECK_THROWS_WITH(removed_at(surface, Vec3(0, 0, -18)),
                      Catch::Contains("is the trunk") && Catch::Contains("clip-opening tip="));
    const auto graph = compute_centerlines(surface);
    CHECK_FALSE(is_trunk(graph, nearest_tip(graph, Vec3(8, 0, 16)).value()));
}

SCENARIO("An opening in a vessel's side is found", "[geometry][openings]") {
    const Surface tube = closed_tube(2.0, 30.0, 40, 90);
    PatchLabels labels = *tube.patch_labels;
    for (TriangleId t = 0; t < tube.triangle_count(); ++t) {
        const Triangle& c = tube.triangles()[t];
        const Vec3 middle = (tube.points()[c[0]] + tube.points()[c[1]] + tube.points()[c[2]]) / 3.0;
        if ((middle - Vec3(2, 0, 15)).norm() < 1.0)
            labels[t] = static_cast<std::uint16_t>(tube.patches.size());
    }
    std::vector<Patch> patches = tube.patches;
    patches.push_back({"outlet_2", PatchKind::Outlet});
    const Surface opened = tube.with_patches(labels, patches);
    CHECK(openings_in_walls(tube, opened) == std::vector<std::size_t>{patches.size() - 1});
    CHECK(openings_in_walls(opened, opened).empty());
}

namespace {

/// The triangles whose middle is kept.
Surface without(const Surface& surface, const std::function<bool(const Vec3&)>& gone) {
    std::vector<Triangle> kept;
    for (const Triangle& t : surface.triangles()) {
        const Positions& x = surface.points();
        if (!gone((x[t[0]] + x[t[1]] + x[t[2]]) / 3.0)) kept.push_back(t);
    }
    return repair(make_surface(surface.points(), kept)).surface;
}

std::string told(const OpeningPlan& plan) {
    std::string text;
    for (const EndRecord& end : plan.ends)
        text += to_string(end.fate) + " " + std::to_string(end.place.x()) + " " +
                std::to_string(end.place.z()) + " " + end.why + "\n";
    return text;
}

}  // namespace

SCENARIO("A stub without a whole section is removed", "[geometry][openings]") {
    const Surface with_stub = without(branched(Vec3(6, 0, 20), 2.0, 0.7, 0.3), [](const Vec3& p) {
        return p.x() > 2.45 + 0.35 * std::sin(2.0 * std::atan2(p.y(), p.z() - 20.0));
    });
    const auto graph = centerlines_of(with_stub);
    const OpeningPlan plan = plan_openings(with_stub, *graph);
    INFO(told(plan));
    REQUIRE(plan.closings.size() == 1);
    CHECK(plan.closings[0].way == ClosingWay::RemoveStub);
    const auto removed = std::ranges::find(plan.ends, EndFate::Removed, &EndRecord::fate);
    REQUIRE(removed != plan.ends.end());
    CHECK_THAT(removed->why, Catch::Contains("stub"));
    const ClippedSurface made = clip_openings(with_stub, plan, {}, graph.get());
    CHECK(made.failed.empty());
    CHECK(is_closed_manifold(made.surface));
    for (const Vec3& p : made.surface.points()) CHECK(p.x() < 2.4);
    THEN("the plan of a stub that is gone removes no other branch") {
        const OpeningPlan elsewhere{
            .closings = {{plan.closings[0].place + Vec3(9, 0, 0), ClosingWay::RemoveStub}}};
        const Surface kept = clip_openings(with_stub, elsewhere, {}, graph.get()).surface;
        CHECK(kept.triangle_count() == with_stub.triangle_count());
    }
}

SCENARIO("A vessel that ends in its furcation is cut across it", "[geometry][openings]") {
    // Both branches end less than a radius behind the furcation, with ragged rims.
    const Surface ending = without(branched(Vec3(8, 0, 20), 2.0, 1.3, 0.2), [](const Vec3& p) {
        return p.z() > 22.6 + 0.35 * std::sin(3.0 * std::atan2(p.y(), p.x())) ||
               p.x() > 2.9 + 0.35 * std::sin(3.0 * std::atan2(p.y(), p.z() - 20.0));
    });
    REQUIRE(ending.topology->boundary_loops().size() == 2);
    const auto graph = centerlines_of(ending);
    const auto tip = nearest_tip(*graph, Vec3(0, 0, 22.6));
    REQUIRE(tip);
    const auto on_trunk = [](const OpeningPlace& place) { return place.plane.point.z() < 19.5; };
    const auto place = place_across_furcation(ending, *graph, *tip, on_trunk);
    REQUIRE(place);
    CHECK(place->plane.point.z() > 14.0);
    CHECK(angle_deg(place->plane.normal, Vec3::UnitZ()) < 5.0);
    CHECK(place->distance == Approx(22.6 - place->plane.point.z()).margin(1.0));
    const Surface cut = clip_branch(ending, place->plane, {"inlet", PatchKind::Inlet});
    CHECK(cut.topology->boundary_loops().empty());  // both ragged ends are gone
    THEN("no such place is taken where none is accepted") {
        CHECK_FALSE(place_across_furcation(ending, *graph, *tip,
                                           [](const OpeningPlace&) { return false; }));
    }
}
