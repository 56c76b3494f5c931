#include "geometry/vessel/centerlines/skeleton.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "geometry/kernel/disjoint_sets.h"
#include "geometry/vessel/centerlines/thinning.h"

namespace vesselbench {
namespace {

/// A loop of so few voxels is not a handle of the lumen: the wall around a handle needs more.
constexpr std::size_t kShortestLoop = 6;

/// The curve's voxels with their neighbours in the curve.
struct Curve {
    std::span<const VoxelId> voxels;
    std::vector<std::vector<std::uint32_t>> near;  ///< per voxel, indices into voxels, ascending
    std::vector<int> node;                         ///< per voxel; -1 on a branch
};

std::optional<std::uint32_t> position_of(std::span<const VoxelId> voxels, VoxelId v) {
    const auto at = std::lower_bound(voxels.begin(), voxels.end(), v);
    if (at == voxels.end() || *at != v) return std::nullopt;
    return static_cast<std::uint32_t>(at - voxels.begin());
}

Curve connect(const LumenGrid& grid, std::span<const VoxelId> voxels) {
    Curve curve{voxels, std::vector<std::vector<std::uint32_t>>(voxels.size()),
                std::vector<int>(voxels.size(), -1)};
    const auto offsets = grid.neighbour_offsets();
    for (std::size_t i = 0; i < voxels.size(); ++i) {
        for (const int o : offsets) {
            const auto w = static_cast<VoxelId>(static_cast<int>(voxels[i]) + o);
            if (const auto at = position_of(voxels, w)) curve.near[i].push_back(*at);
        }
    }
    return curve;
}

/// Assigns a node to every cluster of furcation voxels and to every end voxel.
void find_nodes(const LumenGrid& grid, Curve& curve, Skeleton& skeleton) {
    for (std::uint32_t i = 0; i < curve.voxels.size(); ++i) {
        if (curve.node[i] >= 0 || curve.near[i].size() == 2) continue;
        const int name = static_cast<int>(skeleton.nodes.size());
        const bool furcation = curve.near[i].size() > 2;
        std::vector<std::uint32_t> stack{i};
        curve.node[i] = name;
        std::uint32_t deepest = i;
        while (!stack.empty()) {
            const std::uint32_t at = stack.back();
            stack.pop_back();
            if (grid.depth[curve.voxels[at]] > grid.depth[curve.voxels[deepest]]) deepest = at;
            if (!furcation) continue;
            for (const std::uint32_t next : curve.near[at]) {
                if (curve.node[next] >= 0 || curve.near[next].size() < 3) continue;
                curve.node[next] = name;
                stack.push_back(next);
            }
        }
        skeleton.nodes.push_back(curve.voxels[deepest]);
    }
}

/// Follows a branch from a node's voxel via `first` to the next node.
SkeletonBranch follow(const Curve& curve, const Skeleton& skeleton, std::uint32_t from,
                      std::uint32_t first, std::vector<std::uint8_t>& visited) {
    SkeletonBranch branch;
    branch.from = static_cast<std::size_t>(curve.node[from]);
    branch.path.push_back(skeleton.nodes[branch.from]);
    std::uint32_t before = from;
    std::uint32_t at = first;
    while (curve.node[at] < 0) {
        visited[at] = 1;
        branch.path.push_back(curve.voxels[at]);
        const std::uint32_t next =
            curve.near[at][0] == before ? curve.near[at][1] : curve.near[at][0];
        before = at;
        at = next;
    }
    branch.to = static_cast<std::size_t>(curve.node[at]);
    branch.path.push_back(skeleton.nodes[branch.to]);
    return branch;
}

void trace_branches(Curve& curve, Skeleton& skeleton) {
    std::vector<std::uint8_t> visited(curve.voxels.size(), 0);
    for (std::uint32_t i = 0; i < curve.voxels.size(); ++i) {
        if (curve.node[i] < 0) continue;
        for (const std::uint32_t next : curve.near[i]) {
            if (curve.node[next] == curve.node[i] || visited[next]) continue;
            if (curve.node[next] >= 0 && next < i) continue;  // already found from the other end
            SkeletonBranch branch = follow(curve, skeleton, i, next, visited);
            if (branch.from == branch.to && branch.path.size() < kShortestLoop) continue;
            skeleton.branches.push_back(std::move(branch));
        }
    }
    // Rings without any furcation: any voxel can be their node.
    for (std::uint32_t i = 0; i < curve.voxels.size(); ++i) {
        if (curve.node[i] >= 0 || visited[i]) continue;
        curve.node[i] = static_cast<int>(skeleton.nodes.size());
        skeleton.nodes.push_back(curve.voxels[i]);
        skeleton.branches.push_back(follow(curve, skeleton, i, curve.near[i][0], visited));
    }
}

double step_length(const LumenGrid& grid, VoxelId a, VoxelId b) {
    return (grid.centre(a) - grid.centre(b)).norm();
}

/// True if p lies in an inscribed sphere of another branch at the node.
bool within_parent(const LumenGrid& grid, const Skeleton& skeleton, std::size_t branch,
                   std::size_t node, const Vec3& p) {
    const double reach = 4.0 * grid.depth[skeleton.nodes[node]];
    const Vec3 root = grid.centre(skeleton.nodes[node]);
    for (std::size_t b = 0; b < skeleton.branches.size(); ++b) {
        const SkeletonBranch& other = skeleton.branches[b];
        if (b == branch || (other.from != node && other.to != node)) continue;
        for (const VoxelId v : other.path) {
            const Vec3 c = grid.centre(v);
            if ((c - root).norm() < reach && (c - p).norm() < grid.depth[v]) return true;
        }
    }
    return false;
}

}  // namespace

std::vector<int> Skeleton::degrees() const {
    std::vector<int> degree(nodes.size(), 0);
    for (const SkeletonBranch& b : branches) {
        ++degree[b.from];
        ++degree[b.to];
    }
    return degree;
}

Skeleton skeleton_of(const LumenGrid& grid, std::span<const VoxelId> voxels) {
    Skeleton skeleton;
    Curve curve = connect(grid, voxels);
    find_nodes(grid, curve, skeleton);
    trace_branches(curve, skeleton);
    return skeleton;
}

BlindReach blind_reach(const LumenGrid& grid, const Skeleton& skeleton, std::size_t branch,
                       std::size_t tip) {
    const SkeletonBranch& b = skeleton.branches[branch];
    std::vector<VoxelId> path = b.path;
    if (b.from == tip) std::reverse(path.begin(), path.end());
    const std::size_t root = b.from == tip ? b.to : b.from;
    std::size_t exit = path.size() - 1;
    while (exit > 0 && !within_parent(grid, skeleton, branch, root, grid.centre(path[exit]))) {
        --exit;
    }
    BlindReach reach{.root = skeleton.nodes[root],
                     .exit = path[exit],
                     .tip = path.back(),
                     .length = grid.depth[path.back()],
                     .widest = grid.depth[path.back()]};
    for (std::size_t i = exit; i + 1 < path.size(); ++i) {
        reach.length += step_length(grid, path[i], path[i + 1]);
        if (i > exit) reach.widest = std::max<double>(reach.widest, grid.depth[path[i]]);
    }
    return reach;
}

double significance(const LumenGrid& grid, const BlindReach& reach, const BlindBranchRule& rule) {
    if (reach.widest > rule.widest) return 0.0;
    const double least =
        std::max(rule.beyond_parent * grid.depth[reach.root], rule.slenderness * reach.widest);
    return reach.length / least;
}

PrunedCurve prune(const LumenGrid& grid, std::vector<VoxelId> curve, const CurveAnchors& anchors,
                  const BlindBranchRule& rule, const Progress& cancel) {
    constexpr double kThin = 3.0;  // voxels
    const auto& [fixed, blind, low] = anchors;
    BlindBranchRule low_rule = rule;
    low_rule.widest = kThin * grid.spacing;
    std::vector<BlindReach> dropped;
    for (;;) {
        cancel.check_cancelled();
        const Skeleton skeleton = skeleton_of(grid, curve);
        const auto degree = skeleton.degrees();
        double least = 1.0;
        std::optional<BlindReach> weakest;
        for (std::size_t b = 0; b < skeleton.branches.size(); ++b) {
            const auto& branch = skeleton.branches[b];
            for (const auto& [tip, root] :
                 {std::pair(branch.from, branch.to), std::pair(branch.to, branch.from)}) {
                const VoxelId v = skeleton.nodes[tip];
                if (degree[tip] != 1 || degree[root] < 3) continue;
                if (std::find(blind.begin(), blind.end(), v) == blind.end()) continue;
                const bool is_low = std::ranges::find(low, v) != low.end();
                const BlindReach reach = blind_reach(grid, skeleton, b, tip);
                const double s = significance(grid, reach, is_low ? low_rule : rule);
                if (s < least) {
                    least = s;
                    weakest = reach;
                }
            }
        }
        if (!weakest) break;
        dropped.push_back(*weakest);
        std::erase(blind, weakest->tip);
        std::vector<VoxelId> kept(fixed.begin(), fixed.end());
        kept.insert(kept.end(), blind.begin(), blind.end());
        curve = thin(grid, curve, kept, cancel);
    }
    return {std::move(curve), std::move(dropped)};
}

std::vector<Summit> summits(const LumenGrid& grid, std::span<const float> geodesic, double height,
                            const Progress& cancel) {
    constexpr std::uint32_t kTurns = 4096;  // a few milliseconds
    std::vector<VoxelId> order;
    for (const VoxelId v : grid.voxels) {
        if (std::isfinite(geodesic[v])) order.push_back(v);
    }
    std::sort(order.begin(), order.end(), [&](VoxelId a, VoxelId b) {
        return geodesic[a] != geodesic[b] ? geodesic[a] > geodesic[b] : a < b;
    });
    // Union of the region above the falling level, by rank: the root of every set is its summit.
    constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
    std::vector<std::uint32_t> rank(grid.lumen.size(), kNone);
    DisjointSets sets(order.size());
    std::vector<Summit> found;
    const auto offsets = grid.neighbour_offsets();
    for (std::uint32_t r = 0; r < order.size(); ++r) {
        if (r % kTurns == 0) cancel.check_cancelled();
        const VoxelId v = order[r];
        rank[v] = r;
        for (const int o : offsets) {
            const std::uint32_t beside = rank[static_cast<VoxelId>(static_cast<int>(v) + o)];
            if (beside == kNone) continue;
            const VoxelId lower = order[std::max(sets.root(r), sets.root(beside))];
            const double rise = geodesic[lower] - geodesic[v];
            if (sets.join(r, beside) && rise >= height) found.push_back({lower, rise});
        }
    }
    for (std::uint32_t r = 0; r < order.size(); ++r)
        if (sets.root(r) == r) found.push_back({order[r], std::numeric_limits<double>::infinity()});
    std::ranges::sort(found, {}, &Summit::voxel);
    return found;
}

}  // namespace vesselbench
