#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "geometry/kernel/edges.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/measure.h"
#include "geometry/kernel/unsmoothed.h"
#include "geometry/phantoms/exact_surface.h"
#include "geometry/phantoms/field.h"
#include "geometry/phantoms/phantom.h"
#include "geometry/vessel/openings/opening_axis.h"
#include "tests/support/iso_surface.h"
#include "tests/support/shapes.h"
#include "tests/support/surface_facts.h"
#include "tests/workbench/test_operations.h"
#include "workbench/case/checked_value.h"
#include "workbench/case/operation.h"
#include "workbench/operations/shared/opening_arguments.h"
#include "workbench/operations/table.h"

using namespace vesselbench;
using namespace vesselbench::test;
using Catch::Contains;

namespace {

/// A second run with the resolved arguments leaves the same bits.
void check_replay(const std::string& operation, const Surface& surface, const Outcome& outcome) {
    const Outcome again = run(operation, surface, outcome.resolved);
    CHECK(again.scene.surface->points() == outcome.scene.surface->points());
    CHECK(std::equal(
        again.scene.surface->triangles().begin(), again.scene.surface->triangles().end(),
        outcome.scene.surface->triangles().begin(), outcome.scene.surface->triangles().end()));
    CHECK(again.scene.surface->patches == outcome.scene.surface->patches);
}

/// A vessel of radius 3 mm along z from 0 to 40 with patches at its ends, and a side branch of
/// radius 1.5 mm whose tip is at (16, 0, 20).
Surface side_branched() {
    const std::vector<PhantomPart> parts = {
        {.name = "parent",
         .shape = VesselShape{.points = {Vec3(0, 0, -2), Vec3(0, 0, 20), Vec3(0, 0, 42)},
                              .radii = {3.0, 3.0, 3.0},
                              .flat_ends = true}},
        {.name = "branch",
         .shape = VesselShape{.points = {Vec3(0, 0, 20), Vec3(16, 0, 20)},
                              .radii = {1.5, 1.5},
                              .flat_ends = true},
         .blend = 0.5}};
    const PhantomField field(parts);
    Outcome outcome = run("repair", exact_surface(field, field.bounds(), 0.375), {{"caps", false}});
    for (const double z : {-2.0, 42.0})
        outcome = run("clip-opening", *outcome.scene.surface,
                      {{"tip", Vec3(0, 0, z)}, {"distance", 2.0}});
    return *outcome.scene.surface;
}

/// How far a wall is from the tube of radius 3 mm around z, away from its ends.
struct TubeError {
    double distance = 0.0;  ///< largest of a vertex [mm]
    double tilt_deg = 0.0;  ///< largest angle of a triangle's normal and the tube's
};

TubeError tube_error(const Surface& surface) {
    TubeError error;
    const auto inside = [](const Vec3& p) { return p.z() > 4.0 && p.z() < 36.0; };
    const auto& points = surface.points();
    for (const Vec3& p : points)
        if (inside(p))
            error.distance = std::max(error.distance, std::abs(std::hypot(p.x(), p.y()) - 3.0));
    for (const Triangle& t : surface.triangles()) {
        const Vec3 &a = points[t[0]], &b = points[t[1]], &c = points[t[2]];
        const Vec3 middle = (a + b + c) / 3.0, out(middle.x(), middle.y(), 0.0);
        if (!inside(middle)) continue;
        const double cosine = (b - a).cross(c - a).normalized().dot(out.normalized());
        error.tilt_deg =
            std::max(error.tilt_deg, std::acos(std::min(1.0, cosine)) * 180.0 / std::numbers::pi);
    }
    return error;
}

/// Triangles of every patch by its name.
std::map<std::string, std::size_t> patch_sizes(const Surface& surface) {
    std::map<std::string, std::size_t> sizes;
    for (TriangleId t = 0; t < surface.triangle_count(); ++t) ++sizes[surface.patch_of(t).name];
    return sizes;
}

}  // namespace

SCENARIO("Flat caps of a closed surface stay through repair, smooth and clip-opening",
         "[workbench][openings]") {
    const Surface tube = fine_tube(2.0, 20.0, 24);
    const Surface bare =
        tube.with_patches(PatchLabels(tube.triangle_count(), 0), {{"wall", PatchKind::Wall}});
    Scene scene{.surface = bare};
    const Outcome repaired = run("repair", scene, {});
    CHECK((*repaired.report)["headline"] == "2 flat caps found");
    REQUIRE(repaired.scene.surface->patches.size() == 3);
    const Outcome smooth = run("smooth", repaired.scene, {{"staircase", false}});
    const Outcome opened = run("clip-opening", smooth.scene, {});
    CHECK((*opened.report)["openings"][0]["kept"] == true);
    const auto z = bounds(*opened.scene.surface);
    CHECK(z.min.z() == Approx(0.0).margin(1e-9));
    CHECK(z.max.z() == Approx(20.0));
    check_replay("clip-opening", *smooth.scene.surface, opened);
    THEN("they are not looked for if the caller says so") {
        CHECK(run("repair", scene, {{"caps", false}}).scene.surface->patches.size() == 1);
    }
}

SCENARIO("extrude-opening lengthens all openings by diameters", "[workbench][openings]") {
    const Surface tube = closed_tube(2.0, 20.0, 48, 60);
    const Outcome outcome = run("extrude-opening", tube, {{"share", 1.0}});
    CHECK(outcome.warnings.empty());
    THEN("each is three diameters longer, and the report says so") {
        CHECK(is_closed_manifold(*outcome.scene.surface));
        CHECK(enclosed_volume(*outcome.scene.surface) ==
              Approx(enclosed_volume(tube) * 44.0 / 20.0).epsilon(3e-3));
        REQUIRE(outcome.report->at("openings").size() == 2);
        CHECK(outcome.report->at("openings")[0]["length_mm"].get<double>() ==
              Approx(12.0).epsilon(3e-3));
        check_replay("extrude-opening", tube, outcome);
    }
    THEN("by default they are no longer than a share of a short tube, which is said") {
        const Outcome limited = run("extrude-opening", tube, {});
        const double extent = bounds(tube).diagonal();
        CHECK(limited.report->at("openings")[0]["length_mm"].get<double>() ==
              Approx(0.3 * extent).epsilon(1e-6));
        REQUIRE(limited.warnings.size() == 1);
        CHECK(limited.warnings[0].code == "extrusion-limited");
        CHECK(limited.warnings[0].figures.at("share") == 0.3);
        const Outcome given = run("extrude-opening", tube, {{"length", 12.0}});
        CHECK(given.warnings.empty());
        CHECK(given.report->at("openings")[0]["length_mm"].get<double>() == Approx(12.0));
    }
    THEN("an unknown opening and a surface without openings are refused") {
        CHECK_THROWS_WITH(run("extrude-opening", tube, {{"opening", "outlet_9"}}),
                          Catch::Contains("outlet_1"));
        CHECK_THROWS_AS(run("extrude-opening", icosphere(1.0, 1), {}), AlgorithmFailure);
    }
}

SCENARIO("extrude-opening leaves out an opening with a vessel right in front of it",
         "[workbench][openings]") {
    const Surface tube = closed_tube(2.0, 20.0, 48, 60);
    const Surface across =
        tube.with_patches(PatchLabels(tube.triangle_count(), 0), {tube.patches[0]});
    const Surface both = merged(tube, mapped(across, [](const Vec3& p) {
                                    return Vec3(p.z() - 10.0, -p.y(), p.x() + 23.5);
                                }));
    const Outcome outcome = run("extrude-opening", both, {{"length", 5.0}});
    REQUIRE(outcome.report->at("openings").size() == 1);
    CHECK(outcome.report->at("openings")[0]["name"] == "inlet");
    REQUIRE(outcome.warnings.size() == 1);
    CHECK(outcome.warnings[0].code == "opening-not-extruded");
    CHECK(outcome.warnings[0].words.at("opening") == "outlet_1");
    CHECK(bounds(*outcome.scene.surface).min.z() == Approx(-5.0));
    check_replay("extrude-opening", both, outcome);
    CHECK_THROWS_AS(run("extrude-opening", both, {{"length", 5.0}, {"opening", "outlet_1"}}),
                    AlgorithmFailure);
}

SCENARIO("extrude-opening goes on along the vessel if asked to", "[workbench][openings]") {
    const double lean = std::tan(std::numbers::pi / 6.0);
    const Surface tube = mapped(closed_tube(2.0, 20.0, 48, 60), [=](const Vec3& p) {
        return Vec3(p.x() + lean * p.z(), p.y(), p.z());
    });
    const auto extruded = [&](const char* direction) {
        return run("extrude-opening", tube,
                   {{"length", 8.0}, {"profile", "keep"}, {"direction", direction}});
    };
    const Outcome straight = extruded("normal"), along = extruded("centerline");
    CHECK(bounds(*straight.scene.surface).max.z() == Approx(28.0));
    CHECK(bounds(*along.scene.surface).max.z() ==
          Approx(20.0 + 8.0 * std::cos(std::numbers::pi / 6.0)).margin(0.1));
    CHECK(bounds(*along.scene.surface).max.x() == Approx(bounds(tube).max.x() + 4.0).margin(0.2));
    CHECK(along.warnings.empty());
    check_replay("extrude-opening", tube, along);
}

SCENARIO("fill-hole closes the named hole or all of them", "[workbench][openings]") {
    const Surface tube = open_tube(2.0, 20.0, 40, 60);
    const Outcome one = run("fill-hole", tube, {{"near", Vec3(0, 0, 21)}});
    CHECK(one.scene.surface->topology->boundary_loops().size() == 1);
    const Outcome all = run("fill-hole", tube, {});
    CHECK(is_closed_manifold(*all.scene.surface));
    check_replay("fill-hole", tube, all);
    CHECK_THROWS_AS(run("fill-hole", *all.scene.surface, {}), AlgorithmFailure);
}

SCENARIO("clip-opening needs the places before smoothing until all ends are open",
         "[workbench][openings]") {
    const Surface tube = open_tube(2.0, 30.0, 40, 90);
    const Surface smoothed = with_unsmoothed(tube, tube.points());
    const Outcome one = run("clip-opening", smoothed, {{"tip", Vec3(0, 0, 30)}});
    CHECK(one.scene.surface->attributes.size() == 3);
    CHECK(run("clip-opening", smoothed, {}).scene.surface->attributes.empty());
}

SCENARIO("clip-opening opens every end, and replays what it decided", "[workbench][openings]") {
    const Surface tube = open_tube(2.0, 30.0, 40, 90);
    const Outcome outcome = run("clip-opening", tube, {});
    THEN("both ends are capped, perpendicular and named") {
        const Surface& clipped = *outcome.scene.surface;
        CHECK(is_closed_manifold(clipped));
        REQUIRE(clipped.patches.size() == 3);
        CHECK(clipped.patches[1] == Patch{"inlet", PatchKind::Inlet});
        CHECK(clipped.patches[2] == Patch{"outlet_1", PatchKind::Outlet});
        for (const auto& opening : outcome.report->at("openings"))
            CHECK(opening["tilt_deg"].get<double>() < 0.5);
        check_replay("clip-opening", tube, outcome);
    }
    THEN("the report says what became of every end") {
        const auto& ends = outcome.report->at("ends");
        REQUIRE(ends.size() == 2);
        for (const auto& end : ends) {
            CHECK(end["fate"] == "kept");
            CHECK(end["diameter_mm"].get<double>() == Approx(4.0).epsilon(0.05));
            CHECK_FALSE(end["opening"].is_null());
        }
    }
    THEN("one end can be opened alone, with a name and a kind") {
        const Outcome one = run("clip-opening", tube,
                                {{"tip", Vec3(0, 0, 30)},
                                 {"distance", 5.0},
                                 {"name", std::string("femoral")},
                                 {"kind", std::string("outlet")}});
        REQUIRE(one.scene.surface->patches.size() == 2);
        CHECK(one.scene.surface->patches[1] == Patch{"femoral", PatchKind::Outlet});
        CHECK(one.scene.surface->topology->boundary_loops().size() == 1);
        check_replay("clip-opening", tube, one);
    }
    THEN("contradictory arguments are refused") {
        CHECK_THROWS_AS(run("clip-opening", tube, {{"name", std::string("x")}}), UsageError);
        CHECK_THROWS_AS(run("clip-opening", tube, {{"distance", 1.0}, {"radii", 1.0}}), UsageError);
        CHECK_THROWS_AS(run("clip-opening", tube,
                            {{"planes", std::vector<double>{1, 2}}, {"names", std::string("x")}}),
                        UsageError);
    }
}

SCENARIO("Ends are named by their numbers, and stored as places", "[workbench][openings]") {
    const Surface surface = side_branched();
    const Outcome all = run("clip-opening", surface, {{"open", std::vector<double>{16, 0, 20}}});
    REQUIRE(all.scene.surface->patches.size() == 4);
    const auto& ends = all.report->at("ends");
    const auto thinnest = std::ranges::max_element(
        ends, {}, [](const auto& end) { return end["number"].template get<int>(); });
    CHECK(thinnest->at("number") == 3);
    CHECK(thinnest->at("place_mm")[0] > 10.0);
    const Outcome closed = run("clip-opening", surface, {{"close_ends", std::vector<double>{3}}});
    CHECK(closed.scene.surface->patches.size() == 3);
    CHECK_FALSE(closed.resolved.has("close_ends"));
    REQUIRE(closed.resolved.has("closed"));
    CHECK(closed.resolved.list("closed")[0] > 10.0);
    check_replay("clip-opening", surface, closed);
    CHECK_THROWS_WITH(run("clip-opening", surface, {{"close_ends", std::vector<double>{9}}}),
                      Contains("there is no end 9"));
    CHECK_THROWS_WITH(run("clip-opening", surface, {{"open", std::vector<double>{90, 0, 0}}}),
                      Contains("no vessel end is near (90, 0, 0) mm"));
    CHECK_THROWS_AS(run("clip-opening", surface, {{"open", std::vector<double>{16, 0}}}),
                    UsageError);
}

SCENARIO("The opening of a branch that was removed later is left out", "[workbench][openings]") {
    const Surface surface = side_branched();
    const std::vector<double> end{16, 0, 20};
    const Surface left = *run("remove-branch", surface, {{"tip", Vec3(16, 0, 20)}}).scene.surface;
    const Surface tube = fine_tube(2.0, 20.0, 24);
    const Surface beside =
        mapped(tube.with_patches(PatchLabels(tube.triangle_count(), 0), {tube.patches[0]}),
               [](const Vec3& p) { return Vec3(p.z() + 5.0, p.x() + 30.0, p.y() + 20.0); });
    GIVEN("that its plane meets another vessel") {
        const Outcome all = run("clip-opening", surface, {{"open", end}});
        REQUIRE(all.scene.surface->patches.size() == 4);
        const Surface both = merged(left, beside);
        const Outcome again = run("clip-opening", both, all.resolved);
        CHECK(again.scene.surface->patches.size() == 3);
        CHECK(bounds(*again.scene.surface).max.x() == Approx(25.0));
        CHECK(std::ranges::count(again.warnings, "opening-gone", &Diagnostic::code) == 1);
        check_replay("clip-opening", both, again);
    }
    GIVEN("that it was the inlet") {
        const Outcome all = run("clip-opening", surface, {{"inlet", end}});
        REQUIRE(all.scene.surface->patches.size() == 4);
        CHECK_THROWS_WITH(run("clip-opening", left, all.resolved),
                          Contains("choose another inlet"));
    }
}

SCENARIO("The inlet beside one end is an opening that the point is at", "[workbench][openings]") {
    const Surface tube = open_tube(2.0, 30.0, 40, 90);
    const auto clipped = [&](const Surface& surface, const Vec3& tip, std::vector<double> inlet) {
        return run("clip-opening", surface,
                   {{"tip", tip}, {"distance", 12.0}, {"inlet", std::move(inlet)}});
    };
    GIVEN("a point at another end, which is not open") {
        CHECK_THROWS_WITH(
            clipped(tube, Vec3(0, 0, 30), {0, 0, 0}),
            Contains("near the inlet given, (0, 0, 0); the nearest one, inlet, is at"));
    }
    GIVEN("the tip itself, far from the cut") {
        const Outcome one = clipped(tube, Vec3(0, 0, 30), {0, 0, 30});
        CHECK(one.scene.surface->patches[1] == Patch{"inlet", PatchKind::Inlet});
        check_replay("clip-opening", tube, one);
        AND_GIVEN("then the other end as the inlet") {
            const Outcome other = run("clip-opening", *one.scene.surface,
                                      {{"tip", Vec3(0, 0, 0)}, {"inlet", std::vector{0., 0., 0.}}});
            const Surface& made = *other.scene.surface;
            REQUIRE(made.patches.size() == 3);
            CHECK(made.patches[1] == Patch{"inlet", PatchKind::Inlet});
            CHECK(patch_shape(made, 1).plane.point.z() < 5.0);
            CHECK(made.patches[2].kind == PatchKind::Outlet);
            check_replay("clip-opening", *one.scene.surface, other);
        }
    }
    GIVEN("that all ends are open, and another one shall be the inlet") {
        const Outcome all = run("clip-opening", tube, {{"inlet", std::vector{0., 0., 0.}}});
        const Outcome again =
            run("clip-opening", *all.scene.surface, {{"inlet", std::vector{0., 0., 30.}}});
        const Surface& made = *again.scene.surface;
        CHECK(patch_shape(made, 1).plane.point.z() == Approx(30.0));
        CHECK(made.patches[1] == Patch{"inlet", PatchKind::Inlet});
        CHECK(made.patches[2].kind == PatchKind::Outlet);
        check_replay("clip-opening", *all.scene.surface, again);
    }
}

SCENARIO("An open rim that is closed is named, however small", "[workbench][openings]") {
    const Surface tube = open_tube(2.0, 30.0, 40, 90);
    std::vector<bool> keep;
    for (const Triangle& t : tube.triangles())
        keep.push_back(std::ranges::none_of(
            t, [&](VertexId v) { return (tube.points()[v] - Vec3(2, 0, 15)).norm() < 0.35; }));
    const Outcome outcome = run("clip-opening", select_triangles(tube, keep), {});
    REQUIRE(outcome.report->at("openings").size() == 2);
    REQUIRE(outcome.warnings.size() == 1);
    CHECK(outcome.warnings[0].code == "end-decided");
    CHECK(outcome.warnings[0].place);
    CHECK(outcome.warnings[0].words.at("end") == "the open rim of end 3");
    CHECK(outcome.warnings[0].words.at("fate") == "closed");
}

SCENARIO("remove-branch leaves the parent's tube", "[workbench][openings]") {
    const Surface surface = side_branched();
    REQUIRE(tube_error(surface).distance > 12.0);
    const Outcome outcome = run("remove-branch", surface, {{"tip", Vec3(16, 0, 20)}});
    const Surface& left = *outcome.scene.surface;
    THEN("the branch is gone, and the wall in its place is the tube's") {
        CHECK(is_closed_manifold(left));
        CHECK(connectivity(*left.topology).components == 1);
        CHECK(connectivity(*left.topology).genus == 0);
        const TubeError error = tube_error(left);
        CHECK(error.distance < 0.06);  // 2 % of the radius
        CHECK(error.tilt_deg < 15.0);
    }
    THEN("the openings are as they were") {
        auto before = patch_sizes(surface), after = patch_sizes(left);
        CHECK(left.patches == surface.patches);
        CHECK(before.size() == 3);
        CHECK(after["inlet"] == before["inlet"]);
        CHECK(after["outlet_1"] == before["outlet_1"]);
    }
    THEN("the report says what went") {
        const auto& report = *outcome.report;
        const double tube = 2.0 * std::numbers::pi * 1.5 * 13.0;
        CHECK(report.at("removed_area_mm2").get<double>() > tube);
        CHECK(report.at("removed_area_mm2").get<double>() < 1.5 * tube);
        CHECK(report.at("follows_parent") == true);
        CHECK(report.at("new_triangles").get<int>() > 50);
        const auto mouth = report.at("mouth_mm");
        CHECK((Vec3(mouth[0], mouth[1], mouth[2]) - Vec3(3, 0, 20)).norm() < 0.5);
        check_replay("remove-branch", surface, outcome);
    }
}

SCENARIO("remove-branch names the branch by a point", "[workbench][openings]") {
    const Surface tube = open_tube(2.0, 30.0, 40, 90);
    CHECK_THROWS_AS(run("remove-branch", tube, {}), UsageError);
    CHECK_THROWS_AS(run("remove-branch", tube, {{"tip", Vec3(0, 0, 30)}}), AlgorithmFailure);
}

SCENARIO("The decisions of clip-opening are read back from its arguments", "[operations]") {
    const std::vector<PlannedOpening> openings = {
        {.place = {.tip = {1, 2, 3}, .plane = {{4, 5, 6}, {0, 0, 1}}}, .way = OpeningWay::KeepCap},
        {.place = {.tip = {7, 8, 9}, .plane = {{10, 11, 12}, {0, -1, 0}}}}};
    const Records planes = planes_argument(openings);
    const auto read = openings_in(planes);
    REQUIRE(read.size() == 2);
    CHECK(read[0].way == OpeningWay::KeepCap);
    CHECK(read[1].way == OpeningWay::Cut);
    CHECK(read[1].place.tip == Vec3(7, 8, 9));
    CHECK(read[1].place.plane.point == Vec3(10, 11, 12));
    CHECK(planes_argument(read) == planes);
    const PlannedOpening long_normal{.place = {.plane = {{0, 0, 0}, {0, 0, 2}}}};
    CHECK(openings_in(planes_argument({&long_normal, 1})).empty());
    const std::vector<Patch> patches = {{"inlet", PatchKind::Inlet}, {"a.b", PatchKind::Cut}};
    CHECK(patches_in(names_argument(patches)) == patches);
    const std::vector<PlannedClosing> closings = {{{1, 2, 3}, ClosingWay::WallCap},
                                                  {{4, 5, 6}, ClosingWay::RemoveStub}};
    const Records ends = closings_argument(closings);
    CHECK(closings_argument(closings_in(ends)) == ends);
    THEN("the flat lists of earlier versions give the same") {
        const auto flat = [](const char* name, const Value& value) {
            return checked_value(find_parameter(find_operation("clip-opening"), name), value);
        };
        CHECK(flat("planes", std::vector<double>{1, 2, 3, 4,  5,  6,  0, 0,  1, 1,
                                                 7, 8, 9, 10, 11, 12, 0, -1, 0, 0}) ==
              Value(planes));
        CHECK(flat("names", "inlet:inlet,cut:a.b") == Value(names_argument(patches)));
        CHECK(flat("closings", std::vector<double>{1, 2, 3, 1, 4, 5, 6, 2}) == Value(ends));
        CHECK_THROWS_AS(flat("closings", std::vector<double>{1, 2, 3, 7}), UsageError);
        CHECK_THROWS_AS(flat("names", "inlet:inlet,outlet"), UsageError);
    }
}
