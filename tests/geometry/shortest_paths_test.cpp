#include "geometry/kernel/shortest_paths.h"

#include <limits>
#include <vector>

#include <catch2/catch.hpp>

using namespace vesselbench;

namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();

struct Edge {
    std::uint32_t to;
    double length;
};

/// 0 to 2 directly is longer than by 1; nothing leads to 3.
const std::vector<std::vector<Edge>> kGraph = {
    {{1, 1.0}, {2, 5.0}}, {{0, 1.0}, {2, 1.5}}, {{0, 5.0}, {1, 1.5}}, {{0, 1.0}}};

}  // namespace

SCENARIO("Distances are those of the shortest ways", "[geometry][kernel]") {
    std::vector<double> distances(kGraph.size(), kFar);
    ShortestPaths paths(distances);
    paths.lower(0, 0.0);
    std::vector<std::uint32_t> order;
    while (const auto at = paths.next()) {
        CHECK(at->distance == distances[at->vertex]);
        order.push_back(at->vertex);
        for (const Edge& edge : kGraph[at->vertex])
            paths.lower(edge.to, at->distance + edge.length);
    }
    CHECK(distances == std::vector<double>{0.0, 1.0, 2.5, kFar});
    THEN("every vertex comes once, the nearest first") {
        CHECK(order == std::vector<std::uint32_t>{0, 1, 2});
    }
}

SCENARIO("A search may begin with distances that are set already", "[geometry][kernel]") {
    std::vector<double> distances = {2.0, 0.5, kFar, kFar};
    ShortestPaths paths(distances);
    for (const std::uint32_t v : {0U, 1U}) paths.start(v);
    while (const auto at = paths.next())
        for (const Edge& edge : kGraph[at->vertex])
            paths.lower(edge.to, at->distance + edge.length);
    CHECK(distances == std::vector<double>{1.5, 0.5, 2.0, kFar});
}
