#include "geometry/vessel/openings/remove_branch.h"

#include <cmath>

#include <catch2/catch.hpp>

#include "geometry/formats/surface_file.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/measure.h"
#include "geometry/kernel/surface_distance.h"
#include "geometry/phantoms/exact_surface.h"
#include "geometry/vessel/centerlines/branch_queries.h"
#include "geometry/vessel/centerlines/centerlines.h"
#include "geometry/vessel/openings/branch_part.h"
#include "geometry/vessel/openings/openings.h"
#include "geometry/vessel/repair/repair.h"
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
