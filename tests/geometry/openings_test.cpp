#include "geometry/vessel/openings/openings.h"

#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "geometry/formats/surface_file.h"
#include "geometry/kernel/errors.h"
#include "geometry/vessel/centerlines/centerlines.h"
#include "geometry/vessel/openings/clip.h"
#include "geometry/vessel/openings/clip_openings.h"
#include "geometry/vessel/openings/cut_trial.h"
#include "geometry/vessel/openings/flat_caps.h"
#include "geometry/vessel/openings/opening_axis.h"
#include "geometry/vessel/repair/repair.h"
#include "tests/support/shapes.h"
#include "tests/support/surface_facts.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

constexpr double kPi = std::numbers::pi;

/// Where the axis of a bent tube lies at arc length z, and where its x axis points.
struct AxisPoint {
    Vec3 position, x;
};

using Path = std::function<AxisPoint(double)>;

/// Straight for `straight`, then a circle of radius `bend` through `angle`, then straight again.
Path hairpin(double straight, double bend, double angle) {
    return [=](double z) -> AxisPoint {
        const double arc = std::clamp((z - straight) / bend, 0.0, angle);
        const double after = std::max(0.0, z - straight - bend * angle);
        const double before = std::min(z, straight);
        return {Vec3(bend * (1 - std::cos(arc)) + after * std::sin(arc), 0.0,
                     before + bend * std::sin(arc) + after * std::cos(arc)),
                Vec3(std::cos(arc), 0.0, -std::sin(arc))};
    };
}

Surface bent(const Surface& tube, const Path& path) {
    return mapped(tube, [&](const Vec3& p) {
        const auto at = path(p.z());
        return Vec3(at.position + p.x() * at.x + p.y() * Vec3::UnitY());
    });
}

CenterlineGraph line_graph(const Path& path, double length, double radius, double end_gap = 0.0) {
    CenterlineGraph graph;
    CenterlineBranch branch{.start_node = 0, .end_node = 1, .points = {}, .radii = {}};
    const int n = 200;
    for (int i = 0; i <= n; ++i) {
        branch.points.push_back(path(end_gap + (length - 2 * end_gap) * i / n).position);
        branch.radii.push_back(radius);
    }
    graph.nodes = {{branch.points.front(), radius, {0}}, {branch.points.back(), radius, {0}}};
    graph.branches = {branch};
    return graph;
}

Path straight_line() {
    return [](double z) { return AxisPoint{Vec3(0, 0, z), Vec3::UnitX()}; };
}

/// Bent at its end, by so many degrees over one diameter, and less by `less` for each radius
/// inward.
Path straightening(double radius, double length, double bend_deg, double less) {
    const double step = 0.02;
    Positions points;
    std::vector<double> angles;
    double angle = 0.0;
    Vec3 at = Vec3::Zero();
    for (double z = 0.0; z < length + 1.0; z += step) {
        points.push_back(at);
        angles.push_back(angle);
        angle += std::max(0.0, bend_deg - less * z / radius) * kPi / 180.0 / (2.0 * radius) * step;
        at += step * Vec3(std::sin(angle), 0.0, std::cos(angle));
    }
    return [=](double z) -> AxisPoint {
        const auto i = static_cast<std::size_t>(std::lround(std::max(0.0, z) / step));
        return {points[i], Vec3(std::cos(angles[i]), 0.0, -std::sin(angles[i]))};
    };
}

/// Share of a regular polygon's area in its circle's.
double polygon_share(int corners) {
    return corners / (2.0 * kPi) * std::sin(2.0 * kPi / corners);
}

Surface clipped_by(const Surface& surface, const OpeningPlan& plan, const InletChoice& inlet = {}) {
    ClippedSurface clipped = clip_openings(surface, plan, inlet);
    CHECK(clipped.failed.empty());
    return clipped.surface;
}

void check_caps(const Surface& s, std::size_t openings, double most_tilt = 2.0) {
    CHECK(is_closed_manifold(s));
    REQUIRE(s.patches.size() == openings + 1);
    for (std::size_t p = 1; p <= openings; ++p) {
        CHECK(patch_shape(s, p).flatness < 1e-9);
        INFO(s.patches[p].name << " tilt " << opening_tilt_deg(s, p));
        CHECK(opening_tilt_deg(s, p) < most_tilt);
    }
}

}  // namespace

SCENARIO("A cut moves inward only for a place that is clearly straighter", "[geometry][openings]") {
    const double radius = 2.0, length = 120.0;
    // From its end the vessel straightens as fast as giving up length costs: little is gained.
    const Path path = straightening(radius, length, 25.0, 6.0);
    const Surface tube = bent(open_tube(radius, length, 48, 480), path);
    const OpeningPlace place = choose_opening_place(tube, line_graph(path, length, radius), 0);
    CHECK(place.distance < 1.2 * radius);
    CHECK(place.tilt_deg < 0.1);
}

SCENARIO("A side branch without a line of its own ends the branch that a cut may shorten",
         "[geometry][openings]") {
    const double radius = 2.0, length = 120.0, furcation = 24.0;
    const Path path = straightening(radius, length, 45.0, 12.0);
    const CenterlineGraph line = line_graph(path, length, radius);
    const Surface tube = open_tube(radius, length, 48, 480);
    GIVEN("a long vessel that straightens from its end on") {
        const OpeningPlace place = choose_opening_place(bent(tube, path), line, 0);
        THEN("the cut moves to where it is straight") {
            CHECK(place.distance > 2.0 * radius);
        }
    }
    GIVEN("the same with a short side branch, which bulges its wall only") {
        const Surface bulged = mapped(tube, [&](const Vec3& p) {
            const double along = (p.z() - furcation) / radius;
            const double out = p.x() > 0.0 ? 1.0 + 0.6 * std::exp(-along * along) : 1.0;
            return Vec3(out * p.x(), p.y(), p.z());
        });
        const OpeningPlace place = choose_opening_place(bent(bulged, path), line, 0);
        THEN("nine tenths of what lies before it are kept") {
            CHECK(place.distance < 0.1 * (furcation - radius));
        }
    }
}

SCENARIO("A tube is clipped at a known place", "[geometry][openings]") {
    const double radius = 2.0, length = 30.0;
    const int around = 40;
    const Surface tube = open_tube(radius, length, around, 90);
    const auto graph = line_graph(straight_line(), length, radius);
    const double area = kPi * radius * radius * polygon_share(around);
    GIVEN("a distance from one tip") {
        const auto plan = plan_openings(tube, graph, {.tip = Vec3(0, 0, 30), .distance = 7.1});
        REQUIRE(plan.openings.size() == 1);
        const Surface clipped = clipped_by(tube, plan);
        THEN("only that end is cut and capped") {
            REQUIRE(clipped.patches.size() == 2);
            CHECK(clipped.patches[1].kind == PatchKind::Inlet);
            CHECK(patch_shape(clipped, 1).plane.point.z() == Approx(22.9));
            CHECK(patch_shape(clipped, 1).area == Approx(area).epsilon(2e-3));
            CHECK(clipped.topology->boundary_loops().size() == 1);
        }
    }
    GIVEN("both ends at a distance") {
        const Surface clipped = clipped_by(tube, plan_openings(tube, graph, {.distance = 5.03}));
        THEN("the volume is that of the shorter tube") {
            check_caps(clipped, 2);
            CHECK(enclosed_volume(clipped) == Approx(area * (length - 10.06)).epsilon(2e-3));
            CHECK(clipped.patches[1] == Patch{"inlet", PatchKind::Inlet});
            CHECK(clipped.patches[2] == Patch{"outlet_1", PatchKind::Outlet});
            CHECK(smallest_angle_deg(clipped) > 15.0);
        }
    }
    GIVEN("the same tube, turned") {
        const auto turn = [](const Vec3& p) -> Vec3 { return skew_rotation() * p; };
        const Surface turned = mapped(tube, turn);
        const auto turned_graph = line_graph(
            [&](double z) {
                return AxisPoint{turn(Vec3(0, 0, z)), turn(Vec3::UnitX())};
            },
            length, radius);
        const Surface clipped =
            clipped_by(turned, plan_openings(turned, turned_graph, {.strict = true}));
        const Surface upright = clipped_by(tube, plan_openings(tube, graph, {.strict = true}));
        THEN("the result is as that of the upright one") {
            check_caps(clipped, 2);
            CHECK(enclosed_volume(clipped) == Approx(enclosed_volume(upright)).epsilon(1e-6));
        }
    }
    GIVEN("a distance beyond the branch") {
        CHECK_THROWS_AS(plan_openings(tube, graph, {.tip = Vec3(0, 0, 0), .distance = 31.0}),
                        AlgorithmFailure);
        CHECK_THROWS_AS(plan_openings(tube, graph, {.tip = Vec3(50, 0, 0)}), AlgorithmFailure);
    }
}

SCENARIO("Openings of closed, open and capped surfaces", "[geometry][openings]") {
    const auto graph = line_graph(straight_line(), 30.0, 2.0);
    GIVEN("a tube closed by flat ends that nobody labelled") {
        const Surface labelled = closed_tube(2.0, 30.0, 40, 90);
        const Surface tube = make_surface(
            labelled.points(), {labelled.triangles().begin(), labelled.triangles().end()});
        const Surface clipped = clipped_by(tube, plan_openings(tube, graph));
        THEN("both ends are cut a little inside") {
            check_caps(clipped, 2);
            CHECK(enclosed_volume(clipped) < enclosed_volume(tube));
            CHECK(enclosed_volume(clipped) > 0.8 * enclosed_volume(tube));
        }
    }
    GIVEN("a tube open at one end and closed at the other") {
        const Surface labelled = closed_tube(2.0, 30.0, 40, 90);
        std::vector<Triangle> triangles;
        for (TriangleId t = 0; t < labelled.triangle_count(); ++t)
            if (labelled.patch_of(t).name != "inlet") triangles.push_back(labelled.triangles()[t]);
        const Surface tube = make_surface(labelled.points(), triangles);
        REQUIRE(tube.topology->boundary_loops().size() == 1);
        THEN("the closed end is opened as well: blood comes and goes") {
            check_caps(clipped_by(tube, plan_openings(tube, graph)), 2);
        }
    }
    GIVEN("a short tube whose end was cut so obliquely that half of it has no whole section") {
        const Surface tube = mapped(open_tube(2.0, 8.0, 40, 40), [](const Vec3& p) {
            return Vec3(p.x(), p.y(), p.z() + 2.0 * p.x() * p.z() / 8.0);
        });
        const auto plan =
            plan_openings(tube, line_graph(straight_line(), 8.0, 2.0), {.strict = true});
        THEN("it is opened beyond its middle, and what that costs is told") {
            check_caps(clipped_by(tube, plan), 2);
            REQUIRE_FALSE(plan.warnings.empty());
            CHECK(plan.warnings[0].code == "opening-shortens-branch");
        }
    }
    GIVEN("a tube with known, perpendicular caps") {
        const Surface tube = closed_tube(2.0, 30.0, 40, 90);
        const auto plan = plan_openings(tube, graph);
        THEN("the caps stay") {
            REQUIRE(plan.openings.size() == 2);
            CHECK(plan.openings[0].way == OpeningWay::KeepCap);
            const Surface clipped = clipped_by(tube, plan);
            CHECK(clipped.triangle_count() == tube.triangle_count());
            CHECK(clipped.patches == tube.patches);
        }
        THEN("the user may say which one is the inlet") {
            const Surface swapped = clipped_by(tube, plan, {.points = {Vec3(0, 0, 30)}});
            CHECK(swapped.patches[1].kind == PatchKind::Inlet);
            CHECK(patch_shape(swapped, 1).plane.point.z() == Approx(30.0));
        }
    }
    GIVEN("a vessel that narrows, whose narrow end is cut obliquely") {
        const Surface tube = mapped(open_tube(2.0, 30.0, 40, 90), [](const Vec3& p) {
            const double width = 1.0 - 0.05 * p.z() / 30.0;
            const double share = std::clamp((p.z() - 15.0) / 15.0, 0.0, 1.0);
            return Vec3(width * p.x(), width * p.y(), p.z() + share * p.x());
        });
        THEN("its rims are kept, and blood flows in at the wide end, though that rim is smaller") {
            const Surface clipped = clipped_by(tube, plan_openings(tube, graph));
            const PatchShape inlet = patch_shape(clipped, 1), outlet = patch_shape(clipped, 2);
            CHECK(clipped.patches[1].kind == PatchKind::Inlet);
            CHECK(inlet.plane.point.z() == Approx(0.0).margin(0.1));
            CHECK(outlet.area > 1.2 * inlet.area);
        }
    }
    GIVEN("a tube with known but oblique caps") {
        const Surface tube = mapped(closed_tube(2.0, 30.0, 40, 90), [](const Vec3& p) {
            const double share = std::clamp((p.z() - 15.0) / 15.0, 0.0, 1.0);
            return Vec3(p.x(), p.y(), p.z() + share * 0.4 * p.x());
        });
        THEN("they stay as they are") {
            const Surface kept = clipped_by(tube, plan_openings(tube, graph));
            CHECK(kept.points() == tube.points());
            CHECK(kept.patches == tube.patches);
        }
        THEN("cut strictly, they become perpendicular and keep their names") {
            const Surface clipped = clipped_by(tube, plan_openings(tube, graph, {.strict = true}));
            check_caps(clipped, 2);
            CHECK(clipped.patches[1].name == "inlet");
            CHECK(clipped.patches[2].name == "outlet_1");
        }
    }
}

SCENARIO("A plane that meets two vessels cuts only one", "[geometry][openings]") {
    const auto path = hairpin(20.0, 6.0, kPi);
    const double length = 40.0 + 6.0 * kPi;
    const Surface tube = bent(open_tube(2.0, length, 40, 180), path);
    const auto graph = line_graph(path, length, 2.0);
    const Plane plane{Vec3(0, 0, 8.05), -Vec3::UnitZ()};
    REQUIRE(cross_sections(tube, plane).size() == 2);
    const Surface clipped = clip_branch(tube, plane, {"outlet_1", PatchKind::Outlet});
    THEN("the other leg stays whole") {
        REQUIRE(clipped.topology->boundary_loops().size() == 1);
        const Vec3 far = path(length).position;
        double nearest = 1e9;
        for (const Vec3& p : clipped.points()) nearest = std::min(nearest, (p - far).norm());
        CHECK(nearest < 2.1);
        const double area = kPi * 4.0 * polygon_share(40);
        const Surface both = clipped_by(tube, plan_openings(tube, graph, {.distance = 8.05}));
        check_caps(both, 2);
        CHECK(enclosed_volume(both) == Approx(area * (length - 16.1)).epsilon(5e-3));
    }
}

SCENARIO("Openings in a bend are perpendicular and named", "[geometry][openings]") {
    const double bend = 8.0, length = bend * kPi / 2.0;
    const auto path = hairpin(0.0, bend, kPi / 2.0);
    const Surface tube = bent(open_tube(1.5, length, 40, 60), path);
    const auto plan = plan_openings(tube, line_graph(path, length, 1.5), {.strict = true});
    THEN("a bend is warned of with its angle") {
        // One diameter is an arc of 3 / 8 rad = 21.5 degrees.
        REQUIRE(plan.openings.size() == 2);
        CHECK(plan.openings[0].place.bend_deg == Approx(21.5).epsilon(0.1));
        CHECK(plan.warnings.size() == 2);
    }
    THEN("the caps are perpendicular to the axis inside") {
        check_caps(clipped_by(tube, plan), 2);
    }
    THEN("a straight stretch is preferred") {
        const auto hook = hairpin(5.0, bend, kPi / 2.0);
        const Surface hooked = bent(open_tube(1.5, length + 5.0, 40, 80), hook);
        const auto straight = plan_openings(hooked, line_graph(hook, length + 5.0, 1.5),
                                            {.tip = hook(0.0).position, .strict = true});
        CHECK(straight.openings[0].place.bend_deg < 1.5);
        CHECK(straight.warnings.empty());
    }
}

SCENARIO("Staircases do not turn an opening away from its vessel", "[geometry][openings]") {
    // A tube that turns by 0.1 rad per diameter. Each section is aside, and wider or narrower, by
    // 2 % of the diameter: what steps one diameter long leave after smoothing.
    const double radius = 2.0, bend = 40.0, length = bend * kPi / 2.0;
    const auto path = hairpin(0.0, bend, kPi / 2.0);
    const auto stepped = [&](double aside, double phase) {
        const double wave = 2.0 * kPi / (2.0 * radius);
        return bent(mapped(open_tube(radius, length, 40, 400),
                           [&](const Vec3& p) {
                               const double angle = wave * p.z() + phase;
                               const double wider = 1.0 + aside / radius * std::sin(angle + 1.0);
                               return Vec3(wider * p.x() + aside * std::sin(angle),
                                           wider * p.y() + aside * std::cos(angle), p.z());
                           }),
                    path);
    };
    const auto graph = line_graph(path, length, radius);
    const auto place_of = [&](const Surface& surface) {
        return choose_opening_place(surface, graph, 0);
    };
    const auto tilt = [&](const OpeningPlace& place) {
        const double arc = std::atan2(place.plane.point.z(), bend - place.plane.point.x());
        return angle_deg(place.plane.normal, -Vec3(std::sin(arc), 0.0, std::cos(arc)));
    };
    const OpeningPlace smooth = place_of(stepped(0.0, 0.0));
    CHECK(smooth.doubt_deg < 0.5);
    CHECK(tilt(smooth) < 1.0);
    for (const double phase : {0.0, 1.5, 3.0, 4.5}) {
        const OpeningPlace place = place_of(stepped(0.02 * 2.0 * radius, phase));
        INFO("phase " << phase);
        CHECK(tilt(place) < 2.0);
        CHECK(place.distance > smooth.distance);  // where the vessel on both sides shows the way
        CHECK(place.distance < 0.1 * length);
        CHECK(place.doubt_deg > smooth.doubt_deg);
    }
}

SCENARIO("Attributes and patches are carried over when a branch is cut", "[geometry][openings]") {
    Surface tube = open_tube(2.0, 30.0, 40, 90);
    std::vector<double> height;
    for (const Vec3& p : tube.points()) height.push_back(p.z());
    tube.attributes["height"] = std::make_shared<const std::vector<double>>(height);
    const Plane plane{Vec3(0, 0, 20.2), Vec3(0.1, 0, 1).normalized()};
    const Surface clipped = clip_branch(tube, plane, {"outlet_1", PatchKind::Outlet});
    const auto& kept = *clipped.attributes.at("height");
    REQUIRE(kept.size() == clipped.vertex_count());
    double worst = 0.0;
    for (std::size_t v = 0; v < kept.size(); ++v)
        if (clipped.points()[v].z() < 19.5)
            worst = std::max(worst, std::abs(kept[v] - clipped.points()[v].z()));
    CHECK(worst < 1e-12);
    CHECK(clipped.patches[1] == Patch{"outlet_1", PatchKind::Outlet});
}

SCENARIO("A cut that would remove another vessel's end is refused", "[geometry][openings]") {
    const double length = 30.0;
    const Surface tube = open_tube(2.0, length, 40, 90);
    const auto graph = line_graph(straight_line(), length, 2.0);
    const auto ends = find_surface_ends(tube, graph);
    REQUIRE(ends.size() == 2);
    const std::size_t upper = ends[0].centre.z() > 15.0 ? 0 : 1;
    CutTrials trials(tube, graph, ends, std::vector<double>(ends.size(), 0.0));
    OpeningPlace place{.tip = ends[upper].centre,
                       .plane = {Vec3(0, 0, 25.1), Vec3::UnitZ()},
                       .distance = 5.0,
                       .diameter = 4.0};
    CHECK(trials.problem_of(place, upper).empty());
    THEN("a plane that faces the other end is") {
        place.plane.normal = -Vec3::UnitZ();
        CHECK_THAT(trials.problem_of(place, upper), Catch::Contains("remove the vessel's end"));
    }
    THEN("a plane along the vessel is") {
        place.plane = {Vec3(1.0, 0, 15.0), Vec3::UnitX()};
        CHECK_FALSE(trials.problem_of(place, upper).empty());
    }
    THEN("a plane in the way of an earlier cut is") {
        static_cast<void>(trials.problem_of(place, upper));
        trials.take();
        place.plane.point.z() = 25.3;
        CHECK_THAT(trials.problem_of(place, upper), Catch::Contains("another opening"));
    }
    THEN("one that is much wider than the end's own vessel is") {
        CutTrials of_branch(tube, graph, ends, {1.5, 1.5});
        CHECK_THAT(of_branch.problem_of(place, upper),
                   Catch::Contains("4 mm wide, but the vessel is 1.5 mm wide"));
    }
    THEN("one where the wall lies inside out is") {
        const Surface outer = open_tube(4.0, length, 40, 90);
        Positions points = tube.points();
        points.insert(points.end(), outer.points().begin(), outer.points().end());
        std::vector<Triangle> triangles;
        for (const auto& [a, b, c] : tube.triangles()) triangles.push_back({b, a, c});
        const auto first = static_cast<VertexId>(tube.vertex_count());
        for (const auto& [a, b, c] : outer.triangles())
            triangles.push_back({first + a, first + b, first + c});
        const Surface folded = make_surface(points, triangles);
        CutTrials in_fold(folded, graph, ends, std::vector<double>(ends.size(), 0.0));
        CHECK_THAT(in_fold.problem_of(place, upper), Catch::Contains("inside out"));
    }
}

SCENARIO("Cutting fails with a clear text where it cannot be done", "[geometry][openings]") {
    const Surface tube = open_tube(2.0, 30.0, 40, 90);
    CHECK_THROWS_WITH(cut_branch(tube, {Vec3(0, 0, 40), Vec3::UnitZ()}),
                      Catch::Contains("does not meet"));
    CHECK_THROWS_WITH(cut_branch(tube, {Vec3(0, 0, 29.9), Vec3(1, 0, 1).normalized()}),
                      Catch::Contains("open border"));
    GIVEN("a ring: no plane separates it") {
        Positions points;
        std::vector<Triangle> triangles;
        const int n = 48, m = 24;
        for (int i = 0; i < n; ++i)
            for (int j = 0; j < m; ++j) {
                const double a = 2 * kPi * i / n, b = 2 * kPi * j / m;
                points.emplace_back((8 + 2 * std::cos(b)) * std::cos(a),
                                    (8 + 2 * std::cos(b)) * std::sin(a), 2 * std::sin(b));
            }
        const auto id = [&](int i, int j) { return static_cast<VertexId>(i % n * m + j % m); };
        for (int i = 0; i < n; ++i)
            for (int j = 0; j < m; ++j) {
                triangles.push_back({id(i, j), id(i + 1, j), id(i + 1, j + 1)});
                triangles.push_back({id(i, j), id(i + 1, j + 1), id(i, j + 1)});
            }
        const Surface ring = make_surface(points, triangles);
        CHECK_THROWS_WITH(cut_branch(ring, {Vec3(8, 0.1, 0), Vec3::UnitY()}),
                          Catch::Contains("does not separate"));
    }
}

SCENARIO("Ends of real vessels are opened perpendicular and flat", "[geometry][openings][data]") {
    struct Case {
        const char* file;
        std::size_t openings;
    };

    const auto c = GENERATE(Case{"surfaces/vmtk_aorta_surface.stl", 3},
                            Case{"surfaces/vmtk_aorta_surface_open_ends.stl", 3},
                            Case{"surfaces/vampy_aneurisk_C0015_artery.vtp", 3},
                            Case{"surfaces/vampy_vein.stl", 2},
                            Case{"surfaces/vasp_small_aneurysm_fluidboundary.vtp", 3},
                            Case{"surfaces/jk_carotid_left_lumen_capped.stl", 3});
    const auto path = shared_data(c.file);
    if (path.empty()) return;
    INFO(c.file);
    const Surface surface = label_flat_faces(repair(read_surface(path).surface).surface);
    const auto lines = compute_centerlines(surface);
    // In a bend, the axis behind the cut depends on the cut.
    check_caps(clipped_by(surface, plan_openings(surface, lines, {.strict = true})), c.openings,
               8.0);
    const Surface opened = clipped_by(surface, plan_openings(surface, lines));
    CHECK(is_closed_manifold(opened));
    CHECK(opened.patches.size() == c.openings + 1);
}
