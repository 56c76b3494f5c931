#include "geometry/editing/editable_surface.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "geometry/editing/hole_filling.h"
#include "geometry/editing/plane_cut.h"
#include "geometry/editing/rims.h"
#include "geometry/kernel/edges.h"
#include "geometry/kernel/measure.h"
#include "tests/support/shapes.h"
#include "tests/support/surface_facts.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

constexpr double kPi = std::numbers::pi;

void check_same_bits(const Surface& a, const Surface& b) {
    CHECK(a.points() == b.points());
    CHECK(std::ranges::equal(a.triangles(), b.triangles()));
    CHECK(*a.patch_labels == *b.patch_labels);
    CHECK(a.patches == b.patches);
    REQUIRE(a.attributes.size() == b.attributes.size());
    for (const auto& [name, values] : a.attributes) CHECK(*values == *b.attributes.at(name));
}

Surface with_height(Surface surface) {
    std::vector<double> height;
    for (const Vec3& p : surface.points()) height.push_back(p.z());
    surface.attributes["height"] = std::make_shared<const std::vector<double>>(height);
    return surface;
}

void check_height(const Surface& surface) {
    const auto& height = *surface.attributes.at("height");
    REQUIRE(height.size() == surface.vertex_count());
    double worst = 0.0;
    for (VertexId v = 0; v < height.size(); ++v)
        worst = std::max(worst, std::abs(height[v] - surface.points()[v].z()));
    CHECK(worst < 1e-12);
}

/// V - E + F; every vertex is used.
long euler(const Surface& surface) {
    return static_cast<long>(surface.vertex_count()) -
           static_cast<long>(edge_table(*surface.topology).edges.size()) +
           static_cast<long>(surface.triangle_count());
}

bool is_manifold(const Surface& surface) {
    return manifold_defects(*surface.topology).none();
}

Surface shifted(const Surface& surface, double z) {
    return mapped(surface, [&](const Vec3& p) { return Vec3(p + z * Vec3::UnitZ()); });
}

/// Three triangles on one edge, a fourth that is reversed, one that names a vertex twice, and two
/// that only share a vertex.
Surface nasty_fan() {
    return make_surface(
        {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, -1, 0), Vec3(0, 0, 1), Vec3(2, 1, 0),
         Vec3(3, 1, 0), Vec3(3, 2, 0)},
        {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}, {2, 1, 5}, {1, 2, 5}, {4, 4, 2}, {5, 6, 7}});
}

}  // namespace

SCENARIO("A surface that is not edited comes out bit for bit", "[geometry][editing]") {
    for (const Surface& surface :
         {with_height(closed_tube(2.0, 5.0, 12, 6)), with_height(open_tube(2.0, 5.0, 12, 6)),
          with_height(icosphere(10.0, 3)), with_height(nasty_fan())}) {
        std::vector<VertexId> new_ids;
        check_same_bits(EditableSurface(surface).to_surface(&new_ids), surface);
        for (VertexId v = 0; v < surface.vertex_count(); ++v) CHECK(new_ids[v] == v);
        check_same_bits(surface_from(EditableSurface(surface).to_soup()), surface);
    }
}

SCENARIO("Edges of no manifold find all their triangles", "[geometry][editing]") {
    EditableSurface surface(nasty_fan());
    using Ids = std::vector<TriangleId>;
    CHECK(surface.triangles_on(0, 1) == Ids{0, 1, 2});
    CHECK(surface.across(1, 0) == Ids{0, 2});
    CHECK(surface.across(2, 0) == Ids{0, 1});
    CHECK(surface.triangles_at(1) == Ids{0, 1, 2, 3, 4});
    CHECK(surface.on_rim(0));
    WHEN("a vertex with copies is moved and a triangle is removed") {
        surface.move(1, Vec3(1, 0, 0.5));
        surface.remove(0);
        const Surface left = surface.to_surface();
        CHECK(left.triangle_count() == 6);
        CHECK(left.vertex_count() == 8);
        CHECK(left.points()[1] == Vec3(1, 0, 0.5));
        CHECK(surface.across(2, 0) == Ids{1});
        CHECK_FALSE(surface.collapse(0, 1));
    }
}

SCENARIO("A hole opens a rim, and filling closes it again", "[geometry][editing]") {
    const Surface sphere = icosphere(10.0, 3);
    EditableSurface surface(sphere);
    CHECK(surface.rims().empty());
    for (TriangleId t = 0; t < sphere.triangle_count(); ++t) {
        const auto& [a, b, c] = sphere.triangles()[t];
        const Vec3 middle = sphere.points()[a] + sphere.points()[b] + sphere.points()[c];
        if (middle.z() > 3.0 * 8.5) surface.remove(t);
    }
    const Surface holed = surface.to_surface();
    CHECK(euler(holed) == 1);
    const auto rims = surface.rims();
    REQUIRE(rims.size() == 1);
    std::vector<VertexId> ids, renumbered;
    (void)surface.to_surface(&ids);
    for (const VertexId v : rims[0]) renumbered.push_back(ids[v]);
    CHECK(renumbered == holed.topology->boundary_loops().at(0));
    const std::size_t added = fill_rim(surface, rims[0]);
    const Surface filled = surface.to_surface();
    CHECK(filled.triangle_count() == holed.triangle_count() + added);
    CHECK(euler(filled) == 2);
    CHECK(is_closed_manifold(filled));
    CHECK(enclosed_volume(filled) == Approx(enclosed_volume(sphere)).epsilon(0.01));
}

SCENARIO("A plane cuts one vessel and carries patches and attributes", "[geometry][editing]") {
    const Surface tube = with_height(closed_tube(2.0, 10.0, 24, 21));
    const Plane plane{Vec3(0, 0, 6.2), Vec3::UnitZ()};
    const auto curve = cross_section_at(tube, plane);
    REQUIRE((curve && curve->closed));
    EditableSurface surface(tube);
    const PlaneCut cut = cut_along(surface, plane, *curve, NearVertices::Stay);
    REQUIRE(cut.rim.size() >= 24);
    for (const VertexId v : cut.rim) CHECK(surface.point(v).z() == Approx(6.2).margin(1e-12));
    CHECK(area(surface.to_surface()) == Approx(area(tube)));
    const auto above = part_above(surface, cut);
    REQUIRE(above);
    surface.remove(*above);
    const Surface below = surface.to_surface();
    CHECK(is_manifold(below));
    CHECK(euler(below) == 1);
    CHECK(bounds(below).max.z() == Approx(6.2));
    REQUIRE(below.patches.size() == 2);
    CHECK(below.patches[1].name == "inlet");
    check_height(below);
    WHEN("the rim is closed flat") {
        std::vector<VertexId> loop(cut.rim.rbegin(), cut.rim.rend());
        const auto label = surface.add_patch({"outlet_1", PatchKind::Outlet});
        close_flat(surface, loop, plane, mean_edge(surface, loop), label);
        const Surface closed = surface.to_surface();
        CHECK(is_closed_manifold(closed));
        CHECK(closed.patches.back().name == "outlet_1");
        CHECK(enclosed_volume(closed) == Approx(0.62 * enclosed_volume(tube)));
    }
}

SCENARIO("A cut through a ring of vessels does not part it", "[geometry][editing]") {
    const Surface tube = open_tube(1.0, 40.0, 16, 60);
    const Surface ring = mapped(tube, [](const Vec3& p) {
        const double turn = p.z() / 40.0 * 1.9 * kPi;
        return Vec3((6.0 + p.x()) * std::cos(turn), (6.0 + p.x()) * std::sin(turn), -p.y());
    });
    EditableSurface surface(ring);
    const auto rims = surface.rims();
    REQUIRE(rims.size() == 2);
    join_rims(surface, rims[0], rims[1], 0);
    const Surface torus = surface.to_surface();
    REQUIRE(is_closed_manifold(torus));
    CHECK(euler(torus) == 0);
    const Plane plane{Vec3(-6, 0.05, 0), Vec3::UnitY()};
    const auto curve = cross_section_at(torus, plane);
    REQUIRE(curve);
    EditableSurface cut_torus(torus);
    const PlaneCut cut = cut_along(cut_torus, plane, *curve, NearVertices::MoveOntoPlane);
    CHECK(cut.rim.size() >= 16);
    CHECK_FALSE(part_above(cut_torus, cut));
}

SCENARIO("Two parts are joined along their rims", "[geometry][editing]") {
    const Surface lower = with_height(open_tube(2.0, 5.0, 24, 10));
    const Surface upper = with_height(shifted(open_tube(2.0, 5.0, 18, 10), 5.5));
    EditableSurface surface(lower);
    const VertexId first = surface.append(upper);
    CHECK(first == lower.vertex_count());
    auto rims = surface.rims();
    REQUIRE(rims.size() == 4);
    std::ranges::sort(rims, {}, [&](const auto& rim) { return surface.point(rim[0]).z(); });
    join_rims(surface, rims[1], rims[2], 0);
    const Surface joined = surface.to_surface();
    CHECK(is_manifold(joined));
    CHECK(euler(joined) == 0);
    CHECK(connected_components(*joined.topology).count() == 1);
    CHECK(joined.patches.size() == 1);
    CHECK(area(joined) == Approx(area(lower) + area(upper) + 2.0 * kPi * 2.0 * 0.5).epsilon(0.02));
    const auto& height = *joined.attributes.at("height");
    CHECK(height[lower.vertex_count() - 1] == lower.attributes.at("height")->back());
    CHECK(height[first] == upper.attributes.at("height")->front());
}

SCENARIO("Collapses and flips keep a manifold, or are refused", "[geometry][editing]") {
    const Surface tube = closed_tube(2.0, 5.0, 12, 6);
    EditableSurface surface(tube);
    int flipped = 0, collapsed = 0;
    for (TriangleId t = 0; t < tube.triangle_count(); t += 5)
        if (!surface.is_removed(t) && surface.across(t, 0).size() == 1) {
            const Triangle before = surface.triangle(t);
            const bool done = surface.flip(t, 0);
            flipped += done ? 1 : 0;
            if (done) CHECK(surface.triangle(t)[0] == before[2]);
            if (done) CHECK(surface.triangle(t)[1] == before[0]);
        }
    for (TriangleId t = 0; t < tube.triangle_count(); t += 7)
        if (!surface.is_removed(t)) {
            const Triangle at = surface.triangle(t);
            collapsed += surface.collapse(at[1], at[0]) ? 1 : 0;
        }
    CHECK(flipped > 10);
    CHECK(collapsed > 5);
    const Surface edited = surface.to_surface();
    CHECK(is_closed_manifold(edited));
    CHECK(euler(edited) == 2);
    CHECK(edited.triangle_count() ==
          tube.triangle_count() - 2 * static_cast<std::size_t>(collapsed));
    GIVEN("a tetrahedron, which has no edge to spare") {
        EditableSurface smallest(
            make_surface({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)},
                         {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}));
        CHECK_FALSE(smallest.collapse(0, 1));
        CHECK_FALSE(smallest.flip(0, 0));
    }
}
