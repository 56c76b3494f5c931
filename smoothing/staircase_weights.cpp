#include "smoothing/staircase_weights.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include "geometry/box_tree.h"
#include "geometry/errors.h"
#include "smoothing/filter_support.h"

namespace vesselbench {

namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();

void require_parameters(const Topology& topology, const Positions& positions,
                        std::span<const double> change, const StaircaseParameters& parameters) {
    const std::size_t count = topology.vertex_count();
    if (positions.size() != count || change.size() != count ||
        (!parameters.caps.empty() && parameters.caps.size() != count))
        throw InvalidInput("positions, orientation changes and cap flags must be as many as the " +
                           std::to_string(count) + " vertices");
    detail::require_range("tau_theta", parameters.tau_theta, 0.0, 1.0);
    detail::require_positive("tau_max", parameters.tau_max);
    detail::require_range("beta_min", parameters.beta_min, 0.0, 1.0);
}

/// Squared distances to the nearest known staircase vertex, on the way to the exact ones.
struct Search {
    const CompressedRows& rings;
    const Positions& x;
    double squared_reach;
    std::vector<VertexId> sources;  ///< staircase vertices, ascending
    std::vector<double> squared;    ///< #V
};

/// Spreads every staircase vertex over its surroundings; where two meet, the nearer one goes on.
/// What a vertex gets has come along a path within the reach: it is an upper bound, and nearly
/// always the distance itself.
void spread(Search& search) {
    std::vector<VertexId> nearest(search.squared.size()), queue;
    std::vector<std::uint8_t> queued(search.squared.size(), 0);
    for (const VertexId s : search.sources) {
        nearest[s] = s;
        for (const VertexId u : search.rings.row(s))
            if (search.squared[u] > 0.0) {
                queue.push_back(s);
                queued[s] = 1;
                break;
            }
    }
    for (std::size_t i = 0; i < queue.size(); ++i) {
        const VertexId v = queue[i], source = nearest[v];
        queued[v] = 0;
        for (const VertexId u : search.rings.row(v)) {
            if (search.squared[u] == 0.0) continue;
            const double squared = (search.x[u] - search.x[source]).squaredNorm();
            if (squared > search.squared_reach || squared >= search.squared[u]) continue;
            search.squared[u] = squared;
            nearest[u] = source;
            if (queued[u] == 0) queue.push_back(u);
            queued[u] = 1;
        }
    }
}

/// Calls visit(i) for the sources that are nearer to p than the square root of `squared`.
template <class Visit>
void visit_nearer(const BoxTree& tree, const Search& search, const Vec3& p, double squared,
                  const Visit& visit) {
    std::array<std::uint32_t, 64> stack;  // deeper than any tree of 2^32 items split in halves
    std::size_t size = 0;
    stack[size++] = 0;
    while (size > 0) {
        const std::uint32_t at = stack[--size];
        const BoxTree::Node& node = tree.nodes()[at];
        if (node.box.squaredExteriorDistance(p) >= squared) continue;
        if (node.right == 0) {
            for (std::uint32_t i = node.begin; i < node.end; ++i) {
                const std::uint32_t source = tree.items()[i];
                if ((p - search.x[search.sources[source]]).squaredNorm() < squared) visit(source);
            }
        } else {
            stack[size++] = node.right;
            stack[size++] = at + 1;
        }
    }
}

/// 1 at sources that are nearer to some vertex than what it has got: either another sheet of the
/// surface, or a vertex that nearer ones cut off. #sources
std::vector<std::uint8_t> doubtful_sources(const Search& search) {
    std::vector<std::uint8_t> doubtful(search.sources.size(), 0);
    std::vector<BoxTree::Box> boxes;
    boxes.reserve(search.sources.size());
    for (const VertexId s : search.sources) boxes.emplace_back(search.x[s]);
    const BoxTree tree(boxes);
    const double just_beyond = std::nextafter(search.squared_reach, kFar);
    detail::for_each_vertex(search.x.size(), [&](std::size_t v) {
        if (search.squared[v] == 0.0) return;
        visit_nearer(tree, search, search.x[v], std::min(search.squared[v], just_beyond),
                     [&](std::uint32_t i) {
                         std::atomic_ref(doubtful[i]).store(1, std::memory_order_relaxed);
                     });
    });
    return doubtful;
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

/// The definition itself: everything that can be reached from the source within its reach.
void flood(Search& search, VertexId source, FloodMarks& marks) {
    if (marks.met.empty()) marks.met.assign(search.x.size(), 0);
    marks.met[source] = ++marks.flood;
    marks.queue.assign(1, source);
    for (std::size_t i = 0; i < marks.queue.size(); ++i)
        for (const VertexId u : search.rings.row(marks.queue[i])) {
            if (marks.met[u] == marks.flood) continue;
            marks.met[u] = marks.flood;
            const double squared = (search.x[u] - search.x[source]).squaredNorm();
            if (!(squared <= search.squared_reach)) continue;
            lower(search.squared[u], squared);
            marks.queue.push_back(u);
        }
}

}  // namespace

std::vector<double> staircase_distances(const Topology& topology, const Positions& positions,
                                        std::span<const double> change,
                                        const StaircaseParameters& parameters) {
    require_parameters(topology, positions, change, parameters);
    Search search{topology.rings(),
                  positions,
                  parameters.tau_max * parameters.tau_max,
                  {},
                  std::vector<double>(positions.size(), kFar)};
    for (VertexId v = 0; v < change.size(); ++v) {
        const bool cap = !parameters.caps.empty() && parameters.caps[v] != 0;
        if (!(change[v] > parameters.tau_theta) || cap) continue;
        search.sources.push_back(v);
        search.squared[v] = 0.0;
    }
    if (!search.sources.empty() && search.sources.size() < change.size()) {
        spread(search);
        const auto doubtful = doubtful_sources(search);
        tbb::enumerable_thread_specific<FloodMarks> marks;
        const tbb::blocked_range<std::size_t> all(0, doubtful.size(), 64);
        tbb::parallel_for(all, [&](const auto& range) {
            for (std::size_t i = range.begin(); i != range.end(); ++i)
                if (doubtful[i] != 0) flood(search, search.sources[i], marks.local());
        });
    }
    for (double& value : search.squared) value = std::sqrt(value);
    return std::move(search.squared);
}

std::vector<double> staircase_weights(const Topology& topology, const Positions& positions,
                                      std::span<const double> change,
                                      const StaircaseParameters& parameters) {
    std::vector<double> weights = staircase_distances(topology, positions, change, parameters);
    double largest = parameters.tau_max;
    if (parameters.scaling == StaircaseScaling::Thesis) {
        largest = 0.0;
        for (const double d : weights)
            if (d != kFar) largest = std::max(largest, d);
    }
    for (std::size_t v = 0; v < weights.size(); ++v) {
        const double d = weights[v];
        const double near = d == kFar ? 0.0 : largest > 0.0 ? 1.0 - d / largest : 1.0;  // (5.5)
        weights[v] = near * (1.0 - parameters.beta_min) + parameters.beta_min;          // (5.6)
        if (!parameters.caps.empty() && parameters.caps[v] != 0) weights[v] = 0.0;
    }
    return weights;
}

}  // namespace vesselbench
