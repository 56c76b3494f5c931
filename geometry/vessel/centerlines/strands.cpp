#include "geometry/vessel/centerlines/strands.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

namespace vesselbench {
namespace {

constexpr std::size_t kNone = static_cast<std::size_t>(-1);

/// A further pair at one furcation is joined only if it bends by less than this [rad].
constexpr double kNearlyStraight = 0.7;

/// End 0 of branch b is half 2 b (its start), end 1 is half 2 b + 1.
struct HalfView {
    Vec3 direction = Vec3::Zero();  ///< from the node into the branch, unit
    double radius = 0.0;
};

/// Direction and size of a branch as seen from its node, about 1.5 radii away.
HalfView look(const CenterlineGraph& graph, std::size_t half) {
    const CenterlineBranch& b = graph.branches[half / 2];
    const bool from_start = half % 2 == 0;
    const std::size_t n = b.points.size();
    const auto index = [&](std::size_t k) { return from_start ? k : n - 1 - k; };
    const Vec3 root = b.points[index(0)];
    std::size_t k = 1;
    while (k + 1 < n && (b.points[index(k)] - root).norm() < 1.5 * b.radii[index(0)]) ++k;
    return {(b.points[index(k)] - root).normalized(), b.radii[index(k)]};
}

std::vector<std::size_t> pair_halves(const CenterlineGraph& graph) {
    std::vector<std::vector<std::size_t>> halves(graph.nodes.size());
    for (std::size_t b = 0; b < graph.branches.size(); ++b) {
        halves[graph.branches[b].start_node].push_back(2 * b);
        halves[graph.branches[b].end_node].push_back(2 * b + 1);
    }
    std::vector<std::size_t> partner(2 * graph.branches.size(), kNone);
    for (const auto& at_node : halves) {
        if (at_node.size() < 2) continue;
        std::vector<std::tuple<double, double, std::size_t, std::size_t>> pairs;
        for (std::size_t i = 0; i < at_node.size(); ++i) {
            for (std::size_t j = i + 1; j < at_node.size(); ++j) {
                const HalfView a = look(graph, at_node[i]);
                const HalfView b = look(graph, at_node[j]);
                const double bend =
                    std::numbers::pi -
                    std::atan2(a.direction.cross(b.direction).norm(), a.direction.dot(b.direction));
                const double cost = bend + 0.5 * std::abs(std::log(a.radius / b.radius));
                pairs.emplace_back(cost, bend, at_node[i], at_node[j]);
            }
        }
        std::sort(pairs.begin(), pairs.end());
        bool first = true;
        for (const auto& [cost, bend, a, b] : pairs) {
            if (partner[a] != kNone || partner[b] != kNone) continue;
            if (!first && bend > kNearlyStraight) continue;
            partner[a] = b;
            partner[b] = a;
            first = false;
        }
    }
    return partner;
}

}  // namespace

std::vector<Strand> find_strands(const CenterlineGraph& graph) {
    const auto partner = pair_halves(graph);
    std::vector<bool> used(graph.branches.size(), false);
    std::vector<Strand> strands;
    const auto follow = [&](std::size_t half) {
        Strand strand;
        while (half != kNone && !used[half / 2]) {
            used[half / 2] = true;
            strand.pieces.push_back({half / 2, half % 2 == 1});
            half = partner[half ^ 1U];
        }
        strand.closed = half != kNone;
        strands.push_back(std::move(strand));
    };
    for (std::size_t half = 0; half < partner.size(); ++half) {
        if (partner[half] == kNone && !used[half / 2]) follow(half);
    }
    for (std::size_t b = 0; b < graph.branches.size(); ++b) {
        if (!used[b]) follow(2 * b);
    }
    return strands;
}

}  // namespace vesselbench
