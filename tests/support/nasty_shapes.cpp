#include "tests/support/nasty_shapes.h"

#include <cmath>

#include "tests/support/shapes.h"
#include "tests/support/surface_facts.h"

namespace vesselbench::test {

namespace {

Surface in_the_air(const Surface& surface) {
    Positions points = surface.points();
    points.insert(points.begin(), Vec3(9, 9, 9));
    points.emplace_back(-9, 9, 9);
    std::vector<Triangle> triangles;
    for (const auto& [a, b, c] : surface.triangles()) triangles.push_back({a + 1, b + 1, c + 1});
    return make_surface(std::move(points), std::move(triangles));
}

Surface all_caps(Surface surface) {
    for (Patch& patch : surface.patches) patch.kind = PatchKind::Outlet;
    return surface;
}

Surface moebius_band() {
    std::vector<Triangle> triangles;
    Positions points;
    for (int i = 0; i < 24; ++i) {
        const double turn = 2.0 * M_PI * i / 24;
        for (const double side : {-1.0, 1.0})
            points.emplace_back((5.0 + side * std::cos(turn / 2)) * std::cos(turn),
                                (5.0 + side * std::cos(turn / 2)) * std::sin(turn),
                                side * std::sin(turn / 2));
        const VertexId a = 2 * i, b = i == 23 ? 1 : a + 2, c = i == 23 ? 0 : a + 3;
        triangles.push_back({a, b, c});
        triangles.push_back({a, c, a + 1});
    }
    return make_surface(std::move(points), std::move(triangles));
}

}  // namespace

std::vector<NastyShape> nasty_shapes() {
    const Surface tube = closed_tube(2.0, 6.0, 12, 8);
    std::vector<Triangle> turned(tube.triangles().begin(), tube.triangles().end());
    for (std::size_t t = 0; t < turned.size(); t += 3) std::swap(turned[t][0], turned[t][1]);
    std::vector<Triangle> twice(tube.triangles().begin(), tube.triangles().end());
    twice.insert(twice.end(), tube.triangles().begin(), tube.triangles().begin() + 20);
    const auto scaled = [&](double factor) {
        return mapped(tube, [=](const Vec3& p) { return Vec3(factor * p); });
    };
    return {
        {"one triangle", make_surface({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}})},
        {"a triangle without area", make_surface({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}})},
        {"a triangle at one point", make_surface({{1, 1, 1}, {1, 1, 1}, {1, 1, 1}}, {{0, 1, 2}})},
        {"one corner three times",
         make_surface({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {1, 1, 1}, {2, 2, 0}})},
        {"three sheets at an edge, and more",
         make_surface(
             {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, -1, 0}, {9, 9, 9}, {1, 0, 0}},
             {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}, {2, 2, 3}, {1, 1, 1}, {0, 1, 6}})},
        {"two cones tip to tip",
         make_surface(
             {{0, 0, 0}, {1, 0, 1}, {0, 1, 1}, {-1, -1, 1}, {1, 0, -1}, {0, 1, -1}, {-1, -1, -1}},
             {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {0, 5, 4}, {0, 6, 5}, {0, 4, 6}})},
        {"a Moebius band", moebius_band()},
        {"vertices without triangles", in_the_air(tube)},
        {"an open tube", open_tube(2.0, 6.0, 12, 8)},
        {"triangles turned over", make_surface(tube.points(), std::move(turned))},
        {"triangles twice", make_surface(tube.points(), std::move(twice))},
        {"all flat", mapped(tube, [](const Vec3& p) { return Vec3(p.x(), p.y(), 0.0); })},
        {"all on a line", mapped(tube, [](const Vec3& p) { return Vec3(0.0, 0.0, p.z()); })},
        {"nothing but caps", all_caps(tube)},
        {"very small", scaled(1e-9)},
        {"very large", scaled(1e9)},
        {"through itself",
         merged(tube, mapped(tube, [](const Vec3& p) { return Vec3(p + Vec3(1, 0.1, 0.2)); }))}};
}

}  // namespace vesselbench::test
