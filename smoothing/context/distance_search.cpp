#include "smoothing/context/distance_search.h"

#include <atomic>
#include <span>

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

namespace vesselbench {

namespace {

/// Vertices visited by a flood, without clearing between floods.
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
/// about it is visited.
void flood(DistanceSearch& search, std::span<const Doubt> doubts, FloodMarks& marks) {
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

}  // namespace

void settle_doubts(DistanceSearch& search, const std::vector<Doubt>& doubts) {
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

}  // namespace vesselbench
