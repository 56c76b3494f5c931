#include "geometry/vessel/ends/flow_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <ranges>
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

/// A branch's direction is looked at over this many radii of its furcation.
constexpr double kDirectionReach = 2.0;

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

/// A node, and the branch by which the shortest way from a tip comes to it.
struct Step {
    std::size_t node = 0, branch = 0;
};

/// To all nodes that lines connect with the tip, the nearest first.
std::vector<Step> steps_from(const CenterlineGraph& graph, std::size_t tip) {
    std::vector<double> lengths;
    for (const CenterlineBranch& branch : graph.branches) lengths.push_back(branch_length(branch));
    const std::vector<double> distance = distances_from(graph, tip, lengths);
    std::vector<std::size_t> order(graph.nodes.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, {}, [&](std::size_t n) { return distance[n]; });
    std::vector<Step> steps;
    for (const std::size_t n : order) {
        if (!std::isfinite(distance[n])) break;
        for (const std::size_t b : graph.nodes[n].branches) {
            const std::size_t before = other_node(graph, b, n);
            if (before == n || distance[before] + lengths[b] != distance[n]) continue;
            steps.push_back({n, b});
            break;
        }
    }
    return steps;
}

}  // namespace

Vec3 direction_from(const CenterlineGraph& graph, std::size_t branch, std::size_t node) {
    const double zone = furcation_zone_end(graph, branch, node);
    const double reach = kDirectionReach * graph.nodes[node].radius;
    const auto at = [&](double s) {
        return point_at(graph.branches[branch], place_from_node(graph, branch, node, s).abscissa);
    };
    const double whole = branch_length(graph.branches[branch]);
    const double from = std::min(zone, 0.5 * whole);
    return (at(std::min(whole, from + reach)) - at(from)).stableNormalized();
}

std::vector<std::vector<SharedVessel>> vessels_from(const CenterlineGraph& graph, std::size_t tip) {
    const std::vector<double> courses = course_diameters(graph);
    std::vector<std::vector<SharedVessel>> leading(graph.nodes.size());
    for (const auto& [n, b] : steps_from(graph, tip)) {
        const std::size_t before = other_node(graph, b, n);
        leading[n] = leading[before];
        if (!graph.nodes[n].is_tip() && !graph.nodes[before].is_tip())
            leading[n].insert(leading[n].begin(), {b, courses[b]});
    }
    return leading;
}

std::vector<double> shares_of_outlets(const CenterlineGraph& graph, std::size_t inlet,
                                      std::span<const std::size_t> outlets, double exponent) {
    const std::vector<Step> steps = steps_from(graph, inlet);
    std::vector<bool> leads(graph.nodes.size(), false);
    for (const std::size_t outlet : outlets) leads[outlet] = true;
    for (const auto& [n, b] : std::views::reverse(steps))
        if (leads[n]) leads[other_node(graph, b, n)] = true;
    std::vector<double> weights = course_diameters(graph), behind(graph.nodes.size(), 0.0);
    for (double& weight : weights) weight = std::pow(weight, exponent);
    for (const auto& [n, b] : steps)
        if (leads[n]) behind[other_node(graph, b, n)] += weights[b];
    std::vector<double> share(graph.nodes.size(), 0.0);
    share[inlet] = 1.0;
    for (const auto& [n, b] : steps) {
        const std::size_t before = other_node(graph, b, n);
        if (leads[n]) share[n] = share[before] * weights[b] / behind[before];
    }
    std::vector<double> shares;
    for (const std::size_t outlet : outlets) shares.push_back(share[outlet]);
    return shares;
}

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

FlowTree::FlowTree(const CenterlineGraph& graph, std::vector<double> diameters)
    : graph_(graph), diameters_(std::move(diameters)) {
    for (std::size_t b = 0; b < graph.branches.size(); ++b) {
        const CenterlineBranch& branch = graph.branches[b];
        lengths_.push_back(branch_length(branch));
        directions_.emplace_back(direction_from(graph, b, branch.start_node),
                                 direction_from(graph, b, branch.end_node));
    }
}

std::vector<FlowTree::Way> FlowTree::ways_from(std::size_t tip) const {
    const std::vector<double> distance = distances_from(graph_, tip, lengths_);
    std::vector<Way> ways;
    for (std::size_t b = 0; b < graph_.branches.size(); ++b) {
        const CenterlineBranch& branch = graph_.branches[b];
        Way way{.near = branch.start_node,
                .far = branch.end_node,
                .flow = cube(diameters_[b]),
                .from_near = directions_[b].first,
                .into_far = -directions_[b].second};
        if (!(way.flow > 0.0) || way.near == way.far || !std::isfinite(distance[way.near]))
            continue;
        if (distance[way.far] < distance[way.near]) {
            std::swap(way.near, way.far);
            way.from_near = directions_[b].second;
            way.into_far = -directions_[b].first;
        }
        ways.push_back(way);
    }
    return ways;
}

RootFigures FlowTree::figures(std::size_t tip) const {
    struct Furcation {
        double in = 0.0, out = 0.0;
        Vec3 inward = Vec3::Zero();
    };

    std::vector<Furcation> at(graph_.nodes.size());
    const std::vector<Way> ways = ways_from(tip);
    for (const Way& way : ways) {
        at[way.near].out += way.flow;
        at[way.far].in += way.flow;
        at[way.far].inward += way.flow * way.into_far;
    }
    RootFigures figures;
    for (const Furcation& f : at) {
        if (!(f.in > 0.0 && f.out > 0.0)) continue;
        const double scatter = std::min(std::abs(std::log(f.in / f.out)), kMostScatter);
        figures.murray += 0.5 * scatter * scatter / (kUsualScatter * kUsualScatter);
    }
    double behind = 0.0;
    for (const Way& way : ways) {
        const Furcation& f = at[way.near];
        if (!(f.in > 0.0)) continue;
        figures.turn += way.flow * (1.0 - f.inward.stableNormalized().dot(way.from_near));
        behind += way.flow;
    }
    if (behind > 0.0) figures.turn /= behind;
    return figures;
}

}  // namespace vesselbench
