#include "smoothing/filters/neighbour_blocks.h"

#include <algorithm>
#include <array>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "smoothing/filters/mesh_order.h"

namespace vesselbench {

namespace {

constexpr std::uint32_t kMany = 31;  // neighbours: rows with as many or more are sorted at the end

/// Fills `members` with 0 ... count - 1 by valence; a counting sort, because most valences are
/// small.
template <class Valence>
std::vector<BlockGroup> sort_by_valence(std::uint16_t* members, std::size_t count,
                                        const Valence& valence) {
    std::array<std::uint16_t, kMany + 2> starts{};
    for (std::size_t i = 0; i < count; ++i) ++starts[std::min(valence(i), kMany) + 1];
    std::vector<BlockGroup> groups;
    for (std::uint32_t n = 0; n < kMany; ++n)
        if (starts[n + 1] > 0) groups.push_back({n, starts[n + 1]});
    for (std::size_t n = 1; n < starts.size(); ++n) starts[n] += starts[n - 1];
    const std::uint16_t many = starts[kMany];
    for (std::size_t i = 0; i < count; ++i)
        members[starts[std::min(valence(i), kMany)]++] = static_cast<std::uint16_t>(i);
    std::stable_sort(members + many, members + count,
                     [&](std::uint16_t a, std::uint16_t b) { return valence(a) < valence(b); });
    for (std::size_t i = many; i < count; ++i) {
        const std::uint32_t n = valence(members[i]);
        if (groups.empty() || groups.back().valence != n) groups.push_back({n, 0});
        ++groups.back().count;
    }
    return groups;
}

/// Writes a row's neighbours, each as four times its number. Rows of up to eight are written as
/// eight, without a branch on their size, if both arrays have the room.
/// \param room behind `out`, overwritten by later rows
void copy_row(std::span<const VertexId> row, const VertexId* rows_end, std::uint32_t* out,
              std::ptrdiff_t room) {
    constexpr std::ptrdiff_t kUsual = 8;
    using Eight = std::uint32_t __attribute__((vector_size(32), may_alias, aligned(4)));
    if (std::ssize(row) <= kUsual && room >= kUsual && rows_end - row.data() >= kUsual)
        *reinterpret_cast<Eight*>(out) = *reinterpret_cast<const Eight*>(row.data()) * 4;
    else
        for (const VertexId u : row) *out++ = 4 * u;
}

}  // namespace

NeighbourBlocks::NeighbourBlocks(const CompressedRows& rows)
    : vertex_count_(rows.offsets.empty() ? 0 : rows.offsets.size() - 1),
      members_((vertex_count_ + kBlock - 1) / kBlock * kBlock),
      neighbours_(rows.values.size()) {
    std::size_t band = fill(rows, {});
    if (!follows_mesh(band, vertex_count_)) {
        order_ = order_along_mesh(rows);
        band = fill(rows, places_in(order_));
    }
    reach_ = (band + kBlock - 1) / kBlock;
}

/// Fills everything for the current order.
/// \param places of all vertices; empty: their numbers
/// \return largest distance of the places of two neighbours
std::size_t NeighbourBlocks::fill(const CompressedRows& rows,
                                  std::span<const std::uint32_t> places) {
    const std::size_t blocks = members_.size() / kBlock;
    neighbour_offsets_.assign(blocks + 1, 0);
    for (std::size_t block = 0; block < blocks; ++block) {
        std::size_t size = 0;
        const std::size_t first = block * kBlock, end = std::min(vertex_count_, first + kBlock);
        if (order_.empty())
            size = rows.offsets[end] - rows.offsets[first];
        else
            for (std::size_t p = first; p < end; ++p) size += rows.row(order_[p]).size();
        neighbour_offsets_[block + 1] =
            neighbour_offsets_[block] + static_cast<std::uint32_t>(size);
    }
    std::vector<std::vector<BlockGroup>> groups(blocks);
    std::vector<std::size_t> bands(blocks, 0);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, blocks, 8), [&](const auto& range) {
        for (std::size_t block = range.begin(); block != range.end(); ++block) {
            groups[block] = fill_groups(rows, block);
            bands[block] = places.empty() ? fill_neighbours(rows, block)
                                          : fill_neighbours(rows, places, block);
        }
    });
    groups_.clear();
    group_offsets_.assign(1, 0);
    for (const auto& some : groups) {
        groups_.insert(groups_.end(), some.begin(), some.end());
        group_offsets_.push_back(static_cast<std::uint32_t>(groups_.size()));
    }
    return bands.empty() ? 0 : *std::ranges::max_element(bands);
}

std::vector<BlockGroup> NeighbourBlocks::fill_groups(const CompressedRows& rows,
                                                     std::size_t block) {
    const std::size_t first = block * kBlock;
    return sort_by_valence(members_.data() + first, std::min(vertex_count_ - first, kBlock),
                           [&](std::size_t i) {
                               const std::size_t v = vertex_at(first + i);
                               return rows.offsets[v + 1] - rows.offsets[v];
                           });
}

/// The same if places are vertices. \return largest distance of two neighbours
std::size_t NeighbourBlocks::fill_neighbours(const CompressedRows& rows, std::size_t block) {
    const std::size_t first = block * kBlock, count = std::min(vertex_count_ - first, kBlock);
    std::uint32_t* out = neighbours_.data() + neighbour_offsets_[block];
    const std::uint32_t* end = neighbours_.data() + neighbour_offsets_[block + 1];
    const VertexId* rows_end = rows.values.data() + rows.values.size();
    std::size_t band = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t v = first + members_[first + i];
        const auto row = rows.row(v);  // ascending: the ends are farthest
        if (row.empty()) continue;
        band = std::max({band, v - std::min<std::size_t>(v, row.front()),
                         std::max<std::size_t>(v, row.back()) - v});
        copy_row(row, rows_end, out, end - out);
        out += row.size();
    }
    return band;
}

std::size_t NeighbourBlocks::fill_neighbours(const CompressedRows& rows,
                                             std::span<const std::uint32_t> places,
                                             std::size_t block) {
    const std::size_t first = block * kBlock, count = std::min(vertex_count_ - first, kBlock);
    std::uint32_t* out = neighbours_.data() + neighbour_offsets_[block];
    std::size_t band = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t place = first + members_[first + i];
        for (const VertexId u : rows.row(order_[place])) {
            band = std::max(band, std::max<std::size_t>(place, places[u]) -
                                      std::min<std::size_t>(place, places[u]));
            *out++ = 4 * places[u];
        }
    }
    return band;
}

}  // namespace vesselbench
