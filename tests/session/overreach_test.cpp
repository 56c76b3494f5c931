// No edit takes more than it says: operations that do other than they state are refused, with what
// they did, and the model stays.

#include "workbench/session/overreach.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include <catch2/catch.hpp>

#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/edges.h"
#include "tests/session/small_operations.h"
#include "tests/session/sphere_session.h"
#include "tests/support/shapes.h"
#include "workbench/session/changed_wall.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

const Vec3 kPole(0, 0, 10);      ///< middle of the zone that is stated
constexpr double kZone = 6.0;    ///< its radius [mm]
constexpr double kCut = 8.5;     ///< height of the cut in the zone [mm]
constexpr double kStated = 1.0;  ///< [mm] of wall, [mm^3] of volume

/// A large sphere around the origin and a small one beside it.
Surface two_spheres() {
    const Surface large = icosphere(10.0, 3), small = icosphere(2.0, 2, {20, 0, 0});
    Positions points = large.points();
    points.insert(points.end(), small.points().begin(), small.points().end());
    std::vector<Triangle> triangles(large.triangles().begin(), large.triangles().end());
    const auto first = static_cast<VertexId>(large.vertex_count());
    for (const auto& [a, b, c] : small.triangles())
        triangles.push_back({a + first, b + first, c + first});
    return make_surface(std::move(points), std::move(triangles));
}

Surface with_moved(const Surface& surface, const std::function<Vec3(const Vec3&)>& map) {
    return mapped(surface, map);
}

/// Cut flat in the zone.
Surface flattened(const Surface& surface) {
    return with_moved(surface, [](const Vec3& p) {
        return (p - kPole).norm() < kZone ? Vec3(p.x(), p.y(), std::min(p.z(), kCut)) : p;
    });
}

Surface without(const Surface& surface, const std::function<bool(const Vec3&)>& goes) {
    std::vector<bool> keep;
    for (const Triangle& t : surface.triangles())
        keep.push_back(
            std::ranges::none_of(t, [&](VertexId v) { return goes(surface.points()[v]); }));
    return select_triangles(surface, keep);
}

/// The same triangles in another order.
Surface renumbered(const Surface& surface) {
    std::vector<Triangle> triangles(surface.triangles().rbegin(), surface.triangles().rend());
    for (Triangle& t : triangles) std::ranges::rotate(t, t.begin() + 1);
    return make_surface(surface.points(), std::move(triangles));
}

Surface changed(const Surface& surface, const std::string& how) {
    const auto lifted = [&](const Vec3& at, const Vec3& by) {
        return with_moved(surface,
                          [&](const Vec3& p) { return (p - at).norm() < 1e-6 ? Vec3(p + by) : p; });
    };
    if (how == "as stated") return renumbered(lifted(kPole, {0, 0, 0.01}));
    if (how == "elsewhere") return lifted({0, 0, -10}, {0, 0, 1e-12});
    if (how == "elsewhere, renumbered") return renumbered(changed(surface, "elsewhere"));
    if (how == "a part") return without(surface, [](const Vec3& p) { return p.x() > 15.0; });
    if (how == "a hole") return without(surface, [](const Vec3& p) { return p.z() > 9.9; });
    if (how == "a sac" || how == "volume") return flattened(surface);
    if (how == "rubble")
        return with_moved(surface, [](const Vec3& p) {
            const double spike = 1.0 + 0.3 * std::sin(40.0 * p.x() + 30.0 * p.y());
            return (p - kPole).norm() < kZone ? Vec3(spike * p) : p;
        });
    if (how == "a crossing") return lifted(kPole, {0, 0, -21});
    return surface;
}

StatedChange stated(const std::string& how) {
    StatedChange stated{.zones = {{{kPole, kZone}}}, .keeps_walls_apart = true};
    if (how == "volume") stated.volume_lost = kStated;
    if (how == "a sac" || how == "as stated") stated.wall_lost = kStated;
    if (how == "triangles") stated.keeps_triangles = true;
    if (how == "rubble") stated.folded = 0.01;
    if (how == "a doubt") stated.doubt = plain_text("its own figures speak against it");
    return stated;
}

Scene scene_of(Surface surface) {
    Scene scene;
    scene.surface = std::move(surface);
    return scene;
}

/// The code of what a change does beyond what it states; empty: nothing.
std::string caught(const std::string& how) {
    const Surface before = two_spheres();
    Surface after = changed(before, how);
    if (how == "triangles") after = renumbered(before);
    const auto found = overreach(stated(how), scene_of(before), scene_of(after));
    return found ? found->code : "";
}

/// Whether the row below is honest; replays of older edits meet rows that state less than before.
bool states_all = true;

Operation lying_row(const char* name, const char* like) {
    Operation row = find_test_operation(like);
    row.name = name;
    row.may_change = [](const Scene&, const Outcome&) {
        return states_all ? StatedChange{} : StatedChange{.zones = {{{kTop, 0.1}}}};
    };
    return row;
}

SessionOptions with_liar() {
    static const Operation liar = lying_row("lie", "bump"), live = lying_row("live-lie", "stroke");
    SessionOptions made = options();
    made.find = [](const std::string& name) -> const Operation& {
        if (name == "live-lie") return live;
        return name == "lie" ? liar : find_test_operation(name);
    };
    return made;
}

}  // namespace

SCENARIO("A change of a surface is compared with what was stated", "[session][overreach]") {
    CHECK(caught("nothing") == "");
    CHECK(caught("as stated") == "");
    CHECK(caught("elsewhere") == "edit-leaves-zone");
    CHECK(caught("elsewhere, renumbered") == "edit-leaves-zone");
    CHECK(caught("a part") == "edit-changes-parts");
    CHECK(caught("a hole") == "edit-changes-rims");
    CHECK(caught("a sac") == "edit-loses-wall");
    CHECK(caught("volume") == "edit-changes-volume");
    CHECK(caught("a crossing") == "edit-crosses-walls");
    CHECK(caught("rubble") == "edit-folds-wall");
    CHECK(caught("triangles") == "edit-changes-triangles");
    CHECK(caught("a doubt") == kPlainText);
}

SCENARIO("What is beyond the statement is named with place and figures", "[session][overreach]") {
    const Scene before = scene_of(two_spheres());
    const auto of = [&](const std::string& how) {
        return overreach(stated(how), before, scene_of(changed(*before.surface, how))).value();
    };
    CHECK((of("elsewhere").place.value() - Vec3(0, 0, -10)).norm() < 3.0);
    const Diagnostic sac = of("a sac");
    CHECK((sac.place.value() - kPole).norm() < 1e-6);
    CHECK(sac.figures.at("distance_mm") == Approx(10.0 - kCut));
    CHECK(sac.severity == Severity::Error);
    CHECK(of("a part").figures.at("before") == 2.0);
    CHECK(of("a part").figures.at("after") == 1.0);
}

SCENARIO("A scene without a surface has nothing to lose", "[session][overreach]") {
    CHECK_FALSE(overreach(stated("a sac"), {}, scene_of(two_spheres())));
    CHECK_FALSE(overreach(stated("a sac"), scene_of(two_spheres()), {}));
}

SCENARIO("Crossings that were there are no reason to refuse", "[session][overreach]") {
    const Surface crossed = changed(two_spheres(), "a crossing");
    const Surface moved = with_moved(crossed, [](const Vec3& p) {
        return p.z() < -10.5 ? Vec3(p.x(), p.y(), p.z() + 0.01) : p;
    });
    StatedChange everywhere{.keeps_walls_apart = true};
    CHECK_FALSE(overreach(everywhere, scene_of(crossed), scene_of(moved)));
    CHECK(overreach(everywhere, scene_of(two_spheres()), scene_of(moved)).has_value());
}

SCENARIO("An edit that takes more than its operation states is refused, whoever asks",
         "[session][overreach]") {
    Session session = Session::unsaved(with_liar());
    session.apply("make-sphere", {});
    const double top = top_of(session.scene());
    const Arguments bump{{"at", kTop}, {"reach", 4.0}, {"height", 0.5}};
    states_all = false;
    CHECK_THROWS_AS(session.apply("lie", bump), DiagnosedFailure);
    CHECK_THROWS_AS(session.preview("lie", bump), DiagnosedFailure);
    LiveEdit live = session.start_live("live-lie", {{"heights", std::vector<double>{0.5}}});
    CHECK_THROWS_AS(session.preview(live), DiagnosedFailure);
    CHECK(session.log().size() == 1);
    CHECK(top_of(session.scene()) == top);
    try {
        session.apply("lie", bump);
    } catch (const DiagnosedFailure& failure) {
        CHECK(failure.diagnostics().front().code == "edit-leaves-zone");
        CHECK(failure.diagnostics().front().operation == "lie");
        CHECK(failure.diagnostics().front().place.has_value());
    }
    states_all = true;
    CHECK(session.apply("lie", bump).status == EditStatus::Done);
    CHECK(top_of(session.scene()) == Approx(top + 0.5));
}

SCENARIO("An older edit keeps its bits on its own input, with a warning", "[session][overreach]") {
    states_all = true;
    Session session = Session::unsaved(with_liar());
    session.apply("make-sphere", {});
    const Arguments bump{{"at", kTop}, {"reach", 4.0}, {"height", 0.5}};
    session.apply("lie", bump);
    const Scene before = session.scene();
    states_all = false;
    THEN("a replay gives the same bits, and says so") {
        const auto replayed = session.replay();
        REQUIRE(replayed.size() == 2);
        CHECK(replayed[1].differences.empty());
        CHECK_FALSE(replayed[1].note.empty());
        CHECK(replayed[0].note.empty());
    }
    THEN("it runs again where what precedes it gives the same input") {
        session.change_edit(1, {{"radius", 10.0}});
        CHECK(session.scene().surface->points() == before.surface->points());
        REQUIRE(session.log()[1].status == EditStatus::Done);
        REQUIRE(session.log()[1].result->warnings.size() == 1);
        CHECK(session.log()[1].result->warnings[0].code == "edit-leaves-zone");
        CHECK(session.log()[1].result->warnings[0].severity == Severity::Warning);
    }
    THEN("on another input it no longer applies") {
        session.change_edit(1, {{"radius", 10.5}});
        (void)session.scene();
        CHECK(session.log()[1].status == EditStatus::Stale);
    }
    states_all = true;
}
