#include "geometry/vessel/openings/frayed_trunks.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

#include "geometry/vessel/centerlines/branch_queries.h"
#include "geometry/vessel/ends/surface_ends.h"

namespace vesselbench {

namespace {

constexpr std::size_t kLeastThreads = 3;
constexpr double kWidestThread = 0.25;   ///< diameter beside the trunk's [-]
constexpr double kThreadsSection = 0.1;  ///< of all of them, beside the trunk's [-]
constexpr double kReach = 2.8;           ///< of a fray [diameters of the trunk]
constexpr double kOwnEnd = 0.4;     ///< a stub's diameter beside the trunk's, if it is its end [-]
constexpr double kEvenTrunk = 0.7;  ///< its least radius beside the median [-]
/// The stretch that shows the trunk, behind its rounded end [largest radii there].
constexpr double kFrom = 1.0, kTo = 2.5;
/// A trunk this much wider than one nearer to the threads is the whole one [-].
constexpr double kWider = 1.25;
constexpr int kSteps = 20;

/// One side of a branch that connects two parts of the lines.
struct Side {
    std::size_t bridge = 0, node = 0;  ///< the branch, and its node on this side
    std::vector<bool> branches;        ///< by branch: lies on this side
    std::size_t size = 0;              ///< number of them
    std::vector<std::size_t> tips;
    double diameter = 0.0;  ///< of the bridge at the node [mm]
};

class FraySearch {
public:
    FraySearch(const Surface& surface, const CenterlineGraph& graph, const std::vector<Stub>& stubs)
        : surface_(surface), graph_(graph), stubs_(stubs) {}

    /// Disjoint sides, each a fray.
    [[nodiscard]] std::vector<Side> frays() const {
        std::vector<Side> found;
        for (std::size_t b = 0; b < graph_.branches.size(); ++b)
            for (const std::size_t node :
                 {graph_.branches[b].start_node, graph_.branches[b].end_node})
                if (auto side = side_of(b, node); side && is_fray(*side))
                    found.push_back(std::move(*side));
        if (!found.empty()) drop_meant(found);
        std::ranges::stable_sort(found, {}, &Side::size);
        std::vector<Side> chosen;
        for (const Side& side : found)
            if (!is_part_of_wider(side, found) && std::ranges::none_of(chosen, [&](const Side& c) {
                    return side.branches[c.bridge] || c.branches[side.bridge];
                }))
                chosen.push_back(side);
        return chosen;
    }

private:
    /// Empty if the branch is no bridge, or if this side cannot be a fray.
    [[nodiscard]] std::optional<Side> side_of(std::size_t bridge, std::size_t node) const {
        if (graph_.nodes[node].branches.size() < 3) return std::nullopt;
        const auto diameter = trunk_diameter(bridge, node);
        if (!diameter) return std::nullopt;
        Side side{.bridge = bridge,
                  .node = node,
                  .branches = std::vector<bool>(graph_.branches.size(), false),
                  .size = 0,
                  .tips = {},
                  .diameter = *diameter};
        const std::size_t beyond = other_node(graph_, bridge, node);
        const double reach = kReach * side.diameter;
        std::vector<std::size_t> nodes = {node};
        std::vector<bool> seen(graph_.nodes.size(), false);
        seen[node] = true;
        for (std::size_t i = 0; i < nodes.size(); ++i)
            for (const std::size_t b : graph_.nodes[nodes[i]].branches) {
                if (b == bridge || side.branches[b]) continue;
                const std::size_t next = other_node(graph_, b, nodes[i]);
                const Vec3& at = graph_.nodes[next].position;
                if (next == beyond || (at - graph_.nodes[node].position).norm() > reach)
                    return std::nullopt;
                side.branches[b] = true;
                ++side.size;
                if (seen[next]) continue;
                seen[next] = true;
                if (graph_.nodes[next].is_tip()) side.tips.push_back(next);
                nodes.push_back(next);
            }
        return side;
    }

    /// Of a branch that ends at a node [mm]; empty if it is too short or uneven for a trunk.
    [[nodiscard]] std::optional<double> trunk_diameter(std::size_t branch, std::size_t node) const {
        const double length = branch_length(graph_.branches[branch]);
        const auto radius = [&](double s) {
            const BranchPlace place = place_from_node(graph_, branch, node, s);
            return radius_at(graph_.branches[branch], place.abscissa);
        };
        double widest = radius(0.0);
        for (double s = 0.0; s < kTo * widest; s += 0.1 * widest)
            widest = std::max(widest, radius(s));
        if (length < kTo * widest) return std::nullopt;
        std::vector<double> radii;
        for (int i = 0; i <= kSteps; ++i)
            radii.push_back(radius(widest * (kFrom + (kTo - kFrom) * i / kSteps)));
        std::ranges::sort(radii);
        const double median = radii[kSteps / 2];
        if (radii.front() < kEvenTrunk * median) return std::nullopt;
        return 2.0 * median;
    }

    [[nodiscard]] bool is_fray(const Side& side) const {
        if (side.tips.size() < kLeastThreads || has_own_end(side)) return false;
        double section = 0.0;
        for (const std::size_t tip : side.tips) {
            const double ratio = 2.0 * tip_radius(graph_, tip) / side.diameter;
            if (ratio > kWidestThread) return false;
            section += ratio * ratio;
        }
        return section < kThreadsSection;
    }

    /// Sides with a rim or cap. Looking for these takes longer than all else here.
    void drop_meant(std::vector<Side>& sides) const {
        std::vector<bool> meant(graph_.nodes.size(), false);
        for (const SurfaceEnd& end : find_surface_ends(surface_, graph_))
            if (end.tip && end.is_visible()) meant[*end.tip] = true;
        std::erase_if(sides, [&](const Side& side) {
            return std::ranges::any_of(side.tips, [&](std::size_t tip) { return meant[tip]; });
        });
    }

    [[nodiscard]] bool is_part_of_wider(const Side& side, const std::vector<Side>& others) const {
        return std::ranges::any_of(others, [&](const Side& other) {
            return other.branches[side.bridge] && other.diameter > kWider * side.diameter;
        });
    }

    /// The trunk itself ends there.
    [[nodiscard]] bool has_own_end(const Side& side) const {
        const Vec3& node = graph_.nodes[side.node].position;
        return std::ranges::any_of(stubs_, [&](const Stub& stub) {
            return 2.0 * stub.widest > kOwnEnd * side.diameter &&
                   (stub.tip - node).norm() < kReach * side.diameter;
        });
    }

    const Surface& surface_;
    const CenterlineGraph& graph_;
    const std::vector<Stub>& stubs_;
};

/// The lines without some branches, and the nodes that keep none.
class Pruning {
public:
    Pruning(const CenterlineGraph& graph, const std::vector<Side>& frays) {
        std::vector<bool> gone(graph.branches.size(), false);
        for (const Side& fray : frays)
            for (std::size_t b = 0; b < gone.size(); ++b)
                if (fray.branches[b]) gone[b] = true;
        new_node_.assign(graph.nodes.size(), std::numeric_limits<std::size_t>::max());
        for (std::size_t b = 0; b < gone.size(); ++b) {
            if (gone[b]) continue;
            CenterlineBranch branch = graph.branches[b];
            for (std::size_t* node : {&branch.start_node, &branch.end_node}) {
                *node = kept(graph.nodes[*node], *node);
                graph_.nodes[*node].branches.push_back(graph_.branches.size());
            }
            graph_.branches.push_back(std::move(branch));
        }
    }

    [[nodiscard]] std::size_t new_node(std::size_t node) const { return new_node_[node]; }

    [[nodiscard]] CenterlineGraph taken() { return std::move(graph_); }

private:
    std::size_t kept(const CenterlineNode& node, std::size_t old) {
        std::size_t& index = new_node_[old];
        if (index >= graph_.nodes.size()) {
            index = graph_.nodes.size();
            graph_.nodes.push_back({node.position, node.radius, {}});
        }
        return index;
    }

    CenterlineGraph graph_;
    std::vector<std::size_t> new_node_;  ///< by node
};

}  // namespace

LinesWithoutFrays without_frays(const Surface& surface, const CenterlineGraph& graph,
                                const std::vector<Stub>& stubs) {
    const std::vector<Side> frays = FraySearch(surface, graph, stubs).frays();
    if (frays.empty()) return {graph, {}};
    Pruning pruning(graph, frays);
    LinesWithoutFrays lines;
    for (const Side& fray : frays) {
        FrayedTrunk trunk{.tip = pruning.new_node(fray.node), .ends = {}};
        for (const std::size_t tip : fray.tips)
            trunk.ends.push_back({graph.nodes[tip].position, 2.0 * tip_radius(graph, tip)});
        lines.trunks.push_back(std::move(trunk));
    }
    lines.graph = pruning.taken();
    return lines;
}

}  // namespace vesselbench
