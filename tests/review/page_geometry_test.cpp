#include "workbench/review/page_geometry.h"

#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "geometry/kernel/measure.h"
#include "tests/review/packed_bytes.h"
#include "tests/support/shapes.h"
#include "workbench/review/page_bytes.h"

using namespace vesselbench;
using namespace vesselbench::test;
using Json = nlohmann::ordered_json;

namespace {

/// Of planes of differences, each number's bytes apart.
std::vector<std::uint32_t> numbers_in(const std::string& bytes, std::size_t at, std::size_t count,
                                      std::size_t width) {
    std::vector<std::uint32_t> numbers;
    std::uint32_t last = 0;
    for (std::size_t i = 0; i < count; ++i) {
        std::uint32_t difference = 0;
        for (std::size_t b = 0; b < width; ++b)
            difference |= std::uint32_t{static_cast<unsigned char>(bytes[at + b * count + i])}
                          << (8 * b);
        last += difference;
        if (width == 2) last &= 0xffff;
        numbers.push_back(last);
    }
    return numbers;
}

struct Pool {
    std::vector<Vec3> points;
    std::vector<Triangle> triangles;
};

Pool pool_of(const PageGeometry& geometry) {
    const Json json = geometry.json();
    const auto box = json["pool"]["box"].get<std::vector<double>>();
    Pool pool;
    for (const Json& chunk : json["chunks"]) {
        const std::size_t n = chunk["vertices"], m = chunk["triangles"];
        const std::string bytes = unpacked(geometry.blobs().at(chunk["blob"]), 6 * n + 12 * m);
        std::vector<std::vector<std::uint32_t>> planes;
        for (std::size_t axis = 0; axis < 3; ++axis)
            planes.push_back(numbers_in(bytes, 2 * n * axis, n, 2));
        for (std::size_t i = 0; i < n; ++i) {
            Vec3& point = pool.points.emplace_back();
            for (int axis = 0; axis < 3; ++axis)
                point[axis] = box[axis] + planes[axis][i] / 65535.0 * (box[axis + 3] - box[axis]);
        }
        planes.clear();
        for (std::size_t corner = 0; corner < 3; ++corner)
            planes.push_back(numbers_in(bytes, 6 * n + 4 * m * corner, m, 4));
        for (std::size_t i = 0; i < m; ++i)
            pool.triangles.push_back({planes[0][i], planes[1][i], planes[2][i]});
    }
    return pool;
}

/// The triangles of a state with their patches.
std::vector<std::pair<Triangle, int>> state_of(const PageGeometry& geometry, const Pool& pool,
                                               std::size_t state) {
    const Json row = geometry.json()["states"][state];
    const std::size_t runs = row["runs"];
    const std::string bytes = unpacked(geometry.blobs().at(row["blob"]), 9 * runs);
    const auto number = [&](std::size_t at) {
        std::uint32_t value = 0;
        for (std::size_t b = 0; b < 4; ++b)
            value |= std::uint32_t{static_cast<unsigned char>(bytes[at + b])} << (8 * b);
        return value;
    };
    std::vector<std::pair<Triangle, int>> triangles;
    for (std::size_t run = 0; run < runs; ++run)
        for (std::uint32_t i = 0; i < number(8 * run + 4); ++i)
            triangles.emplace_back(pool.triangles.at(number(8 * run) + i),
                                   static_cast<unsigned char>(bytes[8 * runs + run]));
    return triangles;
}

double area_of(const Pool& pool, const std::vector<std::pair<Triangle, int>>& triangles) {
    double area = 0.0;
    for (const auto& [triangle, patch] : triangles)
        area += area_normal(pool.points, triangle).norm() / 2;
    return area;
}

}  // namespace

SCENARIO("The page's geometry is the surfaces', and what they share is there once", "[review]") {
    const Surface ball = icosphere(10.0, 3);
    Positions moved = ball.points();
    moved[0] *= 1.2;
    const Surface bump = ball.with_positions(moved);
    PageGeometry geometry(Bounds{Vec3::Constant(-12.0), Vec3::Constant(12.0)});
    const auto first = geometry.add(ball), second = geometry.add(bump), again = geometry.add(ball);
    const Pool pool = pool_of(geometry);
    CHECK(pool.points.size() == ball.vertex_count() + 1);
    CHECK(pool.triangles.size() < ball.triangle_count() + 10);
    CHECK(geometry.json()["chunks"].size() == 2);
    for (std::size_t v = 0; v < ball.vertex_count(); ++v)
        REQUIRE((pool.points[first.vertices[v]] - ball.points()[v]).norm() < 24.0 / 65535.0);
    const auto triangles = state_of(geometry, pool, first.number);
    REQUIRE(triangles.size() == ball.triangle_count());
    CHECK(area_of(pool, triangles) == Approx(area(ball)).epsilon(1e-4));
    CHECK(state_of(geometry, pool, again.number) == triangles);
    CHECK(state_of(geometry, pool, second.number) != triangles);
    CHECK((pool.points[second.vertices[0]] - moved[0]).norm() < 24.0 / 65535.0);
    THEN("a state names the chunks of its triangles and of their corners") {
        CHECK(geometry.json()["states"][0]["chunks"] == Json::array({0}));
        CHECK(geometry.json()["states"][1]["chunks"] == Json::array({0, 1}));
        CHECK(geometry.json()["states"][2]["chunks"] == Json::array({0}));
    }
}

SCENARIO("Patches and values follow the page's triangles and vertices", "[review]") {
    const Surface tube = closed_tube(3.0, 20.0, 24, 20);
    PageGeometry geometry(bounds(tube));
    const auto state = geometry.add(tube);
    const Pool pool = pool_of(geometry);
    std::vector<std::size_t> own(tube.patches.size()), shown(tube.patches.size());
    for (const auto label : *tube.patch_labels) ++own[label];
    for (const auto& [triangle, patch] : state_of(geometry, pool, state.number))
        ++shown.at(static_cast<std::size_t>(patch));
    CHECK(shown == own);
    std::vector<double> heights;
    for (const Vec3& point : tube.points()) heights.push_back(point.z() - bounds(tube).min.z());
    const Json values = geometry.add_values(state, heights);
    CHECK(values["max_mm"].get<double>() == Approx(20.0));
    CHECK(values["min_mm"] == 0.0);
    REQUIRE(state.used.size() == tube.vertex_count());
    const std::string bytes = unpacked(geometry.blobs().at(values["blob"]), 2 * state.used.size());
    for (std::size_t i = 0; i < state.used.size(); ++i) {
        const double share = (static_cast<unsigned char>(bytes[2 * i]) +
                              256.0 * static_cast<unsigned char>(bytes[2 * i + 1])) /
                             65535.0;
        REQUIRE(20.0 * share ==
                Approx(pool.points[state.used[i]].z() - bounds(tube).min.z()).margin(0.001));
    }
}

SCENARIO("Values with a sign are kept between the largest and its negative", "[review]") {
    const Surface tube = closed_tube(3.0, 20.0, 24, 20);
    PageGeometry geometry(bounds(tube));
    const auto state = geometry.add(tube);
    std::vector<double> values(tube.vertex_count(), 0.0);
    values[0] = -0.5;
    const Json stored = geometry.add_values(state, values);
    CHECK(stored["min_mm"] == -0.5);
    CHECK(stored["max_mm"] == 0.5);
    const std::string bytes = unpacked(geometry.blobs().at(stored["blob"]), 2 * state.used.size());
    std::vector<int> steps;
    for (std::size_t i = 0; i < state.used.size(); ++i)
        steps.push_back(static_cast<unsigned char>(bytes[2 * i]) +
                        256 * static_cast<unsigned char>(bytes[2 * i + 1]));
    CHECK(std::ranges::count(steps, 0) == 1);
    CHECK(std::ranges::count_if(steps, [](int step) { return step == 32767 || step == 32768; }) ==
          static_cast<std::ptrdiff_t>(steps.size()) - 1);
}

SCENARIO("Surfaces that are smaller than the page's steps do not break it", "[review]") {
    const Surface speck = icosphere(1e-6, 1);
    PageGeometry geometry(Bounds{Vec3::Constant(-100.0), Vec3::Constant(110.0)});
    const auto state = geometry.add(speck);
    CHECK(state.used.empty());
    CHECK(geometry.add_values(state, std::vector<double>(speck.vertex_count(), 1.0))["max_mm"] ==
          0.0);
    const Surface flat = make_surface({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
    PageGeometry plane(bounds(flat));
    CHECK(plane.add(flat).used.size() == 3);
}
