#include "workbench/colours/colourings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>

#include <catch2/catch.hpp>

#include "geometry/kernel/errors.h"
#include "tests/support/shapes.h"
#include "workbench/window/drawing/view_choice.h"
#include "workbench/window/features/clip/clipped_values.h"
#include "workbench/window/features/colours/worst_places.h"

using namespace vesselbench;
using namespace vesselbench::test;
using Catch::Matchers::Contains;

namespace {

Scene scene_of(Surface surface) {
    return {.surface = std::move(surface)};
}

ColourValues coloured(ColouringKind kind, const Scene& scene) {
    return colour_values(kind, scene, {});
}

/// Vertices of a tube's wall that are away from its ends.
std::vector<VertexId> middle_of(const Surface& tube) {
    std::vector<VertexId> middle;
    for (VertexId v = 0; v < tube.vertex_count(); ++v) {
        const Vec3& p = tube.points()[v];
        if (p.z() > 8 && p.z() < 22 && std::hypot(p.x(), p.y()) > 3.9) middle.push_back(v);
    }
    return middle;
}

/// The unit cube in six tetrahedra around its diagonal.
VolumeMesh cube_mesh() {
    VolumeMesh mesh;
    for (const int z : {0, 1})
        for (const int y : {0, 1})
            for (const int x : {0, 1}) mesh.points.emplace_back(x, y, z);
    std::array<int, 3> axes = {1, 2, 4};
    do {
        const auto b = static_cast<VertexId>(axes[0]);
        const auto c = static_cast<VertexId>(axes[0] + axes[1]);
        Tetrahedron cell = {0, b, c, 7};
        const Positions& x = mesh.points;
        if ((x[b] - x[0]).cross(x[c] - x[0]).dot(x[7] - x[0]) < 0) std::swap(cell[1], cell[2]);
        mesh.tetrahedra.push_back(cell);
    } while (std::ranges::next_permutation(axes).found);
    return mesh;
}

}  // namespace

SCENARIO("A tube of 4 mm has its radius and curvature as colours", "[window][colours]") {
    const Surface tube = fine_tube(4, 30, 36);
    const auto middle = middle_of(tube);
    REQUIRE(middle.size() > 100);
    WHEN("the local radius is shown") {
        const ColourValues found = coloured(ColouringKind::LocalRadius, scene_of(tube));
        REQUIRE(found.values.size() == tube.vertex_count());
        for (const VertexId v : middle) REQUIRE(found.values[v] == Approx(4).epsilon(0.02));
    }
    WHEN("the mean curvature is shown") {
        const ColourValues found = coloured(ColouringKind::MeanCurvature, scene_of(tube));
        for (const VertexId v : middle) REQUIRE(found.values[v] == Approx(0.125).epsilon(0.03));
    }
    WHEN("the triangles' quality is shown") {
        const ColourValues found = coloured(ColouringKind::TriangleQuality, scene_of(tube));
        for (const VertexId v : middle) REQUIRE(found.values[v] > 0.95);
        CHECK(std::ranges::max(found.values) <= 1.0 + 1e-12);
    }
}

SCENARIO("A vertex has the quality of its worst triangle", "[window][colours]") {
    // An equilateral triangle beside a flat one, which share an edge.
    const double high = std::sqrt(3.0) / 2;
    const Surface two = make_surface({{0, 0, 0}, {1, 0, 0}, {0.5, high, 0}, {0.5, -0.01, 0}},
                                     {{0, 1, 2}, {0, 3, 1}});
    const auto values = coloured(ColouringKind::TriangleQuality, scene_of(two)).values;
    CHECK(values[2] == Approx(1));
    CHECK(values[0] < 0.01);
    CHECK(values[0] == values[3]);
}

SCENARIO("Colours show the distance to the nearest neighbour", "[window][colours]") {
    Scene scene = scene_of(icosphere(2, 2));
    CHECK_THAT(why_no_colours(ColouringKind::NeighbourDistance, scene), Contains("neighbour"));
    CHECK_THROWS_AS(coloured(ColouringKind::NeighbourDistance, scene), InvalidInput);
    scene.neighbours["bone"] = icosphere(3, 4, {10, 0, 0});
    CHECK(why_no_colours(ColouringKind::NeighbourDistance, scene).empty());
    const auto values = coloured(ColouringKind::NeighbourDistance, scene).values;
    const Positions& points = scene.surface->points();
    for (std::size_t v = 0; v < values.size(); ++v)
        REQUIRE(values[v] == Approx((points[v] - Vec3(10, 0, 0)).norm() - 3).margin(0.02));
}

SCENARIO("Staircase weights follow the steps of a stack", "[window][colours]") {
    // A cylinder whose radius jumps: the step is a staircase of the stack along z.
    const auto stepped = [](const Vec3& p) {
        const double factor = p.z() < 15 ? 1.0 : 1.5;
        return Vec3(factor * p.x(), factor * p.y(), p.z());
    };
    Scene scene = scene_of(mapped(fine_tube(4, 30, 36), stepped));
    scene.sampling = Sampling{.spacing = {0.5, 0.5, 1.0}, .confidence = 1.0};
    const auto values = coloured(ColouringKind::StaircaseWeight, scene).values;
    double at_step = 0.0, far = 0.0;
    for (VertexId v = 0; v < values.size(); ++v) {
        const double z = scene.surface->points()[v].z();
        if (std::abs(z - 15) < 1.0) at_step = std::max(at_step, values[v]);
        if (z > 3 && z < 8) far = std::max(far, values[v]);
    }
    CHECK(at_step > 0.9);
    CHECK(far == 0.0);
}

SCENARIO("The worst places of a measure are toured, the worst one first", "[window][colours]") {
    const Positions points = {{0, 0, 0}, {0.1, 0, 0}, {5, 0, 0}, {9, 0, 0}, {20, 0, 0}};
    const std::vector<double> values = {-8, -7.9, 3, 0.5, std::numeric_limits<double>::quiet_NaN()};
    const auto order = [&](WorstEnd end, std::size_t most) {
        std::vector<double> found;
        for (const WorstPlace& worst : worst_places(points, values, end, 1.0, most))
            found.push_back(worst.value);
        return found;
    };
    CHECK(order(WorstEnd::FarthestFromZero, 10) == std::vector<double>{-8, 3, 0.5});
    CHECK(order(WorstEnd::Largest, 2) == std::vector<double>{3, 0.5});
    CHECK(order(WorstEnd::Least, 10) == std::vector<double>{-8, 0.5, 3});
    CHECK(worst_places({}, {}, WorstEnd::Least, 1.0, 3).empty());
}

SCENARIO("The automatic range leaves out outliers", "[window][colours]") {
    std::vector<double> values;
    for (int i = 0; i <= 1000; ++i) values.push_back(i);
    values.push_back(1e9);
    values.push_back(std::numeric_limits<double>::quiet_NaN());
    const ValueRange range = shown_range(values);
    CHECK(range.least == Approx(20).margin(1));
    CHECK(range.most == Approx(981).margin(1));
    THEN("equal values have a range too") {
        const ValueRange equal = shown_range({4, 4, 4});
        CHECK(equal.least < 4);
        CHECK(equal.most > 4);
        CHECK(equal.least + equal.most == Approx(8));
    }
    CHECK(shown_range({}) == ValueRange{0, 1});
}

SCENARIO("The legend says how many values are outside the range", "[window][colours]") {
    const double none = std::numeric_limits<double>::quiet_NaN();
    const auto values = std::make_shared<const std::vector<double>>(
        std::vector<double>{-5, 0, 1, 2, 3, 4, 5, 6, 10, 20, none});
    const ValueRange range{0, 10};
    CHECK(clipped_shares(*values, range) == ClippedShares{.below = 0.1, .above = 0.1});
    CHECK(clipped_words(clipped_shares(*values, range)) == "10 % above the range, 10 % below it");
    CHECK(clipped_words(clipped_shares(*values, {-5, 10})) == "10 % above the range");
    CHECK(clipped_words(clipped_shares(*values, {0, 20})) == "10 % below the range");
    CHECK(clipped_words(clipped_shares(*values, {-5, 20})).empty());
    CHECK(clipped_words({.above = 0.004}) == "0.4 % above the range");
    CHECK(clipped_words({.above = 1e-5}) == "less than 0.1 % above the range");
    CHECK(clipped_shares({none}, range) == ClippedShares{});
    THEN("another range is counted again") {
        ClippedCount count;
        CHECK(count.of(values, range).above == Approx(0.1));
        CHECK(count.of(values, {0, 4}).above == Approx(0.4));
        CHECK(count.of(nullptr, range) == ClippedShares{});
    }
}

SCENARIO("Tetrahedra have their smallest angles as colours", "[window][colours]") {
    Scene scene = scene_of(cube(1));
    CHECK_THAT(why_no_colours(ColouringKind::TetrahedraQuality, scene), Contains("volume mesh"));
    scene.volume_mesh = std::make_shared<const VolumeMesh>(cube_mesh());
    const auto values = coloured(ColouringKind::TetrahedraQuality, scene).values;
    REQUIRE(values.size() == 6);
    for (const double angle : values) CHECK(angle == Approx(45));
}

SCENARIO("The clip plane goes through the model", "[window][colours]") {
    const Bounds box{{0, 0, 0}, {10, 20, 40}};
    CHECK_FALSE(clip_plane({}, box, Vec3::UnitY()));
    const auto axial =
        clip_plane({.on = true, .axis = ClipAxis::Axial, .place = 0.25}, box, Vec3::UnitY());
    REQUIRE(axial);
    CHECK(axial->point == Vec3(5, 10, 10));
    CHECK(axial->normal == Vec3(0, 0, 1));
    const auto other =
        clip_plane({.on = true, .axis = ClipAxis::Sagittal, .flipped = true}, box, Vec3::UnitY());
    CHECK(other->normal == Vec3(-1, 0, 0));
    CHECK(hides_section(ClipAxis::Coronal, Vec3::UnitY()));
    CHECK_FALSE(hides_section(ClipAxis::Coronal, -Vec3::UnitY()));
    CHECK_FALSE(hides_section(ClipAxis::Camera, Vec3::UnitY()));
    const auto facing = clip_plane({.on = true, .axis = ClipAxis::Camera}, box, Vec3(0, 2, 0));
    CHECK(facing->point == box.centre());
    CHECK(facing->normal == Vec3(0, -1, 0));
}
