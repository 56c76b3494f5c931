#include <algorithm>
#include <random>
#include <set>

#include <catch2/catch.hpp>

#include "geometry/kernel/errors.h"
#include "tests/support/shapes.h"

using namespace vesselbench;
using namespace vesselbench::test;

SCENARIO("A closed surface has one-rings and no boundary", "[geometry][topology]") {
    GIVEN("a geodesic sphere") {
        const Surface sphere = icosphere(10.0, 2);
        const Topology& topology = *sphere.topology;
        THEN("Euler's characteristic is 2") {
            const auto edges = topology.rings().values.size() / 2;
            CHECK(static_cast<int>(sphere.vertex_count()) - static_cast<int>(edges) +
                      static_cast<int>(sphere.triangle_count()) ==
                  2);
        }
        THEN("there is no boundary loop") {
            CHECK(topology.boundary_loops().empty());
        }
    }
}

SCENARIO("An open tube has two boundary loops that follow its triangles", "[geometry][topology]") {
    const Surface tube = open_tube(2.0, 10.0, 16, 8);
    const auto loops = tube.topology->boundary_loops();
    REQUIRE(loops.size() == 2);
    CHECK(loops[0].size() == 16);
    CHECK(loops[1].size() == 16);
}

SCENARIO("A triangle that names a missing vertex is refused", "[geometry][topology]") {
    CHECK_THROWS_AS(make_surface({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)}, {{0, 1, 3}}),
                    InvalidInput);
}

SCENARIO("One-rings of any triangles are those of a plain search", "[topology]") {
    std::mt19937 random(11);
    for (const std::size_t vertices : {5U, 40U, 3000U}) {
        std::uniform_int_distribution<VertexId> any(0, static_cast<VertexId>(vertices - 1));
        std::vector<Triangle> triangles(2 * vertices);  // non-manifold, degenerate, repeated
        for (Triangle& t : triangles) t = {any(random), any(random), any(random)};
        const Surface sphere = icosphere(1.0, 2);
        for (const auto& soup : {triangles, std::vector<Triangle>(sphere.triangles().begin(),
                                                                  sphere.triangles().end())}) {
            const std::size_t count = std::max<std::size_t>(vertices, 162);
            std::vector<std::multiset<VertexId>> around(count);
            for (const Triangle& t : soup)
                for (int k = 0; k < 3; ++k)
                    for (const VertexId u : {t[(k + 1) % 3], t[(k + 2) % 3]})
                        if (u != t[k]) around[t[k]].insert(u);
            const Topology topology(soup, count);
            for (VertexId v = 0; v < count; ++v) {
                const std::set<VertexId> ring(around[v].begin(), around[v].end());
                const auto row = topology.rings().row(v);
                REQUIRE(std::vector<VertexId>(row.begin(), row.end()) ==
                        std::vector<VertexId>(ring.begin(), ring.end()));
                const bool boundary = std::any_of(
                    ring.begin(), ring.end(), [&](VertexId u) { return around[v].count(u) == 1; });
                REQUIRE((topology.boundary_vertices()[v] != 0) == boundary);
            }
        }
    }
}
