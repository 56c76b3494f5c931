#include "smoothing/brush/brush.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <catch2/catch.hpp>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/self_intersections.h"
#include "tests/support/shapes.h"
#include "tests/support/surface_facts.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

/// A dab on a sphere of radius 10 mm around the origin.
Dab on_sphere(const Vec3& direction, double radius, double strength) {
    const Vec3 normal = direction.normalized();
    return {.anchor = {.point = 10.0 * normal, .normal = normal, .radius = 2.0},
            .radius = radius,
            .strength = strength};
}

Surface brushed(const Surface& surface, BrushKind kind, const std::vector<Dab>& dabs) {
    BrushStroke stroke(surface, {.kind = kind});
    for (const Dab& dab : dabs) static_cast<void>(stroke.add(dab));
    return stroke.surface();
}

}  // namespace

SCENARIO("Inflating lifts the wall as documented, deflating lowers it", "[smoothing][brush]") {
    const Surface sphere = icosphere(10.0, 4);
    const Vec3 top = sphere.points()[0];
    const Surface up = brushed(sphere, BrushKind::Inflate, {on_sphere(top, 3.0, 1.0)});
    const Surface down = brushed(sphere, BrushKind::Inflate, {on_sphere(top, 3.0, -1.0)});
    CHECK(up.points()[0].norm() == Approx(10.3).margin(1e-3));
    CHECK(down.points()[0].norm() == Approx(9.7).margin(1e-3));
    // The integral of h (1 - t^2)^2 over the disc is h pi r^2 / 3.
    const double lifted = 0.3 * 3.141592653589793 * 9.0 / 3.0;
    CHECK(enclosed_volume(up) - enclosed_volume(sphere) == Approx(lifted).epsilon(0.1));
    CHECK(enclosed_volume(down) - enclosed_volume(sphere) == Approx(-lifted).epsilon(0.1));
    for (std::size_t v = 0; v < sphere.vertex_count(); ++v)
        if ((sphere.points()[v] - top).norm() > 3.0) CHECK(up.points()[v] == sphere.points()[v]);
}

SCENARIO("Smoothing flattens a bump and nothing beyond the brush", "[smoothing][brush]") {
    const Surface sphere = icosphere(10.0, 4);
    const Vec3 top = sphere.points()[0];
    const auto spiky = [&](const Vec3& p) { return p == top ? Vec3(1.1 * p) : p; };
    const Surface bump = mapped(sphere, spiky);
    Dab dab = on_sphere(top, 3.0, 1.0);
    const Surface smooth = brushed(bump, BrushKind::Smooth, {dab});
    CHECK(smooth.points()[0].norm() < 10.3);
    CHECK(smooth.points()[0].norm() > 9.5);
    for (std::size_t v = 0; v < sphere.vertex_count(); ++v)
        if ((bump.points()[v] - top).norm() > 4.5) CHECK(smooth.points()[v] == bump.points()[v]);
}

SCENARIO("A stroke has the same bits whenever it is inspected", "[smoothing][brush]") {
    const Surface sphere = icosphere(10.0, 4);
    const auto kind = GENERATE(BrushKind::Smooth, BrushKind::Inflate, BrushKind::Weight);
    std::vector<Dab> dabs;
    for (int i = 0; i < 8; ++i) dabs.push_back(on_sphere(Vec3(1.0, 0.1 * i, 0.3), 2.5, 0.7));
    const Surface batch = brushed(sphere, kind, dabs);
    BrushStroke stroke(sphere, {.kind = kind}, std::make_shared<const SurfaceDistance>(sphere));
    for (const Dab& dab : dabs) {
        const Surface before = stroke.surface();
        const auto changed = stroke.add(dab);
        CHECK_FALSE(changed.empty());
        for (VertexId v = 0; v < sphere.vertex_count(); ++v)
            if (!std::ranges::binary_search(changed, v))
                REQUIRE(stroke.surface().points()[v] == before.points()[v]);
        Dab off = dab;
        off.anchor.point *= 2.0;
        CHECK_THROWS_AS(stroke.add(off), AlgorithmFailure);
    }
    CHECK(stroke.surface().points() == batch.points());
    if (kind == BrushKind::Weight)
        CHECK(*stroke.surface().attributes.at("painted_weight") ==
              *batch.attributes.at("painted_weight"));
}

SCENARIO("A brush never reaches through to a nearby vessel", "[smoothing][brush]") {
    const Surface tube = closed_tube(1.0, 10.0, 48, 80);
    const Surface both =
        merged(tube, mapped(tube, [](const Vec3& p) { return Vec3(p + Vec3(2.3, 0, 0)); }));
    const auto kind = GENERATE(BrushKind::Smooth, BrushKind::Inflate);
    const Dab dab{.anchor = {.point = {1.0, 0.0, 5.0}, .normal = {1, 0, 0}, .radius = 1.0},
                  .radius = 2.0,
                  .strength = 1.0};
    const Surface after = brushed(both, kind, {dab, dab, dab});
    std::size_t moved = 0;
    for (std::size_t v = 0; v < both.vertex_count(); ++v) {
        if (both.points()[v].x() > 1.2) REQUIRE(after.points()[v] == both.points()[v]);
        moved += after.points()[v] != both.points()[v] ? 1 : 0;
    }
    CHECK(moved > 100);
}

SCENARIO("A brush does not reach through a thin wall", "[smoothing][brush]") {
    // A pipe with an outer and an inner side, 0.2 mm apart, joined by rings at both ends.
    const Surface outer = open_tube(2.0, 10.0, 64, 80);
    const std::size_t count = outer.vertex_count();
    Positions points = outer.points();
    for (const Vec3& p : outer.points()) points.emplace_back(0.9 * p.x(), 0.9 * p.y(), p.z());
    std::vector<Triangle> triangles(outer.triangles().begin(), outer.triangles().end());
    const auto inside = [&](VertexId v) { return static_cast<VertexId>(v + count); };
    for (const auto& [a, b, c] : outer.triangles())
        triangles.push_back({inside(a), inside(c), inside(b)});
    for (const auto& loop : outer.topology->boundary_loops())
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const VertexId a = loop[i], b = loop[(i + 1) % loop.size()];
            triangles.push_back({b, a, inside(a)});
            triangles.push_back({b, inside(a), inside(b)});
        }
    const Surface pipe = make_surface(std::move(points), std::move(triangles));
    REQUIRE(is_closed_manifold(pipe));
    const auto kind = GENERATE(BrushKind::Smooth, BrushKind::Inflate, BrushKind::Weight);
    const auto side = GENERATE(1.0, -1.0);
    const Dab dab{.anchor = {.point = {side > 0 ? 2.0 : 1.8, 0.0, 5.0},
                             .normal = {side, 0, 0},
                             .radius = 1.0},
                  .radius = 1.5,
                  .strength = 0.5};
    const Surface after = brushed(pipe, kind, {dab, dab});
    std::size_t changed = 0;
    for (std::size_t v = 0; v < pipe.vertex_count(); ++v) {
        const bool touched = kind == BrushKind::Weight
                                 ? after.attributes.at("painted_weight")->at(v) != 0.0
                                 : after.points()[v] != pipe.points()[v];
        changed += touched ? 1 : 0;
        if (touched) REQUIRE((v < count) == (side > 0.0));
    }
    CHECK(changed > 50);
}

SCENARIO("A stroke is reverted at its end where walls would cross", "[smoothing][brush]") {
    const Surface tube = closed_tube(1.0, 10.0, 48, 80);
    const Surface both =
        merged(tube, mapped(tube, [](const Vec3& p) { return Vec3(p + Vec3(2.1, 0, 0)); }));
    const Dab dab{.anchor = {.point = {1.0, 0.0, 5.0}, .normal = {1, 0, 0}, .radius = 1.0},
                  .radius = 2.0,
                  .strength = 1.0};
    BrushStroke stroke(both, {.kind = BrushKind::Inflate});
    for (int i = 0; i < 2; ++i) static_cast<void>(stroke.add(dab));
    REQUIRE_FALSE(self_intersections(stroke.surface()).empty());
    const TakenBack taken = stroke.keep_walls_apart();
    CHECK(taken.vertices > 0);
    CHECK(taken.crossings_left == 0);
    CHECK(self_intersections(stroke.surface()).empty());
    CHECK(enclosed_volume(stroke.surface()) > enclosed_volume(both) + 0.02);
}

SCENARIO("The anchor's normal selects the side of a thin gap", "[smoothing][brush]") {
    const Surface tube = closed_tube(1.0, 10.0, 48, 80);
    const Surface both =
        merged(tube, mapped(tube, [](const Vec3& p) { return Vec3(p + Vec3(2.1, 0, 0)); }));
    // Nearer to the second tube, but facing as the first one.
    const Dab dab{.anchor = {.point = {1.08, 0.0, 5.0}, .normal = {2, 0, 0}, .radius = 1.0},
                  .radius = 0.5,
                  .strength = -1.0};
    const Surface after = brushed(both, BrushKind::Inflate, {dab});
    CHECK(enclosed_volume(after) < enclosed_volume(both));
    for (std::size_t v = 0; v < both.vertex_count(); ++v)
        if (both.points()[v].x() > 1.05) REQUIRE(after.points()[v] == both.points()[v]);
}

SCENARIO("Caps, rims and open boundaries stay, but can be painted", "[smoothing][brush]") {
    const Surface tube = closed_tube(2.0, 6.0, 48, 60);
    const Dab dab{.anchor = {.point = {2.0, 0.0, 5.9}, .normal = {1, 0, 0}, .radius = 2.0},
                  .radius = 2.0,
                  .strength = 1.0,
                  .falloff = 0.0};
    for (const BrushKind kind : {BrushKind::Smooth, BrushKind::Inflate}) {
        const Surface after = brushed(tube, kind, {dab});
        CHECK(after.points() != tube.points());
        for (TriangleId t = 0; t < tube.triangle_count(); ++t)
            if (tube.patch_of(t).kind != PatchKind::Wall)
                for (const VertexId v : tube.triangles()[t])
                    REQUIRE(after.points()[v] == tube.points()[v]);
    }
    const Surface open = open_tube(2.0, 6.0, 48, 60);
    const Surface after = brushed(open, BrushKind::Inflate, {dab});
    CHECK(after.points() != open.points());
    for (VertexId v = 0; v < open.vertex_count(); ++v)
        if (open.topology->boundary_vertices()[v] != 0)
            REQUIRE(after.points()[v] == open.points()[v]);
    const Surface painted = brushed(tube, BrushKind::Weight, {dab});
    bool rim = false;
    for (std::size_t v = 0; v < tube.vertex_count(); ++v)
        rim |= tube.points()[v].z() == 6.0 && painted.attributes.at("painted_weight")->at(v) > 0.0;
    CHECK(rim);
}

SCENARIO("A painted weight adds up and stays between 0 and 1", "[smoothing][brush]") {
    const Surface sphere = icosphere(10.0, 4);
    const Vec3 top = sphere.points()[0];
    const auto weight = [&](const std::vector<Dab>& dabs) {
        return brushed(sphere, BrushKind::Weight, dabs).attributes.at("painted_weight")->at(0);
    };
    const Dab some = on_sphere(top, 3.0, 0.4), less = on_sphere(top, 3.0, -0.3);
    CHECK(weight({some}) == Approx(0.4));
    CHECK(weight({some, less}) == Approx(0.1));
    CHECK(weight({some, some, some}) == 1.0);
    CHECK(weight({some, less, less}) == 0.0);
}

SCENARIO("A dab fades over its falloff, and not before", "[smoothing][brush]") {
    Dab dab{.radius = 4.0, .falloff = 0.5};
    CHECK(falloff_share(dab, 0.0) == 1.0);
    CHECK(falloff_share(dab, 2.0) == 1.0);
    CHECK(falloff_share(dab, 3.0) == Approx(0.5625));  // (1 - 1/4)^2
    CHECK(falloff_share(dab, 4.0) == 0.0);
    dab.falloff = 0.0;
    CHECK(falloff_share(dab, 4.0) == 1.0);
    CHECK(falloff_share(dab, 4.0001) == 0.0);
    dab.falloff = 1.0;
    CHECK(falloff_share(dab, 2.0) == Approx(0.5625));
    GIVEN("a sphere that is painted with it") {
        const Surface sphere = icosphere(10.0, 4);
        const Vec3 top = sphere.points()[0];
        dab = on_sphere(top, 3.0, 0.4);
        dab.falloff = GENERATE(0.0, 0.3, 1.0);
        const Surface painted = brushed(sphere, BrushKind::Weight, {dab});
        for (std::size_t v = 0; v < sphere.vertex_count(); ++v) {
            const double arc = 10.0 * std::acos(std::min(1.0, sphere.points()[v].dot(top) / 100.0));
            if (std::abs(arc - 3.0) > 0.02)  // a sharp edge has no value at 3
                CHECK(painted.attributes.at("painted_weight")->at(v) ==
                      Approx(0.4 * falloff_share(dab, arc)).margin(8e-3));
        }
    }
}

SCENARIO("Dabs of one stroke may fade differently", "[smoothing][brush]") {
    const Surface sphere = icosphere(10.0, 4);
    Dab sharp = on_sphere({0, 0, 1}, 3.0, 1.0), soft = on_sphere({0, 0, -1}, 3.0, 1.0);
    sharp.falloff = 0.0;
    const Surface up = brushed(sphere, BrushKind::Inflate, {sharp, soft});
    double highest = 0.0, lowest = 0.0;
    for (const Vec3& p : up.points()) {
        const double around = p.head<2>().norm();
        if (around < 1.8 || around > 2.5) continue;
        if (p.z() > 0.0) highest = std::max(highest, p.norm());
        if (p.z() < 0.0) lowest = std::max(lowest, p.norm());
    }
    CHECK(highest == Approx(10.3).margin(0.01));
    CHECK(lowest < 10.15);
}

SCENARIO("A point finds its anchor: normal and half the distance across", "[smoothing][brush]") {
    const Surface tube = closed_tube(2.0, 10.0, 64, 60);
    const SurfaceDistance places(tube);
    const Anchor anchor = nearest_anchor(tube, places, {2.7, 0.1, 5.0}, 9.0);
    CHECK((anchor.point - Vec3(2, 0.07, 5)).norm() < 0.02);
    CHECK(anchor.normal.dot(Vec3::UnitX()) > 0.99);
    CHECK(anchor.radius == Approx(2.0).epsilon(0.01));
    GIVEN("a vertex, where several triangles are equally near") {
        const Anchor corner = nearest_anchor(tube, places, tube.points()[64 * 30], 9.0);
        CHECK(corner.radius == Approx(2.0).epsilon(0.01));
    }
    GIVEN("a sheet, behind which there is nothing") {
        const Surface sheet = make_surface({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
        CHECK(nearest_anchor(sheet, SurfaceDistance(sheet), {0.2, 0.2, 1.0}, 9.0).radius == 9.0);
    }
    GIVEN("no sense") {
        CHECK_THROWS_AS(nearest_anchor(tube, places, {std::nan(""), 0, 0}, 1.0), InvalidInput);
        const Surface line = make_surface({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}});
        CHECK_THROWS_WITH(nearest_anchor(line, SurfaceDistance(line), {0, 0, 1}, 1.0),
                          Catch::Contains("no area"));
    }
}

SCENARIO("A brush does not depend on the vessel's position and direction", "[smoothing][brush]") {
    const Surface sphere = icosphere(10.0, 3);
    const Eigen::Matrix3d turn = skew_rotation();
    const auto turned = [&](const Vec3& p) { return Vec3(turn * p + Vec3(5, -3, 40)); };
    const auto kind = GENERATE(BrushKind::Smooth, BrushKind::Inflate);
    const Dab dab = on_sphere({0.2, 0.9, -0.3}, 4.0, 0.8);
    Dab same = dab;
    same.anchor.point = turned(dab.anchor.point);
    same.anchor.normal = turn * dab.anchor.normal;
    const Surface here = brushed(sphere, kind, {dab, dab});
    const Surface there = brushed(mapped(sphere, turned), kind, {same, same});
    for (std::size_t v = 0; v < sphere.vertex_count(); ++v)
        REQUIRE((there.points()[v] - turned(here.points()[v])).norm() < 1e-9);
}

SCENARIO("Dabs off the surface and nonsense values are refused", "[smoothing][brush]") {
    const Surface sphere = icosphere(10.0, 3);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    BrushStroke stroke(sphere, {.kind = BrushKind::Smooth});
    const Dab good = on_sphere({1, 0, 0}, 2.0, 0.5);
    const auto with = [&](auto change) {
        Dab dab = good;
        change(dab);
        return dab;
    };
    CHECK_THROWS_AS(stroke.add(with([](Dab& d) { d.anchor.point.x() = 13.0; })), AlgorithmFailure);
    CHECK_THROWS_AS(stroke.add(with([](Dab& d) { d.anchor.normal *= -1.0; })), AlgorithmFailure);
    CHECK_THROWS_AS(stroke.add(with([](Dab& d) { d.radius = 0.0; })), InvalidInput);
    CHECK_THROWS_AS(stroke.add(with([&](Dab& d) { d.radius = nan; })), InvalidInput);
    CHECK_THROWS_AS(stroke.add(with([](Dab& d) { d.strength = -0.1; })), InvalidInput);
    CHECK_THROWS_AS(stroke.add(with([&](Dab& d) { d.strength = nan; })), InvalidInput);
    CHECK_THROWS_AS(stroke.add(with([](Dab& d) { d.falloff = 1.5; })), InvalidInput);
    CHECK_THROWS_AS(stroke.add(with([&](Dab& d) { d.falloff = nan; })), InvalidInput);
    CHECK_THROWS_AS(stroke.add(with([](Dab& d) { d.anchor.normal.setZero(); })), InvalidInput);
    CHECK_THROWS_AS(stroke.add(with([&](Dab& d) { d.anchor.point.y() = nan; })), InvalidInput);
    CHECK_THROWS_AS(stroke.add(with([](Dab& d) { d.anchor.radius = -1.0; })), InvalidInput);
    CHECK(stroke.surface().points() == sphere.points());
    CHECK_THROWS_AS(BrushStroke(sphere, {.passes = 0}), InvalidInput);
    CHECK_THROWS_AS(BrushStroke(make_surface({}, {}), {}), InvalidInput);
    const Surface torn =
        mapped(sphere, [&](const Vec3& p) { return p.z() > 9.99 ? Vec3(p.x(), nan, p.z()) : p; });
    CHECK_THROWS_WITH(BrushStroke(torn, {}), Catch::Contains("not a finite number"));
}
