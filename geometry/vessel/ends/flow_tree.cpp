#include "geometry/vessel/ends/flow_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "geometry/kernel/shortest_paths.h"
#include "geometry/kernel/statistics.h"
#include "geometry/vessel/centerlines/branch_queries.h"

namespace vesselbench {

namespace {

constexpr int kSamples = 24;
/// Standard deviation of the logarithm of a furcation's ratio, and the largest that counts: beyond
/// it the lines are wrong, not the tip.
constexpr double kUsualScatter = 1.0;
constexpr double kMostScatter = 3.0;

double cube(double x) {
    return x * x * x;
}

/// Shortest ways from a tip along the lines [mm], by node.
std::vector<double> distances_from(const CenterlineGraph& graph, std::size_t tip,
                                   const std::vector<double>& lengths) {
    std::vector<double> distance(graph.nodes.size(), std::numeric_limits<double>::infinity());
    ShortestPaths paths(distance);
    paths.lower(static_cast<std::uint32_t>(tip), 0.0);
    while (const auto at = paths.next())
        for (const std::size_t b : graph.nodes[at->vertex].branches)
            paths.lower(static_cast<std::uint32_t>(other_node(graph, b, at->vertex)),
                        at->distance + lengths[b]);
    return distance;
}

}  // namespace

std::vector<double> course_diameters(const CenterlineGraph& graph) {
    std::vector<double> diameters;
    for (std::size_t b = 0; b < graph.branches.size(); ++b) {
        const CenterlineBranch& branch = graph.branches[b];
        const double whole = branch_length(branch);
        double from = furcation_zone_end(graph, b, branch.start_node);
        double to = whole - furcation_zone_end(graph, b, branch.end_node);
        if (!(to > from)) from = to = 0.5 * (from + to);
        std::vector<double> samples;
        for (int k = 0; k < kSamples; ++k)
            samples.push_back(2.0 * radius_at(branch, from + (to - from) * (k + 0.5) / kSamples));
        diameters.push_back(median(std::move(samples)));
    }
    return diameters;
}

double root_cost(const CenterlineGraph& graph, const std::vector<double>& diameters,
                 std::size_t tip) {
    std::vector<double> lengths;
    for (const CenterlineBranch& branch : graph.branches) lengths.push_back(branch_length(branch));
    const std::vector<double> distance = distances_from(graph, tip, lengths);
    std::vector<double> in(graph.nodes.size(), 0.0), out(graph.nodes.size(), 0.0);
    for (std::size_t b = 0; b < graph.branches.size(); ++b) {
        std::size_t near = graph.branches[b].start_node, far = graph.branches[b].end_node;
        if (!std::isfinite(distance[near]) || near == far) continue;
        if (distance[far] < distance[near]) std::swap(near, far);
        out[near] += cube(diameters[b]);
        in[far] += cube(diameters[b]);
    }
    double cost = 0.0;
    for (std::size_t n = 0; n < graph.nodes.size(); ++n) {
        if (!(in[n] > 0.0 && out[n] > 0.0)) continue;
        const double scatter = std::min(std::abs(std::log(in[n] / out[n])), kMostScatter);
        cost += 0.5 * scatter * scatter / (kUsualScatter * kUsualScatter);
    }
    return cost;
}

}  // namespace vesselbench
