#include "smoothing/connected_distances.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <compare>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include "smoothing/filter_support.h"
#include "smoothing/point_tree.h"

namespace vesselbench::detail {

namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();
constexpr VertexId kNone = std::numeric_limits<VertexId>::max();

/// Squared distances to the nearest known source, on the way to the exact ones.
struct Search {
    const CompressedRows& rings;
    const Positions& x;
    double squared_reach;
    const std::vector<VertexId>& sources;
    std::vector<double> squared;    ///< #V; infinite: none known
    std::vector<VertexId> nearest;  ///< #V, where `squared` is finite: whose distance it is

    [[nodiscard]] double squared_distance(VertexId v, VertexId source) const {
        return (x[v] - x[source]).squaredNorm();
    }
};

/// A source that is nearer to a vertex than any that is known to reach it, but may not reach it.
struct Doubt {
    VertexId source;
    VertexId vertex;
    auto operator<=>(const Doubt&) const = default;
};

/// True if walking from v along the edge that leads nearest to the source arrives there. All of
/// such a walk is nearer to the source than v; false proves nothing.
bool walk_arrives(const Search& search, VertexId v, VertexId source) {
    double here = search.squared_distance(v, source);
    while (v != source) {
        const VertexId from = v;
        for (const VertexId u : search.rings.row(from)) {
            const double there = search.squared_distance(u, source);
            if (there < here) {
                here = there;
                v = u;
            }
            if (u == source) return true;
        }
        if (v == from) return false;
    }
    return true;
}

/// Gives every vertex the nearest of all sources, where a walk proves that it reaches.
/// \return vertices with a source within reach, for whose nearest one there is no such proof
std::vector<VertexId> walk_to_nearest(Search& search, const PointTree& tree) {
    const std::size_t count = search.x.size();
    const double just_beyond = std::nextafter(search.squared_reach, kFar);
    std::vector<std::uint8_t> open(count, 0);
    const tbb::blocked_range<std::size_t> all(0, count, 1024);
    tbb::parallel_for(all, [&](const auto& range) {
        PointTree::Found hint;  // what was nearest to the vertex before is near this one, too
        for (std::size_t i = range.begin(); i != range.end(); ++i) {
            const auto v = static_cast<VertexId>(i);
            if (search.squared[v] == 0.0 || !search.x[v].allFinite()) continue;
            PointTree::Found known{kNone, just_beyond};
            if (hint.vertex != kNone) {
                const double squared = search.squared_distance(v, hint.vertex);
                if (squared < just_beyond) known = {hint.vertex, squared};
            }
            const PointTree::Found found = tree.nearest(search.x[v], known);
            if (found.vertex == kNone) continue;
            hint = found;
            open[v] = walk_arrives(search, v, found.vertex) ? 0 : 1;
            if (open[v] != 0) continue;
            search.squared[v] = found.squared;
            search.nearest[v] = found.vertex;
        }
    });
    std::vector<VertexId> result;
    for (VertexId v = 0; v < count; ++v)
        if (open[v] != 0) result.push_back(v);
    return result;
}

/// Hands sources on to open vertices from their neighbours: what reaches a neighbour reaches them,
/// if it is within its reach. An upper bound of their distance.
void hand_on(Search& search, const std::vector<VertexId>& open) {
    std::vector<std::uint8_t> is_open(search.x.size(), 0);
    for (const VertexId v : open) is_open[v] = 1;
    std::vector<VertexId> queue = open;
    std::vector<std::uint8_t> queued = is_open;
    for (std::size_t i = 0; i < queue.size(); ++i) {
        const VertexId v = queue[i];
        queued[v] = 0;
        bool better = false;
        for (const VertexId u : search.rings.row(v)) {
            if (search.squared[u] == kFar) continue;
            const double squared = search.squared_distance(v, search.nearest[u]);
            if (!(squared <= search.squared_reach) || !(squared < search.squared[v])) continue;
            search.squared[v] = squared;
            search.nearest[v] = search.nearest[u];
            better = true;
        }
        if (!better) continue;
        for (const VertexId u : search.rings.row(v))
            if (is_open[u] != 0 && queued[u] == 0) {
                queue.push_back(u);
                queued[u] = 1;
            }
    }
}

/// Connected parts of the surface, each with the box around it.
struct Parts {
    std::vector<std::uint32_t> part;  ///< #V
    std::vector<BoxTree::Box> boxes;

    explicit Parts(const Search& search) : part(search.x.size(), kNone) {
        std::vector<VertexId> queue;
        for (VertexId first = 0; first < part.size(); ++first) {
            if (part[first] != kNone) continue;
            const auto number = static_cast<std::uint32_t>(boxes.size());
            BoxTree::Box box;
            part[first] = number;
            queue.assign(1, first);
            for (std::size_t i = 0; i < queue.size(); ++i) {
                box.extend(search.x[queue[i]]);
                for (const VertexId u : search.rings.row(queue[i]))
                    if (part[u] == kNone) {
                        part[u] = number;
                        queue.push_back(u);
                    }
            }
            boxes.push_back(box);
        }
    }

    /// True if the whole part of the source is certainly within reach of it.
    [[nodiscard]] bool within_reach(const Search& search, VertexId source) const {
        const BoxTree::Box& box = boxes[part[source]];
        const Vec3& p = search.x[source];
        const Vec3 farthest = (p - box.min()).cwiseMax(box.max() - p);
        return farthest.squaredNorm() * (1.0 + 1e-12) < search.squared_reach;  // rounding
    }
};

/// Sources nearer to an open vertex than what it has got. The first of them that surely reaches it
/// gives its distance; those before that one are doubts.
void collect_doubts(Search& search, const PointTree& tree, const Parts& parts, VertexId v,
                    std::vector<Doubt>& doubts) {
    std::vector<PointTree::Found> nearer;
    const double just_beyond = std::nextafter(search.squared_reach, kFar);
    tree.visit_nearer(search.x[v], std::min(search.squared[v], just_beyond),
                      [&](const PointTree::Found& found) {
                          if (parts.part[found.vertex] == parts.part[v]) nearer.push_back(found);
                      });
    std::sort(nearer.begin(), nearer.end(), [](const auto& a, const auto& b) {
        return std::pair(a.squared, a.vertex) < std::pair(b.squared, b.vertex);
    });
    for (const PointTree::Found& found : nearer) {
        if (parts.within_reach(search, found.vertex) || walk_arrives(search, v, found.vertex)) {
            search.squared[v] = found.squared;
            return;
        }
        doubts.push_back({found.vertex, v});
    }
}

/// Doubts of all open vertices, by source.
std::vector<Doubt> all_doubts(Search& search, const PointTree& tree,
                              const std::vector<VertexId>& open) {
    const Parts parts(search);
    std::vector<std::uint8_t> has_source(parts.boxes.size(), 0);
    for (const VertexId s : search.sources) has_source[parts.part[s]] = 1;
    tbb::enumerable_thread_specific<std::vector<Doubt>> found;
    const tbb::blocked_range<std::size_t> all(0, open.size(), 32);
    tbb::parallel_for(all, [&](const auto& range) {
        for (std::size_t i = range.begin(); i != range.end(); ++i)
            if (has_source[parts.part[open[i]]] != 0)
                collect_doubts(search, tree, parts, open[i], found.local());
    });
    std::vector<Doubt> doubts;
    for (const auto& some : found) doubts.insert(doubts.end(), some.begin(), some.end());
    std::sort(doubts.begin(), doubts.end());
    return doubts;
}

/// Vertices that a flood has met, without clearing them between floods.
struct FloodMarks {
    std::vector<std::uint32_t> met;  ///< #V: number of the last flood
    std::uint32_t flood = 0;
    std::vector<VertexId> queue;
};

void lower(double& value, double to) {
    std::atomic_ref<double> shared(value);
    double seen = shared.load(std::memory_order_relaxed);
    while (to < seen && !shared.compare_exchange_weak(seen, to, std::memory_order_relaxed)) {
    }
}

/// The definition itself: spreads from the source within its reach, until the last vertex in doubt
/// about it is met.
void flood(Search& search, std::span<const Doubt> doubts, FloodMarks& marks) {
    if (marks.met.empty()) marks.met.assign(search.x.size(), 0);
    const std::uint32_t met = marks.flood + 2, wanted = met - 1;
    marks.flood = met;
    for (const Doubt& doubt : doubts) marks.met[doubt.vertex] = wanted;
    const VertexId source = doubts.front().source;
    std::size_t waiting = doubts.size();
    marks.met[source] = met;
    marks.queue.assign(1, source);
    for (std::size_t i = 0; i < marks.queue.size() && waiting > 0; ++i)
        for (const VertexId u : search.rings.row(marks.queue[i])) {
            if (marks.met[u] == met) continue;
            const double squared = search.squared_distance(u, source);
            if (!(squared <= search.squared_reach)) continue;
            if (marks.met[u] == wanted) {
                lower(search.squared[u], squared);
                --waiting;
            }
            marks.met[u] = met;
            marks.queue.push_back(u);
        }
}

/// One flood for every source that is in doubt.
void settle(Search& search, const std::vector<Doubt>& doubts) {
    std::vector<std::span<const Doubt>> groups;
    for (std::size_t i = 0, end = 0; i < doubts.size(); i = end) {
        while (end < doubts.size() && doubts[end].source == doubts[i].source) ++end;
        groups.emplace_back(doubts.data() + i, end - i);
    }
    tbb::enumerable_thread_specific<FloodMarks> marks;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, groups.size(), 16),
                      [&](const auto& range) {
                          for (std::size_t i = range.begin(); i != range.end(); ++i)
                              flood(search, groups[i], marks.local());
                      });
}

}  // namespace

std::vector<double> connected_distances(const Topology& topology, const Positions& positions,
                                        const std::vector<VertexId>& sources, double reach) {
    const std::size_t count = positions.size();
    Search search{topology.rings(),
                  positions,
                  reach * reach,
                  sources,
                  std::vector<double>(count, kFar),
                  std::vector<VertexId>(count, kNone)};
    for (const VertexId s : sources) {
        search.squared[s] = 0.0;
        search.nearest[s] = s;
    }
    if (!sources.empty() && sources.size() < count) {
        const PointTree tree(positions, sources);
        const std::vector<VertexId> open = walk_to_nearest(search, tree);
        if (!open.empty()) {
            hand_on(search, open);
            settle(search, all_doubts(search, tree, open));
        }
        for_each_vertex(count,
                        [&](std::size_t v) { search.squared[v] = std::sqrt(search.squared[v]); });
    }
    return std::move(search.squared);
}

}  // namespace vesselbench::detail
