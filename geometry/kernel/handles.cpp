#include "geometry/kernel/handles.h"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <numbers>
#include <queue>
#include <set>
#include <utility>

#include "geometry/kernel/edges.h"

namespace vesselbench {

namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();
constexpr VertexId kNone = std::numeric_limits<VertexId>::max();

using Loop = std::vector<VertexId>;
using Entry = std::pair<double, std::size_t>;
using EdgeSet = std::set<std::pair<VertexId, VertexId>>;  // {low, high}
using Queue = std::priority_queue<Entry, std::vector<Entry>, std::greater<>>;

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
        faces_ = topology_.triangle_count();
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
        Queue open;
        tree.distance[root] = 0.0;
        open.emplace(0.0, root);
        while (!open.empty()) {
            const auto [reached, v] = open.top();
            open.pop();
            if (reached > tree.distance[v]) continue;
            for (const VertexId next : topology_.rings().row(v)) {
                const double d = reached + edge_length(static_cast<VertexId>(v), next);
                if (d >= tree.distance[next]) continue;
                tree.distance[next] = d;
                tree.parent[next] = static_cast<VertexId>(v);
                open.emplace(d, next);
            }
        }
        return tree;
    }

    /// The two faces at an edge; a rim's fill is one face.
    [[nodiscard]] std::pair<std::size_t, std::size_t> faces_at(std::size_t edge) const {
        const auto halves = table_.half_edges.row(edge);
        const std::size_t first = halves[0] / 3;
        if (halves.size() > 1) return {first, halves[1] / 3};
        return {first, rim_face_.at({table_.edges[edge][0], table_.edges[edge][1]})};
    }

    /// Edges that neither the tree of paths nor a tree of faces across the other edges has: two for
    /// each handle.
    [[nodiscard]] std::vector<std::array<VertexId, 2>> generators(const PathTree& tree) const {
        std::vector<std::size_t> part(faces_);
        for (std::size_t f = 0; f < faces_; ++f) part[f] = f;
        const auto root = [&](std::size_t f) {
            while (part[f] != f) f = part[f] = part[part[f]];
            return f;
        };
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
            const std::size_t one = root(f), other = root(g);
            if (one == other)
                left.push_back(table_.edges[e]);
            else
                part[one] = other;
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
        const std::size_t from = 2 * std::size_t{waist.front()};
        std::vector<double> distance(2 * points_.size(), kFar);
        std::vector<std::size_t> parent(2 * points_.size(), from);
        Queue open;
        distance[from] = 0.0;
        open.emplace(0.0, from);
        while (!open.empty()) {
            const auto [reached, state] = open.top();
            open.pop();
            if (reached > distance[state]) continue;
            const auto v = static_cast<VertexId>(state / 2);
            for (const VertexId w : topology_.rings().row(v)) {
                const bool through = crossing.contains(std::minmax(v, w));
                const std::size_t next = 2 * std::size_t{w} + (through ? 1 - state % 2 : state % 2);
                const double d = reached + edge_length(v, w);
                if (d >= distance[next]) continue;
                distance[next] = d;
                parent[next] = state;
                open.emplace(d, next);
            }
        }
        Loop ring;
        if (distance[from + 1] == kFar) return ring;
        for (std::size_t state = from + 1; state != from; state = parent[state])
            ring.push_back(static_cast<VertexId>(state / 2));
        return ring;
    }

    const Positions& points_;
    const Topology& topology_;
    EdgeTable table_;
    const Progress& cancel_;
    std::size_t faces_ = 0;
    std::map<std::pair<VertexId, VertexId>, std::size_t> rim_face_;
};

}  // namespace

std::vector<SurfaceHandle> handles_of(const Surface& surface, const Progress& cancel) {
    return HandleSearch(surface, cancel).found();
}

}  // namespace vesselbench
