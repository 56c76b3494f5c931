// Operations that lie at random: what an outcome does beyond what its operation states is refused,
// with its place, and no outcome that keeps to the statement is.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>

#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/edges.h"
#include "geometry/kernel/vertex_normals.h"
#include "tests/support/iso_surface.h"
#include "tests/support/shapes.h"
#include "tests/support/surface_facts.h"
#include "tests/support/touching_vessels.h"
#include "workbench/case/stated_change.h"
#include "workbench/session/guarded_run.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

constexpr std::uint64_t kVessels = 12;
constexpr double kCell = 0.5;    ///< of the sampling grid [mm]
constexpr double kAbove = 1.05;  ///< a statement just above what is done, by the grid's error [-]
constexpr double kBranch = 0.6;  ///< radius of the loop [trunk radii]
constexpr double kFoldDoubt = 0.01;  ///< share of folded edges that a statement allows [-]

/// The same numbers with every standard library.
class Random {
public:
    explicit Random(std::uint64_t seed) : engine_(seed) {}

    double between(double low, double high) {
        return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1.0p-53;
    }

    bool coin() { return (engine_() >> 63) != 0; }

    Vec3 direction() {
        const double z = between(-1.0, 1.0), angle = between(0.0, 2.0 * std::numbers::pi);
        const double across = std::sqrt(1.0 - z * z);
        return {across * std::cos(angle), across * std::sin(angle), z};
    }

private:
    std::mt19937_64 engine_;
};

/// What an operation may leave out of a vessel, or add to it.
struct Parts {
    bool sac = true, loop = true, ball = true, open = true, plug = false;
    double shortened = 0.0;  ///< at its closed end [mm]
};

/// A trunk along z, open at z = 0 and closed at its other end, with a sac at +x, a loop at -x and a
/// ball beside it at +y, which is a part of its own. Sizes and pose are random.
class Vessel {
public:
    explicit Vessel(Random& random)
        : radius(random.between(1.8, 2.4)),
          length(random.between(12.0, 14.0) * radius),
          sac(random.between(1.1, 1.5) * radius),
          pose_(Eigen::Translation3d(random.between(0.0, 100.0) * random.direction()) *
                Eigen::AngleAxisd(random.between(0.0, std::numbers::pi), random.direction())) {}

    [[nodiscard]] Surface made(const Parts& parts = {}) const {
        const Eigen::AlignedBox3d box(
            Vec3(-reach() - 2.0 * radius, -3.0 * radius, -2.0 * radius),
            Vec3(sac_centre().x() + sac + radius, reach() + 3.0 * radius, length + 2.0 * radius));
        Surface solid = solid_of([&](const Vec3& p) { return distance(parts, p); }, box, kCell);
        if (parts.open) {
            std::vector<bool> keep;
            for (const Triangle& t : solid.triangles())
                keep.push_back(std::ranges::all_of(
                    t, [&](VertexId v) { return solid.points()[v].z() > 0.0; }));
            solid = select_triangles(solid, keep);
        }
        return mapped(solid, [&](const Vec3& p) { return at(p); });
    }

    /// A place of the vessel's own frame.
    [[nodiscard]] Vec3 at(const Vec3& p) const { return pose_ * p; }

    /// And the other way.
    [[nodiscard]] Vec3 own(const Vec3& p) const { return pose_.inverse() * p; }

    [[nodiscard]] Vec3 sac_centre() const { return {radius + 0.7 * sac, 0, 0.4 * length}; }

    [[nodiscard]] Vec3 ball_centre() const { return {0, reach(), 0.5 * length}; }

    /// Of the loop and the ball from the trunk's axis [mm].
    [[nodiscard]] double reach() const { return 3.5 * radius; }

    const double radius, length, sac;  ///< of trunk and sac [mm]

private:
    [[nodiscard]] double distance(const Parts& parts, const Vec3& p) const {
        const double low = 0.2 * length, high = 0.6 * length, thin = kBranch * radius;
        double least = capsule(p, Vec3::Zero(), Vec3(0, 0, length - parts.shortened), radius);
        if (parts.sac) least = std::min(least, (p - sac_centre()).norm() - sac);
        if (parts.ball) least = std::min(least, (p - ball_centre()).norm() - radius);
        const Vec3 out(-reach(), 0, 0), up(0, 0, high);
        const Vec3 from(0, 0, low);
        if (parts.loop)
            least =
                std::min({least, capsule(p, from, out + from, thin),
                          capsule(p, out + from, out + up, thin), capsule(p, up, out + up, thin)});
        if (parts.plug)
            least = std::min(least, capsule(p, 0.5 * out + from, 0.5 * out + up, 0.5 * reach()));
        return least;
    }

    Eigen::Isometry3d pose_;
};

/// An outcome, a statement that it breaks, and one to which it keeps, by little.
struct Lie {
    Surface before, after;
    StatedChange broken, kept;
    Vec3 place = Vec3::Zero();  ///< of what was done [mm]
    double reach = 0.0;         ///< from it, where it may be found [mm]
};

VertexId random_vertex(const Surface& surface, Random& random,
                       const std::function<bool(const Vec3&)>& may_be) {
    for (;;) {
        const auto v =
            static_cast<VertexId>(random.between(0.0, static_cast<double>(surface.vertex_count())));
        if (may_be(surface.points()[v])) return v;
    }
}

Surface with_vertex_at(const Surface& surface, VertexId v, const Vec3& place) {
    Positions points = surface.points();
    points[v] = place;
    return surface.with_positions(std::move(points));
}

/// The same triangles in another order, or not.
Surface perhaps_renumbered(const Surface& surface, Random& random) {
    if (random.coin()) return surface;
    std::vector<Triangle> triangles(surface.triangles().rbegin(), surface.triangles().rend());
    for (Triangle& t : triangles) std::ranges::rotate(t, t.begin() + 1);
    return make_surface(surface.points(), std::move(triangles));
}

/// A smooth push of the wall in a ball. The map of space is one to one: walls stay apart.
struct Push {
    ChangeZone zone;
    Vec3 by = Vec3::Zero();  ///< at its centre [mm]
    Surface after;
};

Push random_push(const Vessel& vessel, const Surface& surface, Random& random) {
    const VertexId centre = random_vertex(
        surface, random, [&](const Vec3& p) { return vessel.own(p).z() > 2.0 * vessel.radius; });
    const double radius = random.between(0.8, 1.5) * vessel.radius,
                 height = random.between(0.05, 0.2) * radius * (random.coin() ? 1.0 : -1.0);
    Push push{.zone = {surface.points()[centre], radius},
              .by = height * vertex_normals(surface)[centre],
              .after = {}};
    push.after = mapped(surface, [&](const Vec3& p) {
        const double share = (p - push.zone.centre).norm() / radius;
        return share < 1.0 ? Vec3(p + std::pow(1.0 - share * share, 2) * push.by) : p;
    });
    return push;
}

Lie elsewhere(const Vessel& vessel, Random& random) {
    const Surface before = vessel.made();
    const Push push = random_push(vessel, before, random);
    const VertexId v = random_vertex(before, random, [&](const Vec3& p) {
        return (p - push.zone.centre).norm() > push.zone.radius;
    });
    const Vec3 place = before.points()[v];
    const Vec3 moved = place + std::pow(10.0, random.between(-11.0, -1.0)) * random.direction();
    return {.before = before,
            .after = perhaps_renumbered(with_vertex_at(push.after, v, moved), random),
            .broken = {.zones = {{push.zone}}},
            .kept = {.zones = {{push.zone, {place, 0.2}}}},
            .place = place,
            .reach = 3.0 * kCell};
}

Lie other_triangles(const Vessel& vessel, Random& random) {
    return {.before = vessel.made(),
            .after = vessel.made({.shortened = random.between(0.1, 1.0) * vessel.radius}),
            .broken = {.keeps_triangles = true},
            .kept = {},
            .place = vessel.at({0, 0, vessel.length}),
            .reach = 2.0 * vessel.radius};
}

Lie without_part(const Vessel& vessel, Random&) {
    return {.before = vessel.made(),
            .after = vessel.made({.ball = false}),
            .broken = {},
            .kept = {.parts = {-1, 0}},
            .place = vessel.at(vessel.ball_centre()),
            .reach = vessel.radius + kCell};
}

Lie without_handle(const Vessel& vessel, Random&) {
    return {.before = vessel.made(),
            .after = vessel.made({.plug = true}),
            .broken = {},
            .kept = {.handles = {-1, 0}},
            .place = vessel.at({-0.5 * vessel.reach(), 0, 0.4 * vessel.length}),
            .reach = 0.2 * vessel.length + vessel.reach()};
}

Lie closed_end(const Vessel& vessel, Random&) {
    return {.before = vessel.made(),
            .after = vessel.made({.open = false}),
            .broken = {},
            .kept = {.rims = {-1, 0}},
            .place = vessel.at(Vec3::Zero()),
            .reach = 1.5 * vessel.radius};
}

Lie hole(const Vessel& vessel, Random& random) {
    const Surface before = vessel.made();
    const VertexId v = random_vertex(
        before, random, [&](const Vec3& p) { return vessel.own(p).z() > 2.0 * vessel.radius; });
    std::vector<bool> keep;
    for (const Triangle& t : before.triangles()) keep.push_back(std::ranges::count(t, v) == 0);
    return {.before = before,
            .after = select_triangles(before, keep),
            .broken = {},
            .kept = {.rims = {0, 1}},
            .place = before.points()[v],
            .reach = 2.0 * kCell};
}

/// \param distance of its dome from what is left of the wall [mm]
Lie lost_wall(Surface before, Surface after, const Vec3& dome, double distance, Random& random) {
    return {.before = std::move(before),
            .after = std::move(after),
            .broken = {.wall_lost = random.between(0.1, 1.0 / kAbove) * distance},
            .kept = {.wall_lost = kAbove * distance},
            .place = dome,
            .reach = 0.5 * distance};
}

Lie without_sac(const Vessel& vessel, Random& random) {
    const Vec3 dome = vessel.sac_centre() + Vec3(vessel.sac, 0, 0);
    return lost_wall(vessel.made(), vessel.made({.sac = false}), vessel.at(dome),
                     dome.x() - vessel.radius, random);
}

Lie shorter_end(const Vessel& vessel, Random& random) {
    const double lost = random.between(0.5, 3.0) * vessel.radius;
    return lost_wall(vessel.made(), vessel.made({.shortened = lost}),
                     vessel.at({0, 0, vessel.length + vessel.radius}), lost, random);
}

/// The statement names an end, but another one.
Lie another_end(const Vessel& vessel, Random& random) {
    Lie lie = shorter_end(vessel, random);
    const Vec3 tip = vessel.at({0, 0, vessel.length});
    lie.kept.wall_lost = lie.broken.wall_lost;
    lie.kept.named = {{tip, Plane{vessel.at({0, 0, 0.7 * vessel.length}),
                                  (tip - vessel.at(Vec3::Zero())).normalized()}}};
    lie.broken.named = {{vessel.at(Vec3::Zero())}};
    return lie;
}

Lie more_volume(const Vessel& vessel, Random& random) {
    Surface before = vessel.made();
    Push push = random_push(vessel, before, random);
    const double growth = enclosed_volume(push.after) - enclosed_volume(before);
    Lie lie{.before = std::move(before),
            .after = std::move(push.after),
            .broken = {.volume_lost = 0.0, .volume_gained = 0.0},
            .kept = {.volume_lost = 0.0, .volume_gained = 0.0},
            .place = push.zone.centre,
            .reach = push.zone.radius};
    const auto limit = growth > 0.0 ? &StatedChange::volume_gained : &StatedChange::volume_lost;
    lie.broken.*limit = random.between(0.0, 0.999) * std::abs(growth);
    lie.kept.*limit = 1.001 * std::abs(growth);
    return lie;
}

/// A vertex pulled through the wall that faces it.
Lie crossing(const Vessel& vessel, Random& random) {
    const Surface before = vessel.made();
    const VertexId v = random_vertex(before, random, [&](const Vec3& p) {
        const double z = vessel.own(p).z() / vessel.length;
        return z > 0.75 && z < 0.95;
    });
    Vec3 to = vessel.own(before.points()[v]);
    to.head<2>() *= 1.0 - random.between(2.3, 4.0) * vessel.radius / to.head<2>().norm();
    const ChangeZone zone{before.points()[v], 4.0 * vessel.radius + kCell};
    return {.before = before,
            .after = perhaps_renumbered(with_vertex_at(before, v, vessel.at(to)), random),
            .broken = {.zones = {{zone}}, .keeps_walls_apart = true},
            .kept = {.zones = {{zone}}},
            .place = zone.centre,
            .reach = 4.0 * vessel.radius};
}

Lie rubble(const Vessel& vessel, Random& random) {
    const Surface before = vessel.made();
    const Push push = random_push(vessel, before, random);
    Positions points = before.points();
    for (Vec3& p : points)
        if ((p - push.zone.centre).norm() < push.zone.radius)
            p += random.between(0.2, 0.5) * vessel.radius * random.direction();
    return {.before = before,
            .after = before.with_positions(std::move(points)),
            .broken = {.zones = {{push.zone}}, .folded = kFoldDoubt},
            .kept = {.zones = {{push.zone}}},
            .place = push.zone.centre,
            .reach = push.zone.radius + vessel.radius};
}

/// What the row below states: a row's function has no state of its own.
StatedChange statement;

Scene scene_of(Surface surface) {
    Scene scene;
    scene.surface = std::move(surface);
    return scene;
}

/// Why the outcome is refused; none: it is not.
std::optional<Diagnostic> refusal(const Surface& before, const Surface& after,
                                  const StatedChange& stated) {
    const Operation row{.name = "lie",
                        .may_change = [](const Scene&, const Outcome&) { return statement; }};
    statement = stated;
    Outcome outcome;
    outcome.scene = scene_of(after);
    try {
        static_cast<void>(guarded_run(row, scene_of(before), std::move(outcome), 0.0, {}));
        return std::nullopt;
    } catch (const DiagnosedFailure& failure) {
        return failure.diagnostics().front();
    }
}

void check_caught(Lie (*tell)(const Vessel&, Random&), const std::string& code) {
    for (std::uint64_t seed = 1; seed <= kVessels; ++seed) {
        Random random(seed);
        const Vessel vessel(random);
        const Lie lie = tell(vessel, random);
        CAPTURE(code, seed);
        const auto kept = refusal(lie.before, lie.after, lie.kept);
        CHECK((kept ? kept->code : "") == "");
        const auto found = refusal(lie.before, lie.after, lie.broken);
        REQUIRE(found.has_value());
        CHECK(found->code == code);
        REQUIRE(found->place.has_value());
        CHECK((*found->place - lie.place).norm() <= lie.reach);
    }
}

}  // namespace

SCENARIO("A lie of an operation is refused where it was done", "[workbench][overreach]") {
    SECTION("wall outside its zone") {
        check_caught(&elsewhere, "edit-leaves-zone");
    }
    SECTION("triangles") {
        check_caught(&other_triangles, "edit-changes-triangles");
    }
    SECTION("a part") {
        check_caught(&without_part, "edit-changes-parts");
    }
    SECTION("a handle") {
        check_caught(&without_handle, "edit-changes-handles");
    }
    SECTION("an open end") {
        check_caught(&closed_end, "edit-changes-rims");
    }
    SECTION("a hole") {
        check_caught(&hole, "edit-changes-rims");
    }
    SECTION("a sac") {
        check_caught(&without_sac, "edit-loses-wall");
    }
    SECTION("a vessel's end") {
        check_caught(&shorter_end, "edit-loses-wall");
    }
    SECTION("an end that it does not name") {
        check_caught(&another_end, "edit-loses-wall");
    }
    SECTION("volume") {
        check_caught(&more_volume, "edit-changes-volume");
    }
    SECTION("walls that cross") {
        check_caught(&crossing, "edit-crosses-walls");
    }
    SECTION("rubble") {
        check_caught(&rubble, "edit-folds-wall");
    }
}

SCENARIO("An outcome that keeps to a tight statement passes", "[workbench][overreach]") {
    for (std::uint64_t seed = 1; seed <= 4 * kVessels; ++seed) {
        Random random(seed);
        const Vessel vessel(random);
        const Surface before = vessel.made();
        const Push push = random_push(vessel, before, random);
        const Surface after = perhaps_renumbered(push.after, random);
        const double growth = std::abs(enclosed_volume(after) - enclosed_volume(before));
        const auto found = refusal(before, after,
                                   {.zones = {{push.zone}},
                                    .volume_lost = kAbove * growth,
                                    .volume_gained = kAbove * growth,
                                    .wall_lost = push.by.norm(),
                                    .keeps_walls_apart = true,
                                    .folded = kFoldDoubt});
        CAPTURE(seed);
        CHECK((found ? found->code : "") == "");
    }
}
