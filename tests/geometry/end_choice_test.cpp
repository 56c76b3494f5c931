#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>

#include "geometry/image/extract_surface.h"
#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/edges.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/measure.h"
#include "geometry/kernel/wording.h"
#include "geometry/phantoms/exact_surface.h"
#include "geometry/phantoms/field.h"
#include "geometry/phantoms/phantom.h"
#include "geometry/vessel/centerlines/branch_queries.h"
#include "geometry/vessel/centerlines/centerlines.h"
#include "geometry/vessel/ends/stub_lines.h"
#include "geometry/vessel/ends/surface_ends.h"
#include "geometry/vessel/openings/clip_openings.h"
#include "geometry/vessel/openings/flat_caps.h"
#include "geometry/vessel/openings/flow_check.h"
#include "geometry/vessel/openings/lost_vessels.h"
#include "geometry/vessel/openings/opening_axis.h"
#include "geometry/vessel/openings/opening_names.h"
#include "geometry/vessel/openings/openings.h"
#include "geometry/vessel/openings/rim_shape.h"
#include "geometry/vessel/repair/repair.h"
#include "tests/support/image_shapes.h"
#include "tests/support/iso_surface.h"
#include "tests/support/shapes.h"
#include "tests/support/stop_at.h"
#include "tests/support/surface_facts.h"

using namespace vesselbench;
using namespace vesselbench::test;
using Catch::Matchers::Contains;

namespace {

constexpr double kRadius = 2.0, kLength = 30.0;

CenterlineGraph line_graph() {
    CenterlineBranch branch{.start_node = 0, .end_node = 1, .points = {}, .radii = {}};
    for (int i = 0; i <= 100; ++i) {
        branch.points.emplace_back(0, 0, kLength * i / 100);
        branch.radii.push_back(kRadius);
    }
    return {.nodes = {{branch.points.front(), kRadius, {0}}, {branch.points.back(), kRadius, {0}}},
            .branches = {branch}};
}

/// A tube whose upper rim is ragged.
Surface ragged_tube() {
    return mapped(open_tube(kRadius, kLength, 40, 90), [](const Vec3& p) {
        const double share = std::max(0.0, (p.z() - 28.0) / 2.0);
        return Vec3(p.x(), p.y(), p.z() + share * std::sin(4.0 * p.x()));
    });
}

/// A vessel of radius 1.6 mm along z whose ends an image's border cuts, and a blind one of radius
/// `root` from its middle to (`reach`, 0, 0), where its radius is `tip`.
Surface blind_trunk(double reach, double root = 2.0, double tip = 2.0) {
    const auto vessel = [&](const Vec3& from, const Vec3& to, bool flat) {
        return VesselShape{.points = {from, to},
                           .radii = {flat ? 1.6 : root, flat ? 1.6 : tip},
                           .flat_ends = flat};
    };
    const std::vector<PhantomPart> parts = {
        {.name = "vessel", .shape = vessel(Vec3(0, 0, -15), Vec3(0, 0, 15), true)},
        {.name = "trunk", .shape = vessel(Vec3(0, 0, 0), Vec3(reach, 0, 0), false), .blend = 0.5}};
    const PhantomField field(parts);
    const Surface closed = exact_surface(field, field.bounds(), 0.3);
    Surface made = clip_openings(closed, plan_openings(closed, *centerlines_of(closed),
                                                       {.closed = {Vec3(reach + 2.0, 0, 0)}}))
                       .surface;
    for (Patch& patch : made.patches)
        if (patch.kind != PatchKind::Wall) patch.kind = PatchKind::Cut;
    return made;
}

/// A vessel of radius 0.9 mm along z, and a branch along x from its middle with these radii every
/// 0.15 mm.
CenterlineGraph with_side_branch(std::vector<double> radii, const Vec3& way = Vec3::UnitX()) {
    constexpr double kVessel = 0.9, kStep = 0.15;
    const auto half = [&](double sign, std::size_t end) {
        CenterlineBranch branch{.start_node = 0, .end_node = end, .points = {}, .radii = {}};
        for (int i = 0; i <= 40; ++i) {
            branch.points.emplace_back(0, 0, sign * kStep * i);
            branch.radii.push_back(kVessel);
        }
        return branch;
    };
    CenterlineBranch side{.start_node = 0, .end_node = 3, .points = {}, .radii = {}};
    for (std::size_t i = 0; i < radii.size(); ++i)
        side.points.push_back(kStep * static_cast<double>(i) * way);
    side.radii = std::move(radii);
    return {.nodes = {{Vec3::Zero(), kVessel, {0, 1, 2}},
                      {Vec3(0, 0, 40 * kStep), kVessel, {0}},
                      {Vec3(0, 0, -40 * kStep), kVessel, {1}},
                      {side.points.back(), side.radii.back(), {2}}},
            .branches = {half(1.0, 1), half(-1.0, 2), side}};
}

VesselShape vessel_along(const Positions& points, double radius, bool flat = false) {
    return {
        .points = points, .radii = std::vector<double>(points.size(), radius), .flat_ends = flat};
}

/// A closed vessel along z with flat ends, and thinner ones that leave it; nothing is labelled.
Surface closed_vessels(double radius, const std::vector<Positions>& branches) {
    std::vector<PhantomPart> parts = {
        {.name = "vessel", .shape = vessel_along({Vec3(0, 0, -15), Vec3(0, 0, 15)}, 1.6, true)}};
    for (const Positions& branch : branches)
        parts.push_back({.name = "branch", .shape = vessel_along(branch, radius), .blend = 0.2});
    const PhantomField field(parts);
    return exact_surface(field, field.bounds(), 0.4 * radius);
}

/// The wall alone: caps become open rims.
Surface without_caps(const Surface& capped) {
    std::vector<bool> wall(capped.triangle_count());
    for (TriangleId t = 0; t < wall.size(); ++t)
        wall[t] = capped.patch_of(t).kind == PatchKind::Wall;
    const Surface open = select_triangles(capped, wall);
    return open.with_patches(PatchLabels(open.triangle_count(), 0), {open.patches[0]});
}

/// The record of the end nearest to a point.
EndRecord end_at(const OpeningPlan& plan, const Vec3& point) {
    return *std::ranges::min_element(
        plan.ends, {}, [&](const EndRecord& record) { return (record.place - point).norm(); });
}

const PlannedOpening& upper(const OpeningPlan& plan) {
    return *std::ranges::find_if(plan.openings,
                                 [](const auto& o) { return o.place.plane.point.z() > 15.0; });
}

}  // namespace

SCENARIO("An end that cannot be cut where it should is cut nearby", "[geometry][openings]") {
    const Surface tube = ragged_tube();
    const OpeningPlan first = plan_openings(tube, line_graph());
    REQUIRE(first.openings.size() == 2);
    CHECK(upper(first).way == OpeningWay::Cut);
    GIVEN("that the chosen place has failed") {
        const OpeningPlace& chosen = upper(first).place;
        const OpeningPlan second =
            plan_openings(tube, line_graph(),
                          {.failed = {{chosen.tip, chosen.plane.point, plain_text("it failed")}}});
        THEN("another place is found, and the record names it first") {
            REQUIRE(second.openings.size() == 2);
            CHECK((upper(second).place.plane.point - chosen.plane.point).norm() > 1e-6);
            CHECK_FALSE(second.ends.front().plain);
            CHECK(second.ends.front().fate == EndFate::Opened);
            CHECK_THAT(second.ends.front().why, Contains("nearest possible place"));
            const ClippedSurface made = clip_openings(tube, second);
            CHECK(made.failed.empty());
            CHECK(is_closed_manifold(made.surface));
        }
        THEN("none farther inside is, if the cut lost a vessel") {
            REQUIRE(second.openings.size() == 2);
            const OpeningPlace& nearer = upper(second).place;
            REQUIRE(nearer.plane.point.z() > chosen.plane.point.z());
            const OpeningPlan third = plan_openings(
                tube, line_graph(),
                {.failed = {{nearer.tip, nearer.plane.point, plain_text("lost"), true}}});
            for (const PlannedOpening& opening : third.openings) {
                const double z = opening.place.plane.point.z();
                CHECK((z < 15.0 || z > nearer.plane.point.z()));
            }
        }
        THEN("strictly, it is a failure") {
            CHECK_THROWS_WITH(
                plan_openings(
                    tube, line_graph(),
                    {.strict = true,
                     .failed = {{chosen.tip, chosen.plane.point, plain_text("it failed")}}}),
                Contains("it failed; closed="));
        }
        THEN("strictly, it is one of a closed end, too") {
            const Surface closed = closed_tube(kRadius, kLength, 40, 90);
            const Surface unlabelled = closed.with_patches(PatchLabels(closed.triangle_count(), 0),
                                                           {{"wall", PatchKind::Wall}});
            const OpeningPlace place =
                upper(plan_openings(unlabelled, line_graph(), {.strict = true})).place;
            CHECK_THROWS_WITH(
                plan_openings(
                    unlabelled, line_graph(),
                    {.strict = true,
                     .failed = {{place.tip, place.plane.point, plain_text("it failed")}}}),
                Contains("it failed; closed="));
        }
    }
    GIVEN("that the end shall stay closed") {
        const OpeningPlan plan = plan_openings(tube, line_graph(), {.closed = {Vec3(0, 0, 30)}});
        CHECK(plan.openings.size() == 1);
        CHECK(plan.ends.front().asked);
        const Surface made = clip_openings(tube, plan).surface;
        CHECK(is_closed_manifold(made));
        CHECK(made.patches.size() == 2);
        CHECK_THAT(why_no_flow(plan), Contains("two openings") && Contains("as asked"));
    }
}

SCENARIO("A torn rim without a whole section is cut along itself", "[geometry][openings]") {
    CenterlineGraph graph = line_graph();  // ends too far from the rim
    graph.branches[0].points.resize(60);
    graph.branches[0].radii.resize(60);
    graph.nodes[1].position = graph.branches[0].points.back();
    const Surface tube = ragged_tube();
    const OpeningPlan plan = plan_openings(tube, graph);
    REQUIRE(plan.openings.size() == 2);
    CHECK(upper(plan).place.plane.point.z() > 27.0);
    CHECK_THAT(end_at(plan, Vec3(0, 0, 30)).why, Contains("along its rim"));
    CHECK(is_closed_manifold(clip_openings(tube, plan).surface));
}

SCENARIO("A trunk cut close to its furcation is an end, not a vessel's side",
         "[geometry][openings]") {
    constexpr double kCut = 2.5;
    const auto branch = [](double x) {
        return VesselShape{.points = {Vec3::Zero(), Vec3(10.0 * x, 0, 17.3)},
                           .radii = {1.5, 1.5},
                           .flat_ends = false};
    };
    const std::vector<PhantomPart> parts = {{.name = "left", .shape = branch(-1.0)},
                                            {.name = "right", .shape = branch(1.0), .blend = 0.2}};
    const PhantomField field(parts);
    const Surface flat =
        mapped(exact_surface(field, field.bounds(), 0.3),
               [&](const Vec3& p) -> Vec3 { return Vec3(p.x(), p.y(), std::max(p.z(), kCut)); });
    std::vector<bool> keep;
    for (const Triangle& t : flat.triangles())
        keep.push_back(
            std::ranges::any_of(t, [&](VertexId v) { return flat.points()[v].z() > kCut; }));
    const Surface open = repair(select_triangles(flat, keep)).surface;
    REQUIRE(open.topology->boundary_loops().size() == 1);
    const OpeningPlan plan = plan_openings(open, *centerlines_of(open));
    CHECK(plan.openings.size() == 3);
    CHECK(end_at(plan, Vec3(0, 0, kCut)).fate == EndFate::Kept);
}

SCENARIO("The widest vessel of an image is opened, though it is short", "[geometry][openings]") {
    const auto end_of_trunk = [](double reach, double root, double tip_radius) {
        const Surface surface = blind_trunk(reach, root, tip_radius);
        const auto graph = centerlines_of(surface);
        const OpeningPlan plan = plan_openings(surface, *graph, {.border_cuts = true});
        const auto end = std::ranges::max_element(
            plan.ends, {}, [](const EndRecord& record) { return record.place.x(); });
        CAPTURE(end->why);
        return end->fate;
    };
    CHECK(end_of_trunk(8.5, 2.0, 2.0) == EndFate::Opened);
    CHECK(end_of_trunk(8.2, 2.2, 1.6) == EndFate::Opened);  // hardly wider at its tip
}

SCENARIO("A cut does not lose a vessel", "[geometry][openings]") {
    // The centerline ends far before its vessel does, which then bends back: from the bend on, the
    // way along the line is longer than what lies beyond the cut is far away.
    const double radius = 1.0, straight = 20.0, bend = 4.0, short_by = 8.0;
    Positions points;
    for (double z = 0.0; z < straight; z += 0.5) points.emplace_back(0, 0, z);
    for (double turn = 0.0; turn < 3.14; turn += 0.1)
        points.emplace_back(bend * (1.0 - std::cos(turn)), 0, straight + bend * std::sin(turn));
    for (double z = straight; z >= 0.0; z -= 0.5) points.emplace_back(2.0 * bend, 0, z);
    const std::vector<PhantomPart> parts = {
        {.name = "vessel", .shape = vessel_along(points, radius)}};
    const PhantomField field(parts);
    const Surface surface = exact_surface(field, field.bounds(), 0.3);
    CenterlineBranch line{.start_node = 0, .end_node = 1, .points = {}, .radii = {}};
    std::ranges::copy_if(points, std::back_inserter(line.points),
                         [&](const Vec3& p) { return p.z() > short_by; });
    line.radii.assign(line.points.size(), radius);
    const CenterlineGraph graph = {
        .nodes = {{line.points.front(), radius, {0}}, {line.points.back(), radius, {0}}},
        .branches = {line}};
    const OpeningPlan plan = plan_openings(surface, graph);
    for (const EndRecord& end : plan.ends) {
        CAPTURE(end.why);
        CHECK(end.fate == EndFate::Closed);
        CHECK_THAT(end.why, Contains("would remove vessels up to"));
    }
}

SCENARIO("A sac whose neck the image has widened is not a vessel's end", "[geometry][openings]") {
    // As seen in an image whose voxels are as large as the sac's radius.
    const std::vector<double> sac = {0.94, 0.90, 0.88, 0.88, 0.86, 0.85, 0.84, 0.80, 0.76, 0.75,
                                     0.76, 0.78, 0.81, 0.86, 0.90, 0.88, 0.80, 0.70, 0.60};
    const auto seen = [](const std::vector<double>& radii) {
        const auto blind = blind_branch(with_side_branch(radii), 3);
        REQUIRE(blind);
        CAPTURE(blind->length, blind->widest);
        CHECK(blind->is_short());
        return blind->bulges;
    };
    CHECK(seen(sac));
    std::vector<double> stub = sac;  // no wider behind its narrowest place
    std::ranges::replace_if(
        stub, [](double r) { return r > 0.76; }, 0.76);
    CHECK_FALSE(seen(stub));
    std::vector<double> longer = sac;  // a vessel that is narrower at its root
    longer.insert(longer.end() - 4, 4, 0.9);
    CHECK_FALSE(seen(longer));
}

SCENARIO("A short branch that is few voxels of the search grid wide is likelier open than a ball",
         "[geometry][openings]") {
    // A wide vessel, one of 1 mm radius that leaves it, and something small on that one's wall. The
    // wide one makes the grid's voxels 0.29 mm wide.
    const auto plan_with = [](const ImplicitShape& small) {
        const ImplicitShape all = [&](const Vec3& p) {
            const double wide = capsule(p, {0, 0, 0}, {0, 0, 30}, 3.0);
            const double narrow = capsule(p, {0, 0, 15}, {20, 0, 15}, 1.0);
            return std::min({wide, narrow, small(p)});
        };
        const Surface surface =
            iso_surface(all, {Vec3(-3.2, -3.2, -3.1), Vec3(21.3, 3.3, 33.2)}, 0.22);
        return plan_openings(surface, *centerlines_of(surface));
    };
    double least = 1.0;
    for (const double radius : {0.42, 0.46}) {  // 4.3 and 4.0 radii long
        const OpeningPlan branch = plan_with([=](const Vec3& p) {
            return capsule(p, {12, 0, 15}, {12, 2.4, 15}, radius);
        });
        const EndRecord end = end_at(branch, Vec3(12, 2.6, 15));
        CHECK((end.place - Vec3(12, 2.6, 15)).norm() < 2.0 * radius);
        CHECK_FALSE(end.stub);
        least = std::min(least, end.verdict->odds.opening);
    }
    for (const double beyond : {0.6, 0.8}) {
        const OpeningPlan ball =
            plan_with([=](const Vec3& p) { return (p - Vec3(12, 1.0 + beyond, 15)).norm() - 0.8; });
        const EndRecord end = end_at(ball, Vec3(12, 2, 15));
        CAPTURE(beyond, ball.ends.size(), end.why);
        CHECK(ball.openings.size() == 3);
        CHECK((!end.verdict || end.verdict->odds.opening < least));
    }
}

SCENARIO("A sac beside whose middle the line runs is one by its sections", "[geometry][openings]") {
    // The line's circles show a stub that does not widen.
    const std::vector<double> radii = {0.90, 0.90, 0.90, 0.88, 0.86, 0.85, 0.84, 0.80, 0.76, 0.75,
                                       0.75, 0.75, 0.75, 0.75, 0.75, 0.72, 0.65, 0.60, 0.50};
    const CenterlineGraph graph = with_side_branch(radii);
    const auto beside_vessel = [](const ImplicitShape& extra) {
        const ImplicitShape all = [&](const Vec3& p) {
            return std::min(capsule(p, {0, 0, -6}, {0, 0, 6}, 0.9), extra(p));
        };
        return iso_surface(all, {Vec3(-1.2, -1.8, -7.1), Vec3(3.6, 1.9, 7.2)}, 0.17);
    };
    const Surface sac =
        beside_vessel([](const Vec3& p) { return (p - Vec3(1.9, 0.2, 0)).norm() - 1.2; });
    const Surface stub = beside_vessel([](const Vec3& p) {
        return capsule(p, {0, 0, 0}, {2.2, 0, 0}, 0.75);
    });
    CHECK(section_rise(sac, graph, 3) > 1.2);
    CHECK(section_rise(stub, graph, 3) < 1.15);
    const EndRecord end = end_at(plan_openings(sac, graph), graph.nodes[3].position);
    REQUIRE(end.verdict);
    CHECK(end.verdict->odds.sac > end.verdict->odds.bump);
}

SCENARIO("A stub whose sections at its root cut along its parent is no sac",
         "[geometry][openings]") {
    const Vec3 way = Vec3(1, 0, 2).normalized();
    const ImplicitShape vessels = [&](const Vec3& p) {
        return std::min(capsule(p, {0, 0, -6}, {0, 0, 6}, 0.9),
                        capsule(p, {0, 0, 0}, 3.975 * way, 0.75));
    };
    const Surface surface =
        iso_surface(vessels, {Vec3(-1.2, -1.8, -7.1), Vec3(4.6, 1.9, 7.2)}, 0.17);
    const CenterlineGraph graph = with_side_branch(std::vector<double>(30, 0.75), way);
    const auto blind = blind_branch(graph, 3);
    REQUIRE(blind);
    CAPTURE(blind->length, blind->widest);
    CHECK(section_rise(surface, graph, 3) < 1.15);
}

SCENARIO("A knob of a surface with flat caps is no outlet", "[geometry][openings]") {
    const auto fate_of = [](double reach) {
        const Surface surface =
            label_flat_caps(closed_vessels(0.8, {{Vec3::Zero(), Vec3(reach, 0, 0)}}));
        REQUIRE(surface.patches.size() == 3);
        const OpeningPlan plan = plan_openings(surface, *centerlines_of(surface));
        const EndRecord end = end_at(plan, Vec3(reach, 0, 0));
        CAPTURE(reach, end.why);
        return (end.place - Vec3(reach, 0, 0)).norm() < 2.0 ? end.fate : EndFate::Closed;
    };
    CHECK(fate_of(2.2) == EndFate::Closed);
    CHECK(fate_of(8.0) == EndFate::Opened);
}

SCENARIO("A bump of the wall is not a vessel's end", "[geometry][openings]") {
    const auto fate_of = [](double reach) {
        const ImplicitShape vessel = [=](const Vec3& p) {
            return std::min(capsule(p, {0, 0, -6}, {0, 0, 6}, 0.9),
                            capsule(p, {0, 0, 0}, {reach - 0.75, 0, 0}, 0.75));
        };
        const Surface surface =
            iso_surface(vessel, {Vec3(-1.2, -1.8, -7.1), Vec3(3.6, 1.9, 7.2)}, 0.17);
        const CenterlineGraph graph =
            with_side_branch(std::vector<double>(static_cast<std::size_t>(reach / 0.15), 0.75));
        const OpeningPlan plan = plan_openings(surface, graph);
        const EndRecord end = end_at(plan, graph.nodes[3].position);
        CAPTURE(end.why);
        CHECK(plan.openings.size() == (end.fate == EndFate::Opened ? 3 : 2));
        return end.fate;
    };
    CHECK(fate_of(1.5) != EndFate::Opened);
    CHECK(fate_of(3.3) == EndFate::Opened);
}

SCENARIO("A trunk that a dome closes just before its bifurcation is no end that nobody mentions",
         "[geometry][openings]") {
    // Its line was pruned as that of a sac, and one of its daughters became the inlet.
    for (const double length : {2.0, 2.5}) {
        CAPTURE(length);
        const std::vector<PhantomPart> parts = {
            {.name = "trunk", .shape = vessel_along({Vec3::Zero(), Vec3(0, 0, length)}, 2.0)},
            {.name = "left",
             .shape = vessel_along({Vec3::Zero(), Vec3(-12, 0, -12)}, 1.6, true),
             .blend = 0.3},
            {.name = "right",
             .shape = vessel_along({Vec3::Zero(), Vec3(12, 0, -12)}, 1.6, true),
             .blend = 0.3}};
        const PhantomField field(parts);
        const Surface closed = label_flat_caps(exact_surface(field, field.bounds(), 0.3));
        const Vec3 dome(0, 0, length + 2.0);
        const LinesAndStubs lines = lines_to_ends(closed, {});
        const OpeningPlanOptions options{.stubs = lines.stubs};
        const OpeningPlan plan = plan_openings(closed, *lines.graph, options);
        const EndRecord end = end_at(plan, dome);
        CHECK((end.place - dome).norm() < 2.0);  // anywhere on the dome
        CHECK(end.diameter == Approx(4.0).epsilon(0.15));
        CHECK(end.fate == EndFate::Closed);
        CHECK(plan.openings.size() == 2);
        // An aneurysm on a bend looks the same: the caller has to say which it is.
        CHECK_FALSE(end.plain);
        CHECK_THAT(why_no_flow(plan), Contains("not certain") && Contains("100 % of the flow"));
        const LinesAndStubs asked = lines_to_ends(closed, {end.place});
        CHECK(plan_openings(closed, *asked.graph, {.open = {end.place}, .stubs = asked.stubs})
                  .openings.size() == 3);
        const OpeningPlan left =
            plan_openings(closed, *lines.graph, {.closed = {end.place}, .stubs = lines.stubs});
        CHECK(why_no_flow(left).empty());
    }
}

SCENARIO("An aneurysm at a bifurcation stays closed beside open rims, though it has no line",
         "[geometry][openings]") {
    const std::vector<PhantomPart> parts = {
        {.name = "trunk", .shape = vessel_along({Vec3::Zero(), Vec3(0, 0, -12)}, 1.7, true)},
        {.name = "left",
         .shape = vessel_along({Vec3::Zero(), Vec3(-12, 0, -1)}, 1.5, true),
         .blend = 0.3},
        {.name = "right",
         .shape = vessel_along({Vec3::Zero(), Vec3(12, 0, -1)}, 1.5, true),
         .blend = 0.3},
        {.name = "sac",
         .shape = SphereShape{.centre = Vec3(0, 0, 3.3), .radius = 2.5},
         .blend = 0.3}};
    const PhantomField field(parts);
    const Surface closed = exact_surface(field, field.bounds(), 0.3);
    const Vec3 dome(0, 0, 5.8);
    const OpeningPlan cuts = plan_openings(closed, *centerlines_of(closed));
    REQUIRE(cuts.openings.size() == 3);
    const Surface open = without_caps(clip_openings(closed, cuts).surface);
    const LinesAndStubs lines = lines_to_ends(open, {});
    REQUIRE_FALSE(lines.stubs.empty());
    const OpeningPlan plan = plan_openings(open, *lines.graph, {.stubs = lines.stubs});
    const EndRecord sac = end_at(plan, dome);
    CAPTURE(sac.why, sac.verdict->odds.opening);
    CHECK(sac.verdict->profile.cut_beside > 0.25);
    CHECK(sac.fate == EndFate::Closed);
    CHECK(plan.openings.size() == 3);
    CHECK(why_no_flow(plan).empty());
}

SCENARIO("A stub that leans along its vessel is no end that nobody mentions",
         "[geometry][openings]") {
    // Along the vessel, its tip is hardly farther away than the wall opposite to it.
    for (const auto& [lean, reach] : {std::pair(0.6, 2.0), std::pair(1.0, 2.6)}) {
        CAPTURE(lean, reach);
        const Vec3 way = Vec3(1, 0, lean).normalized();
        const ImplicitShape vessels = [&, length = reach](const Vec3& p) {
            const double stub =
                std::max(capsule(p, Vec3::Zero(), 9.0 * way, 0.6), p.dot(way) - length);
            return std::min(capsule(p, Vec3(0, 0, -12), Vec3(0, 0, 12), 0.8), stub);
        };
        const Surface closed = iso_surface(vessels, {Vec3(-2, -2, -14), Vec3(5, 2, 14)}, 0.25);
        const LinesAndStubs lines = lines_to_ends(closed, {});
        const OpeningPlan plan = plan_openings(closed, *lines.graph, {.stubs = lines.stubs});
        CHECK(plan.openings.size() == 2);
        const EndRecord end = end_at(plan, reach * way);
        CHECK((end.place - reach * way).norm() < 0.7);
        CHECK(end.diameter == Approx(1.2).epsilon(0.1));
        CHECK(end.stub);
        CHECK(end.share() > kLeastShare);
    }
}

SCENARIO("An image's border just behind a bifurcation loses no vessel", "[geometry][openings]") {
    // Cuts across the two vessels would meet.
    constexpr double kVoxel = 1.5, kBorder = -12.5;
    const auto shape = [](const Vec3& p) {
        const double trunk = capsule(p, Vec3(0, 0, 60), Vec3::Zero(), 8.0);
        const double left = capsule(p, Vec3::Zero(), Vec3(-25, 0, -50), 5.0);
        const double right = capsule(p, Vec3::Zero(), Vec3(25, 0, -50), 5.0);
        return std::min({trunk, left, right});
    };
    Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
    matrix.topLeftCorner<3, 3>() *= kVoxel;
    matrix.topRightCorner<3, 1>() = Vec3(-24, -14, kBorder);
    const Image image = image_of({33, 19, 39}, matrix, [&](const Vec3& p) { return -shape(p); });
    const Surface surface = extract_surface(image, {}, {.threshold = 0.0}).surface;
    const auto graph = centerlines_of(surface);
    const OpeningPlan plan = plan_openings(surface, *graph, {.border_cuts = true});
    CHECK(plan.openings.size() == 3);
    for (const double x : {-6.25, 6.25}) {
        const EndRecord end = end_at(plan, Vec3(x, 0, kBorder));
        CAPTURE(x, end.why);
        CHECK(end.opening.has_value());
    }
    CHECK(std::ranges::any_of(plan.ends, [](const EndRecord& end) {
        return end.why.find("kept, though it is not perpendicular") != std::string::npos;
    }));
    const Surface opened = clip_openings(surface, plan).surface;
    CHECK(is_closed_manifold(opened));
    CHECK(openings_in_walls(surface, opened).empty());
}

namespace {

EndVerdict verdict_of(double opening, double share) {
    EndVerdict verdict{.odds = {opening, 1.0 - opening, 0.0}, .share = share};
    const double odds = verdict.odds.for_opening();
    verdict.open = odds >= 1.0;
    verdict.doubtful =
        share > kLeastShare && odds < end_limits().certain && odds > 1.0 / end_limits().certain;
    return verdict;
}

/// An inlet, an outlet, and another end.
OpeningPlan plan_with(const EndRecord& other) {
    const EndRecord inlet{.fate = EndFate::Opened, .verdict = verdict_of(0.95, 1.0), .opening = 0};
    const EndRecord outlet{.fate = EndFate::Kept, .verdict = verdict_of(0.95, 0.3), .opening = 1};
    return {.openings = {{}, {}}, .ends = {other, inlet, outlet}};
}

}  // namespace

SCENARIO("A model whose flow would be missing is a failure", "[geometry][openings]") {
    EndRecord other{.place = {1, 2, 3}, .diameter = 2.0, .why = "the vessels form a loop there"};
    GIVEN("an end that is likely an opening, but could not be cut") {
        other.verdict = verdict_of(0.9, 0.2);
        other.tried = true;
        CHECK_THAT(why_no_flow(plan_with(other)),
                   Contains("(1, 2, 3) mm") && Contains("form a loop") && Contains("20 % of the"));
        THEN("it is none if it was asked for, or carries little of the flow") {
            other.asked = true;
            CHECK(why_no_flow(plan_with(other)).empty());
            other.asked = false;
            other.verdict = verdict_of(0.9, 0.04);
            CHECK(why_no_flow(plan_with(other)).empty());
        }
    }
    GIVEN("a thin tip that could not be cut, behind a vessel half as wide as the inlet") {
        other.verdict = verdict_of(0.7, 0.01);
        other.verdict->through = {{.branch = 7, .diameter = 2.0}};
        other.tried = true;
        OpeningPlan plan = plan_with(other);
        plan.inlets = {0};
        plan.ends[1].verdict->profile.diameter = 4.0;
        plan.ends[1].verdict->inlet = InletCandidate{};
        CHECK_THAT(why_no_flow(plan), Contains("(1, 2, 3) mm") && Contains("form a loop"));
        THEN("it is none if another end of that vessel is open") {
            plan.ends[2].verdict->through = other.verdict->through;
            CHECK(why_no_flow(plan).empty());
        }
        THEN("it is none if the vessel is thin as well") {
            plan.ends[0].verdict->through[0].diameter = 1.0;
            CHECK(why_no_flow(plan).empty());
        }
    }
    GIVEN("an end that is certain to be a sac, however wide") {
        other.verdict = verdict_of(0.1, 1.0);
        CHECK(why_no_flow(plan_with(other)).empty());
    }
    GIVEN("an end in doubt") {
        for (const double opening : {0.3, 0.7}) {
            other.verdict = verdict_of(opening, 0.2);
            CHECK_THAT(why_no_flow(plan_with(other)), Contains("not certain"));
            CHECK(why_no_flow(plan_with(other), true).empty());
        }
        THEN("it is none once the caller has said that it stays closed") {
            other.asked = true;
            CHECK(why_no_flow(plan_with(other)).empty());
        }
    }
    GIVEN("very many ends") {
        other.verdict = verdict_of(0.9, 0.2);
        OpeningPlan plan = plan_with(other);
        for (int i = 1; i <= 30; ++i) plan.ends.push_back({.diameter = 0.01 * i});
        const std::string text = why_no_flow(plan);
        CHECK(std::ranges::count(text, '\n') == 21);
        CHECK_THAT(text, Contains("\n  and 13 more, which are no wider"));
    }
}

SCENARIO("A pimple of a closed end is not opened instead of the end", "[geometry][openings]") {
    const std::vector<PhantomPart> parts = {
        {.name = "vessel", .shape = vessel_along({Vec3(0, 0, -15), Vec3(0, 0, 15)}, 3.0)},
        {.name = "pimple",
         .shape = vessel_along({Vec3(0, 0, 15), Vec3(0, 0, 22)}, 0.5),
         .blend = 0.1}};
    const PhantomField field(parts);
    const Surface surface = exact_surface(field, field.bounds(), 0.2);
    const auto graph = centerlines_of(surface);
    REQUIRE(nearest_tip(*graph, Vec3(0, 0, 22)));
    const OpeningPlan plan = plan_openings(surface, *graph);
    REQUIRE(plan.openings.size() == 2);
    for (const PlannedOpening& opening : plan.openings) CHECK(opening.place.diameter > 4.0);
}

SCENARIO("A cut takes no other open rim along that is wide", "[geometry][openings]") {
    // The line of the branch in the side was not found: the cut of the upper end would lose it.
    const auto rim_end = [](double radius) {
        const Vec3 at(0, kRadius, 27.5);
        const Surface tube = ragged_tube();
        std::vector<bool> keep;
        for (const Triangle& t : tube.triangles())
            keep.push_back(std::ranges::none_of(
                t, [&](VertexId v) { return (tube.points()[v] - at).norm() < radius; }));
        const Surface holed = select_triangles(tube, keep);
        REQUIRE(holed.topology->boundary_loops().size() == 3);
        return end_at(plan_openings(holed, line_graph()), at);
    };
    CHECK(rim_end(0.4).shared);
    CHECK_FALSE(rim_end(1.1).shared);
}

SCENARIO("The widest vessel beside open rims stays closed, is named, and is opened where asked",
         "[geometry][openings]") {
    for (const double reach : {6.0, 8.5}) {
        CAPTURE(reach);
        const Surface surface = without_caps(blind_trunk(reach));
        const auto graph = centerlines_of(surface);
        const OpeningPlan plan = plan_openings(surface, *graph);
        const EndRecord end = end_at(plan, Vec3(reach + 2.0, 0, 0));
        CHECK(plan.openings.size() == 2);
        CHECK(end.fate == EndFate::Closed);
        CHECK_THAT(end.why, Contains("% of the flow"));
        const OpeningPlan opened = plan_openings(surface, *graph, {.open = {end.place}});
        CHECK(opened.openings.size() == 3);
        CHECK(why_no_flow(plan_openings(surface, *graph, {.closed = {end.place}})).empty());
    }
    GIVEN("that it is certainly an opening by its odds") {
        EndRecord other{.verdict = verdict_of(0.99, 1.0), .number = 3};
        other.verdict->open = false;
        other.verdict->doubtful = true;
        CHECK_THAT(why_no_flow(plan_with(other)), Contains("end 3") && Contains("is none"));
    }
}

SCENARIO("A failure names all ends, and a way on that was tried", "[geometry][openings]") {
    const Surface tube = ragged_tube();
    const CenterlineGraph line = line_graph();
    GIVEN("that one end was cut wherever it can be, and failed") {
        OpeningPlanOptions options;
        for (OpeningPlan plan = plan_openings(tube, line, options); plan.openings.size() == 2;
             plan = plan_openings(tube, line, options)) {
            const OpeningPlace& place = upper(plan).place;
            options.failed.push_back({place.tip, place.plane.point, "it failed"});
        }
        const OpeningPlan plan = plan_openings(tube, line, options);
        std::vector<Diagnostic> found;
        try {
            check_flow(plan, tube, line, options);
        } catch (const DiagnosedFailure& failure) {
            found = failure.diagnostics();
        }
        REQUIRE_FALSE(found.empty());
        CHECK(found[0].code == "too-few-openings");
        CHECK(found[0].words.at("found") == "only one");
        CHECK_THAT(found[0].words.at("ends"),
                   Contains(" kept at ") && Contains(" closed at ") && Contains("it failed"));
        REQUIRE(found[0].remedies.size() == 1);
        CHECK(found[0].remedies[0].before);
        CHECK(found[0].remedies[0].arguments.at("tip") == "0,0,30");
        const double distance = std::stod(found[0].remedies[0].arguments.at("distance"));
        CHECK(plan_openings(tube, line, {.tip = Vec3(0, 0, 30), .distance = distance})
                  .openings.size() == 1);
    }
    GIVEN("that it stays closed as asked") {
        const OpeningPlanOptions options{.closed = {Vec3(0, 0, 30)}};
        CHECK_THROWS_WITH(check_flow(plan_openings(tube, line, options), tube, line, options),
                          Contains("none of these ends can be opened"));
    }
}

SCENARIO("A loop is no obstacle to ends outside it", "[geometry][openings]") {
    const auto ring = [](const Vec3& p) {
        const double torus = std::hypot(std::hypot(p.x(), p.y()) - 8.0, p.z()) - 1.5;
        return std::min({torus, capsule(p, Vec3(-22, 0, 0), Vec3(-8, 0, 0), 1.8),
                         capsule(p, Vec3(8, 0, 0), Vec3(22, 0, 0), 1.5)});
    };
    const Surface surface =
        repair(iso_surface(ring, {Vec3(-26, -12, -4), Vec3(26, 12, 4)}, 0.4)).surface;
    const auto graph = centerlines_of(surface);
    const OpeningPlan plan = plan_openings(surface, *graph);
    REQUIRE(plan.openings.size() == 2);
    CHECK(why_no_flow(plan).empty());
    const ClippedSurface made = clip_openings(surface, plan);
    CHECK(made.failed.empty());
    CHECK(connectivity(*made.surface.topology).genus == std::optional(1));
    for (std::size_t p = 1; p < made.surface.patches.size(); ++p)
        CHECK(std::abs(patch_shape(made.surface, p).plane.point.x()) > 18.0);
}

SCENARIO("It is never advised to close the trunk", "[geometry][openings]") {
    const Vec3 trunk(0, 0, -15), one(10, 0, 10), other(-10, 0, 5), another(0, 10, 0);
    const Surface tree = closed_vessels(
        1.0, {{Vec3::Zero(), one}, {Vec3(0, 0, -5), other}, {Vec3(0, 0, -8), another}});
    const auto graph = centerlines_of(tree);
    const auto text_if_they_fail = [&](const Positions& tips) {
        OpeningPlanOptions options;
        const auto fails = [&](const PlannedOpening& opening) {
            return std::ranges::any_of(
                tips, [&](const Vec3& tip) { return (opening.place.tip - tip).norm() < 2.0; });
        };
        OpeningPlan plan = plan_openings(tree, *graph);
        while (std::ranges::any_of(plan.openings, fails)) {
            for (const PlannedOpening& opening : plan.openings)
                if (fails(opening))
                    options.failed.push_back(
                        {opening.place.tip, opening.place.plane.point, "it failed"});
            plan = plan_openings(tree, *graph, options);
        }
        try {
            check_flow(plan, tree, *graph, options);
        } catch (const AlgorithmFailure& failure) {
            return std::string(failure.what());
        }
        return std::string();
    };
    CHECK_THAT(text_if_they_fail({one, other}), Contains("closed="));
    CHECK_THAT(text_if_they_fail({one, trunk}),
               Contains("100 % of the flow") && !Contains("closed="));
}

SCENARIO("The inlet is the end that was named", "[geometry][openings]") {
    const Surface tube = ragged_tube();
    const OpeningPlan plan = plan_openings(tube, line_graph(), {.inlets = {Vec3(0, 1, 31)}});
    REQUIRE(plan.inlets.size() == 1);
    CHECK(plan.openings[plan.inlets[0]].place.plane.point.z() > 15.0);
    THEN("a point that is at no end is refused with the nearest one's place") {
        CHECK_THROWS_WITH(plan_openings(tube, line_graph(), {.inlets = {Vec3(0, 0, 60)}}),
                          Contains("nearest end"));
    }
    THEN("an inlet that stays closed is a failure") {
        CHECK_THROWS_WITH(plan_openings(tube, line_graph(),
                                        {.inlets = {Vec3(0, 0, 30)}, .closed = {Vec3(0, 0, 30)}}),
                          Contains("cannot be opened"));
    }
}

SCENARIO("Several ends can be inlets", "[geometry][openings]") {
    const Surface tube = ragged_tube();
    const Positions both = {Vec3(0, 1, 31), Vec3(0, 0, 0)};
    const OpeningPlan plan = plan_openings(tube, line_graph(), {.inlets = both});
    REQUIRE(plan.inlets.size() == 2);
    THEN("they are numbered by their size") {
        const Surface named = clip_openings(tube, plan, {.points = both}).surface;
        CHECK(named.patches[1] == Patch{"inlet_1", PatchKind::Inlet});
        CHECK(named.patches[2] == Patch{"inlet_2", PatchKind::Inlet});
        CHECK(patch_shape(named, 1).area >= patch_shape(named, 2).area);
        AND_THEN("one of them alone is the inlet again") {
            const Surface single = name_openings(named, {}, {.points = {both[0]}});
            CHECK(single.patches[1] == Patch{"inlet", PatchKind::Inlet});
            CHECK(single.patches[2] == Patch{"outlet_1", PatchKind::Outlet});
        }
    }
    THEN("each means an end of its own") {
        CHECK_THROWS_WITH(
            plan_openings(tube, line_graph(), {.inlets = {Vec3(0, 1, 31), Vec3(0, 0, 30)}}),
            Contains("same end"));
    }
}

SCENARIO("Outlets that face the same way as the inlet may be inlets", "[geometry][openings]") {
    const auto joined_tubes = [](double radius, double turn) {
        const Surface one = closed_tube(kRadius, kLength, 24, 20);
        const Surface other =
            mapped(closed_tube(radius, kLength, 24, 20), [&](const Vec3& p) -> Vec3 {
                return Vec3(20.0, 0, 0) + Eigen::AngleAxisd(turn, Vec3::UnitX()) * p;
            });
        Positions points = one.points();
        std::vector<Triangle> triangles(one.triangles().begin(), one.triangles().end());
        PatchLabels labels = *one.patch_labels;
        for (TriangleId t = 0; t < other.triangle_count(); ++t) {
            Triangle triangle = other.triangles()[t];
            for (VertexId& v : triangle) v += static_cast<VertexId>(one.vertex_count());
            triangles.push_back(triangle);
            const auto label = (*other.patch_labels)[t];
            labels.push_back(label == 0 ? label : static_cast<std::uint16_t>(label + 2));
        }
        points.insert(points.end(), other.points().begin(), other.points().end());
        return make_surface(std::move(points), std::move(triangles), std::move(labels),
                            {{"wall", PatchKind::Wall},
                             {"inlet", PatchKind::Inlet},
                             {"outlet_1", PatchKind::Outlet},
                             {"outlet_2", PatchKind::Outlet},
                             {"outlet_3", PatchKind::Outlet}});
    };
    CHECK(likely_inlets(joined_tubes(0.8 * kRadius, 0.0)) == std::vector<std::size_t>{3});
    CHECK(likely_inlets(joined_tubes(0.5 * kRadius, 0.0)).empty());            // too thin
    CHECK(likely_inlets(joined_tubes(0.8 * kRadius, 0.5 * 3.14159)).empty());  // faces aside
}

SCENARIO("Of outlets alone, the largest becomes the inlet", "[geometry][openings]") {
    Surface tube = mapped(closed_tube(kRadius, kLength, 40, 90), [](const Vec3& p) {
        return Vec3(p.x() * (1.0 + 0.01 * p.z()), p.y() * (1.0 + 0.01 * p.z()), p.z());
    });
    tube = tube.with_patches(*tube.patch_labels, {{"wall", PatchKind::Wall},
                                                  {"outlet_1", PatchKind::Outlet},
                                                  {"outlet_2", PatchKind::Outlet}});
    const Surface named =
        clip_openings(tube, plan_openings(tube, line_graph()), {.promote = true}).surface;
    CHECK(named.patches[1] == Patch{"inlet", PatchKind::Inlet});
    CHECK(patch_shape(named, 1).plane.point.z() == Approx(kLength));
    CHECK(named.patches[2].kind == PatchKind::Outlet);
}

SCENARIO("Planning says how far it is, and can be cancelled", "[geometry][openings][cancel]") {
    const Surface tube = ragged_tube();
    StopAt never(2.0);
    CHECK(plan_openings(tube, line_graph(), {}, never.progress()).openings.size() == 2);
    CHECK(never.fractions().size() > 1);
    StopAt stop(0.4);
    CHECK_THROWS_AS(plan_openings(tube, line_graph(), {}, stop.progress()), Cancelled);
}

SCENARIO("Many cuts that fail in their first way are made again together", "[geometry][openings]") {
    std::vector<Positions> branches;
    for (int i = 0; i < 20; ++i) {
        const Vec3 from(0, 0, 1.3 * i - 12.4), way(std::cos(2.4 * i), std::sin(2.4 * i), 0.2);
        branches.push_back({from, Vec3(from + 7.0 * way)});
    }
    const Surface tree = closed_vessels(0.5, branches);
    const auto graph = centerlines_of(tree);
    const OpeningPlan plan = plan_openings(tree, *graph);
    REQUIRE(plan.openings.size() > 15);
    int passes = 1;
    double last = 0.0;
    const Progress count(
        [&](double fraction, std::string_view) {
            passes += fraction < last ? 1 : 0;
            last = fraction;
        },
        {});
    const ClippedSurface clipped = clip_openings(tree, plan, {.promote = true}, graph.get(), count);
    CHECK(clipped.failed.empty());
    CHECK(clipped.surface.patches.size() == plan.openings.size() + 1);
    CAPTURE(passes);
    CHECK(passes <= 6);
}
