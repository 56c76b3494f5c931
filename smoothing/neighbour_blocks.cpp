#include "smoothing/neighbour_blocks.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

namespace vesselbench::detail {

namespace {

/// Largest difference of the numbers of two neighbours.
std::size_t bandwidth(const CompressedRows& rows, std::size_t count) {
    return tbb::parallel_reduce(
        tbb::blocked_range<std::size_t>(0, count, 8192), std::size_t{0},
        [&](const auto& range, std::size_t largest) {
            for (std::size_t v = range.begin(); v != range.end(); ++v) {
                const auto row = rows.row(v);  // ascending: its ends are the farthest
                if (row.empty()) continue;
                if (row.front() < v) largest = std::max(largest, v - row.front());
                if (row.back() > v) largest = std::max(largest, row.back() - v);
            }
            return largest;
        },
        [](std::size_t a, std::size_t b) { return std::max(a, b); });
}

/// A band this wide comes with any sensible numbering of a surface's vertices by slices or fronts.
std::size_t usual_bandwidth(std::size_t count) {
    return 4 * NeighbourBlocks::kBlock +
           8 * static_cast<std::size_t>(std::sqrt(static_cast<double>(count)));
}

/// Breadth-first order; appends the component of `start` to `order`.
void append_component(const CompressedRows& rows, VertexId start, std::vector<std::uint8_t>& seen,
                      std::vector<VertexId>& order) {
    std::size_t next = order.size();
    seen[start] = 1;
    order.push_back(start);
    for (; next < order.size(); ++next)
        for (const VertexId u : rows.row(order[next]))
            if (!seen[u]) {
                seen[u] = 1;
                order.push_back(u);
            }
}

/// Every component from an end of it: the vertex that a first search reaches last.
std::vector<VertexId> order_along_mesh(const CompressedRows& rows, std::size_t count) {
    std::vector<VertexId> order, trial;
    order.reserve(count);
    std::vector<std::uint8_t> seen(count, 0), tried(count, 0);
    for (VertexId v = 0; v < count; ++v) {
        if (seen[v]) continue;
        trial.clear();
        append_component(rows, v, tried, trial);
        append_component(rows, trial.back(), seen, order);
    }
    return order;
}

/// Fills `members` with 0 ... count - 1 by valence; a counting sort, as most valences are small.
template <class Valence>
void sort_by_valence(std::uint16_t* members, std::size_t count, const Valence& valence) {
    constexpr std::uint32_t kMany = 31;  // as large or larger: sorted at the end
    std::array<std::uint16_t, kMany + 2> starts{};
    for (std::size_t i = 0; i < count; ++i) ++starts[std::min(valence(i), kMany) + 1];
    for (std::size_t n = 1; n < starts.size(); ++n) starts[n] += starts[n - 1];
    const std::uint16_t many = starts[kMany];
    for (std::size_t i = 0; i < count; ++i)
        members[starts[std::min(valence(i), kMany)]++] = static_cast<std::uint16_t>(i);
    std::stable_sort(members + many, members + count,
                     [&](std::uint16_t a, std::uint16_t b) { return valence(a) < valence(b); });
}

std::vector<std::uint32_t> inverse(const std::vector<VertexId>& order) {
    std::vector<std::uint32_t> places(order.size());
    for (std::size_t i = 0; i < order.size(); ++i) places[order[i]] = static_cast<std::uint32_t>(i);
    return places;
}

}  // namespace

NeighbourBlocks::NeighbourBlocks(const CompressedRows& rows)
    : vertex_count_(rows.offsets.empty() ? 0 : rows.offsets.size() - 1) {
    std::size_t band = bandwidth(rows, vertex_count_);
    std::vector<std::uint32_t> places;
    if (band > usual_bandwidth(vertex_count_)) {
        order_ = order_along_mesh(rows, vertex_count_);
        places = inverse(order_);
        band = 0;
        for (std::size_t v = 0; v < vertex_count_; ++v)
            for (const VertexId u : rows.row(v))
                band = std::max<std::size_t>(
                    band, std::max(places[u], places[v]) - std::min(places[u], places[v]));
    }
    reach_ = (band + kBlock - 1) / kBlock;
    const std::size_t blocks = (vertex_count_ + kBlock - 1) / kBlock;
    group_offsets_.assign(blocks + 1, 0);
    neighbour_offsets_.assign(blocks + 1, 0);
    members_.resize(blocks * kBlock);
    neighbours_ = LargeArray<std::uint32_t>(rows.values.size());
    for (std::size_t block = 0; block < blocks; ++block) {
        std::size_t size = 0;
        const std::size_t end = std::min(vertex_count_, (block + 1) * kBlock);
        if (order_.empty())
            size = rows.offsets[end] - rows.offsets[block * kBlock];
        else
            for (std::size_t p = block * kBlock; p < end; ++p) size += rows.row(order_[p]).size();
        neighbour_offsets_[block + 1] =
            neighbour_offsets_[block] + static_cast<std::uint32_t>(size);
    }
    std::vector<std::vector<BlockGroup>> groups(blocks);
    tbb::parallel_for(std::size_t{0}, blocks,
                      [&](std::size_t block) { groups[block] = fill_block(rows, places, block); });
    for (std::size_t block = 0; block < blocks; ++block) {
        groups_.insert(groups_.end(), groups[block].begin(), groups[block].end());
        group_offsets_[block + 1] = static_cast<std::uint32_t>(groups_.size());
    }
}

std::vector<BlockGroup> NeighbourBlocks::fill_block(const CompressedRows& rows,
                                                    std::span<const std::uint32_t> places,
                                                    std::size_t block) {
    const std::size_t first = block * kBlock;
    const std::size_t count = std::min(vertex_count_, first + kBlock) - first;
    const auto valence = [&](std::size_t i) {
        const std::size_t v = vertex_at(first + i);
        return rows.offsets[v + 1] - rows.offsets[v];
    };
    std::uint16_t* members = members_.data() + first;
    sort_by_valence(members, count, valence);
    std::vector<BlockGroup> groups;
    std::uint32_t* out = neighbours_.data() + neighbour_offsets_[block];
    for (std::size_t i = 0; i < count; ++i) {
        const auto row = rows.row(vertex_at(first + members[i]));
        if (groups.empty() || groups.back().valence != row.size())
            groups.push_back({static_cast<std::uint32_t>(row.size()), 0});
        ++groups.back().count;
        for (const VertexId u : row) *out++ = 4 * (places.empty() ? u : places[u]);
    }
    return groups;
}

}  // namespace vesselbench::detail
