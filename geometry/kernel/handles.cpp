#include "geometry/kernel/handles.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <map>
#include <numbers>
#include <set>
#include <utility>

#include "geometry/kernel/disjoint_sets.h"
#include "geometry/kernel/edges.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/measure.h"
#include "geometry/kernel/shortest_paths.h"

namespace vesselbench {

namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();
constexpr VertexId kNone = std::numeric_limits<VertexId>::max();

using Loop = std::vector<VertexId>;
using EdgeSet = std::set<std::pair<VertexId, VertexId>>;  // {low, high}

/// Shortest paths along edges from one vertex.
struct PathTree {
    std::vector<double> distance;
    std::vector<VertexId> parent;
};

class HandleSearch {
public:
    HandleSearch(const Surface& surface, const Progress& cancel)
        : points_(surface.points()),
          topology_(*surface.topology),
          table_(edge_table(topology_, cancel)),
          cancel_(cancel) {
        faces_ = static_cast<std::uint32_t>(topology_.triangle_count());
        for (const auto& loop : topology_.boundary_loops()) {
            for (std::size_t i = 0; i < loop.size(); ++i) {
                rim_face_[std::minmax(loop[i], loop[(i + 1) % loop.size()])] = faces_;
            }
            ++faces_;
        }
    }

    [[nodiscard]] std::vector<SurfaceHandle> found() const {
        std::vector<SurfaceHandle> handles;
        std::vector<std::pair<double, Loop>> waists;
        const auto rings = [&](std::size_t v) { return !topology_.rings().row(v).empty(); };
        VertexId start = 0;
        while (start < points_.size() && !rings(start)) ++start;
        if (start == points_.size()) return handles;
        for (const auto& edge : generators(paths_from(start))) {
            Loop waist = tightened(edge[0]);
            waists.emplace_back(length_of(waist), std::move(waist));
        }
        std::ranges::stable_sort(waists, {}, &std::pair<double, Loop>::first);
        std::vector<EdgeSet> taken;  // crossings of the waists and rings of the handles found
        for (const auto& [length, waist] : waists) {
            if (waist.empty() ||
                std::ranges::any_of(taken, [&](const EdgeSet& c) { return crosses(waist, c); }))
                continue;
            EdgeSet crossings = crossings_of(waist);
            const Loop ring = ring_across(waist, crossings);
            if (ring.empty()) continue;  // the waist parts the surface: it goes around no handle
            taken.push_back(std::move(crossings));
            taken.push_back(crossings_of(ring));
            handles.push_back({mean_of(waist), length / std::numbers::pi, length_of(ring)});
        }
        return handles;
    }

private:
    [[nodiscard]] double edge_length(VertexId a, VertexId b) const {
        return (points_[a] - points_[b]).norm();
    }

    [[nodiscard]] PathTree paths_from(VertexId root) const {
        cancel_.check_cancelled();
        PathTree tree{std::vector<double>(points_.size(), kFar),
                      std::vector<VertexId>(points_.size(), kNone)};
        ShortestPaths paths(tree.distance);
        paths.lower(root, 0.0);
        while (const auto at = paths.next())
            for (const VertexId next : topology_.rings().row(at->vertex)) {
                const double d = at->distance + edge_length(at->vertex, next);
                if (d < tree.distance[next]) tree.parent[next] = at->vertex;
                paths.lower(next, d);
            }
        return tree;
    }

    /// The two faces at an edge; a rim's fill is one face.
    [[nodiscard]] std::pair<std::uint32_t, std::uint32_t> faces_at(std::size_t edge) const {
        const auto halves = table_.half_edges.row(edge);
        const std::uint32_t first = halves[0] / 3;
        if (halves.size() > 1) return {first, halves[1] / 3};
        return {first, rim_face_.at({table_.edges[edge][0], table_.edges[edge][1]})};
    }

    /// Edges that neither the tree of paths nor a tree of faces across the other edges has: two for
    /// each handle.
    [[nodiscard]] std::vector<std::array<VertexId, 2>> generators(const PathTree& tree) const {
        DisjointSets parts(faces_);
        // The longest ways first, so that the short ones are left over (a maximum spanning tree).
        std::vector<std::pair<double, std::size_t>> order;
        for (std::size_t e = 0; e < table_.edges.size(); ++e) {
            const auto [a, b] = table_.edges[e];
            if (tree.parent[a] == b || tree.parent[b] == a || tree.distance[a] == kFar) continue;
            order.emplace_back(-(tree.distance[a] + tree.distance[b] + edge_length(a, b)), e);
        }
        std::ranges::sort(order);
        std::vector<std::array<VertexId, 2>> left;
        for (const auto& [way, e] : order) {
            const auto [f, g] = faces_at(e);
            if (!parts.join(f, g)) left.push_back(table_.edges[e]);
        }
        return left;
    }

    /// The loop from where the two ways of an edge's ends to the root part, through the edge.
    [[nodiscard]] static Loop loop_through(const PathTree& tree,
                                           const std::array<VertexId, 2>& edge) {
        Loop one{edge[0]}, other{edge[1]};
        while (tree.parent[one.back()] != kNone) one.push_back(tree.parent[one.back()]);
        while (tree.parent[other.back()] != kNone) other.push_back(tree.parent[other.back()]);
        while (one.size() > 1 && other.size() > 1 &&
               one[one.size() - 2] == other[other.size() - 2]) {
            one.pop_back();
            other.pop_back();
        }
        other.pop_back();  // where they part is in both
        one.insert(one.end(), other.rbegin(), other.rend());
        return one;
    }

    [[nodiscard]] double length_of(const Loop& loop) const {
        double length = 0.0;
        for (std::size_t i = 0; i < loop.size(); ++i)
            length += edge_length(loop[i], loop[(i + 1) % loop.size()]);
        return length;
    }

    [[nodiscard]] Vec3 mean_of(const Loop& loop) const {
        Vec3 sum = Vec3::Zero();
        for (const VertexId v : loop) sum += points_[v];
        return sum / static_cast<double>(loop.size());
    }

    /// The shortest loop near a vertex, from its own vertices again until it gets no shorter.
    [[nodiscard]] Loop tightened(VertexId root) const {
        constexpr int kMostRounds = 12;
        Loop best;
        double length = kFar;
        for (int round = 0; round < kMostRounds; ++round) {
            const PathTree tree = paths_from(root);
            const auto edges = generators(tree);
            if (edges.empty()) break;
            // The last one left over has the shortest way through the root.
            Loop loop = loop_through(tree, edges.back());
            if (length_of(loop) >= (1.0 - 1e-9) * length) break;
            length = length_of(loop);
            best = std::move(loop);
            root = best[best.size() / 2];
        }
        return best;
    }

    /// Neighbours of a loop's vertex on its left side.
    [[nodiscard]] std::vector<VertexId> left_of(VertexId before, VertexId at,
                                                VertexId after) const {
        std::map<VertexId, VertexId> next;
        for (const TriangleId t : topology_.triangles_at().row(at)) {
            const Triangle& triangle = topology_.triangles()[t];
            const std::uint32_t k = corner_of(triangle, at);
            next[triangle[(k + 1) % 3]] = triangle[(k + 2) % 3];
        }
        std::vector<VertexId> left;
        for (auto step = next.find(after); step != next.end() && step->second != before;
             step = next.find(step->second))
            left.push_back(step->second);
        return left;
    }

    /// The edges that leave a loop to its left: what crosses it an odd number of times uses an odd
    /// number of them.
    [[nodiscard]] EdgeSet crossings_of(const Loop& loop) const {
        EdgeSet edges;
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const VertexId before = loop[(i + loop.size() - 1) % loop.size()];
            for (const VertexId v : left_of(before, loop[i], loop[(i + 1) % loop.size()]))
                edges.insert(std::minmax(loop[i], v));
        }
        return edges;
    }

    [[nodiscard]] static bool crosses(const Loop& loop, const EdgeSet& crossings) {
        std::size_t count = 0;
        for (std::size_t i = 0; i < loop.size(); ++i)
            count += crossings.count(std::minmax(loop[i], loop[(i + 1) % loop.size()]));
        return count % 2 == 1;
    }

    /// The shortest loop that crosses a waist an odd number of times: shortest paths on the surface
    /// and its double, which are joined along the waist. Empty if there is none.
    [[nodiscard]] Loop ring_across(const Loop& waist, const EdgeSet& crossing) const {
        const std::uint32_t from = 2 * waist.front();
        std::vector<double> distance(2 * points_.size(), kFar);
        std::vector<std::uint32_t> parent(2 * points_.size(), from);
        ShortestPaths paths(distance);
        paths.lower(from, 0.0);
        while (const auto at = paths.next()) {
            const VertexId v = at->vertex / 2;
            for (const VertexId w : topology_.rings().row(v)) {
                const bool through = crossing.contains(std::minmax(v, w));
                const std::uint32_t side = through ? 1 - at->vertex % 2 : at->vertex % 2;
                const double d = at->distance + edge_length(v, w);
                if (d < distance[2 * w + side]) parent[2 * w + side] = at->vertex;
                paths.lower(2 * w + side, d);
            }
        }
        Loop ring;
        if (distance[from + 1] == kFar) return ring;
        for (std::uint32_t state = from + 1; state != from; state = parent[state])
            ring.push_back(state / 2);
        return ring;
    }

    const Positions& points_;
    const Topology& topology_;
    EdgeTable table_;
    const Progress& cancel_;
    std::uint32_t faces_ = 0;
    std::map<std::pair<VertexId, VertexId>, std::uint32_t> rim_face_;
};

}  // namespace

std::vector<SurfaceHandle> handles_of(const Surface& surface, const Progress& cancel) {
    const Connectivity found = connectivity(*surface.topology);
    if (!found.manifold || !found.oriented)
        throw InvalidInput("handles need a surface of one side, oriented: repair it first");
    return HandleSearch(surface, cancel).found();
}

}  // namespace vesselbench
