#include "smoothing/context/connected_distances.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include "geometry/kernel/parallel.h"
#include "smoothing/context/distance_search.h"
#include "smoothing/context/point_grid.h"
#include "smoothing/context/point_tree.h"

namespace vesselbench {

namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();
constexpr VertexId kNone = std::numeric_limits<VertexId>::max();

/// True if a walk from v along the edge that leads closest to the source arrives there. Every
/// vertex of such a walk is closer to the source than v; false proves nothing.
bool walk_arrives(const DistanceSearch& search, VertexId v, VertexId source) {
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

/// The nearest of the sources that reach a neighbour of v. They reach v, too, if they are within
/// reach. Considers sources and the vertices from `first` to v - 1.
PointTree::Found handed_on(const DistanceSearch& search, VertexId v, VertexId first,
                           double just_beyond) {
    PointTree::Found best{kNone, just_beyond};
    VertexId last = kNone;
    for (const VertexId u : search.rings.row(v)) {
        const bool settled = u >= first && u < v && search.nearest[u] != kNone;
        if (!settled && search.is_source[u] == 0) continue;
        const VertexId source = search.is_source[u] != 0 ? u : search.nearest[u];
        if (source == last) continue;
        last = source;
        const double squared = search.squared_distance(v, source);
        if (squared < best.squared) best = {source, squared};
    }
    return best;
}

/// Assigns to every vertex the nearest of all sources if a neighbour or a walk proves that it
/// reaches the vertex.
/// \return vertices with a source within reach whose nearest one lacks such a proof
template <class Places>
std::vector<VertexId> find_nearest(DistanceSearch& search, const Places& places) {
    const std::size_t count = search.x.size();
    const double just_beyond = std::nextafter(search.squared_reach, kFar);
    std::vector<std::uint8_t> open(count, 0);
    const tbb::blocked_range<std::size_t> all(0, count, 1024);
    tbb::parallel_for(all, [&](const auto& range) {
        const auto first = static_cast<VertexId>(range.begin());
        for (VertexId v = first; v < range.end(); ++v) {
            if (search.is_source[v] != 0 || !search.x[v].allFinite()) continue;
            const PointTree::Found known = handed_on(search, v, first, just_beyond);
            const PointTree::Found found = places.nearest(search.x[v], known);
            if (found.vertex == kNone) continue;
            const bool reached =
                found.vertex == known.vertex || walk_arrives(search, v, found.vertex);
            open[v] = reached ? 0 : 1;
            if (!reached) continue;
            search.squared[v] = found.squared;
            search.nearest[v] = found.vertex;
        }
    });
    std::vector<VertexId> result;
    for (VertexId v = 0; v < count; ++v)
        if (open[v] != 0) result.push_back(v);
    return result;
}

/// Passes sources on to open vertices from their neighbours: a source that reaches a neighbour
/// reaches them too, if it is within its reach. An upper bound of their distance.
void hand_on(DistanceSearch& search, const std::vector<VertexId>& open) {
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

/// Connected parts of the surface, each with its bounding box.
struct Parts {
    std::vector<std::uint32_t> part;  ///< #V
    std::vector<BoxTree::Box> boxes;

    explicit Parts(const DistanceSearch& search) : part(search.x.size(), kNone) {
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

    /// True if the whole part of the source is certainly within its reach.
    [[nodiscard]] bool within_reach(const DistanceSearch& search, VertexId source) const {
        const BoxTree::Box& box = boxes[part[source]];
        const Vec3& p = search.x[source];
        const Vec3 farthest = (p - box.min()).cwiseMax(box.max() - p);
        return farthest.squaredNorm() * (1.0 + 1e-12) < search.squared_reach;  // rounding
    }
};

/// Sources closer to an open vertex than its current one. The first of them that surely reaches it
/// gives its distance; those before that one are doubts.
template <class Places>
void collect_doubts(DistanceSearch& search, const Places& places, const Parts& parts, VertexId v,
                    std::vector<Doubt>& doubts) {
    std::vector<PointTree::Found> nearer;
    const double just_beyond = std::nextafter(search.squared_reach, kFar);
    places.visit_nearer(search.x[v], std::min(search.squared[v], just_beyond),
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
template <class Places>
std::vector<Doubt> all_doubts(DistanceSearch& search, const Places& places,
                              const std::vector<VertexId>& open) {
    const Parts parts(search);
    std::vector<std::uint8_t> has_source(parts.boxes.size(), 0);
    for (const VertexId s : search.sources) has_source[parts.part[s]] = 1;
    tbb::enumerable_thread_specific<std::vector<Doubt>> found;
    const tbb::blocked_range<std::size_t> all(0, open.size(), 32);
    tbb::parallel_for(all, [&](const auto& range) {
        for (std::size_t i = range.begin(); i != range.end(); ++i)
            if (has_source[parts.part[open[i]]] != 0)
                collect_doubts(search, places, parts, open[i], found.local());
    });
    std::vector<Doubt> doubts;
    for (const auto& some : found) doubts.insert(doubts.end(), some.begin(), some.end());
    std::sort(doubts.begin(), doubts.end());
    return doubts;
}

/// \param places the sources, as a spatial search structure
template <class Places>
void find_distances(DistanceSearch& search, const Places& places) {
    const std::vector<VertexId> open = find_nearest(search, places);
    if (open.empty()) return;
    hand_on(search, open);
    settle_doubts(search, all_doubts(search, places, open));
}

/// Initial state: each source is its own nearest.
DistanceSearch begun_search(const Topology& topology, const Positions& positions,
                            const std::vector<VertexId>& sources, double reach) {
    const std::size_t count = positions.size();
    DistanceSearch search{topology.rings(),
                          positions,
                          reach * reach,
                          sources,
                          std::vector<double>(count, kFar),
                          std::vector<VertexId>(count, kNone),
                          std::vector<std::uint8_t>(count, 0)};
    for (const VertexId s : sources) {
        search.squared[s] = 0.0;
        search.nearest[s] = s;
        search.is_source[s] = 1;
    }
    return search;
}

/// Calls find(places) with a spatial search structure of the sources.
template <class Find>
void with_places(const DistanceSearch& search, const Find& find) {
    const PointGrid grid(search.x, search.sources);
    if (grid.crowded())
        find(PointTree(search.x, search.sources));
    else
        find(grid);
}

}  // namespace

std::vector<double> connected_distances(const Topology& topology, const Positions& positions,
                                        const std::vector<VertexId>& sources, double reach) {
    DistanceSearch search = begun_search(topology, positions, sources, reach);
    if (!sources.empty() && sources.size() < positions.size()) {
        with_places(search, [&](const auto& places) { find_distances(search, places); });
        for_each_vertex(positions.size(),
                        [&](std::size_t v) { search.squared[v] = std::sqrt(search.squared[v]); });
    }
    return std::move(search.squared);
}

std::vector<double> open_distances(const Topology& topology, const Positions& positions,
                                   const std::vector<VertexId>& sources, double reach,
                                   std::span<const OpenVertex> open) {
    std::vector<double> distances;
    if (open.empty() || sources.empty()) return std::vector<double>(open.size(), kFar);
    DistanceSearch search = begun_search(topology, positions, sources, reach);
    std::vector<VertexId> vertices;
    for (const auto& [vertex, known] : open) {
        vertices.push_back(vertex);
        search.nearest[vertex] = known;
        if (known != kNone) search.squared[vertex] = search.squared_distance(vertex, known);
    }
    with_places(search, [&](const auto& places) {
        settle_doubts(search, all_doubts(search, places, vertices));
    });
    for (const VertexId v : vertices) distances.push_back(std::sqrt(search.squared[v]));
    return distances;
}

}  // namespace vesselbench
