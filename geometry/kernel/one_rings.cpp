#include "geometry/kernel/one_rings.h"

#include <algorithm>
#include <atomic>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "geometry/kernel/large_array.h"
#include "geometry/kernel/vertex_corners.h"

namespace vesselbench {

namespace {

constexpr std::size_t kGrain = 4096;
constexpr int kLanes = 8;

/// Eight vertex ids: one AVX2 register, or two of any x86-64.
using Lanes = std::int32_t __attribute__((vector_size(32), may_alias));
using UnalignedLanes = std::int32_t __attribute__((vector_size(32), may_alias, aligned(4)));

struct HalfEdge {
    VertexId from, to;

    auto operator<=>(const HalfEdge&) const = default;
};

/// The next vertex in every triangle at a vertex: at inner vertices of a manifold, its neighbours.
struct NextVertices {
    std::int32_t none;                ///< pads rows: the vertex count, which has a row as well
    LargeArray<std::int32_t> values;  ///< kLanes at each vertex
    LargeArray<std::uint8_t> counts;  ///< kLanes + 1: there are more
    std::vector<HalfEdge> more;       ///< those beyond kLanes, ascending

    NextVertices(const VertexCorners& corners, std::size_t vertex_count);

    /// Fills the part of the arrays that belongs to a share of the vertices.
    void collect(const VertexCorners& corners, const VertexRange& share,
                 std::vector<HalfEdge>& beyond);

    [[nodiscard]] std::span<const std::int32_t> some_of(VertexId v) const {
        return {values.data() + kLanes * static_cast<std::size_t>(v),
                std::min<std::size_t>(kLanes, counts[v])};
    }

    [[nodiscard]] std::span<const HalfEdge> more_of(VertexId v) const {
        if (counts[v] <= kLanes) return {};
        return {std::ranges::lower_bound(more, HalfEdge{v, 0}),
                std::ranges::upper_bound(more, HalfEdge{v, 0xFFFFFFFF})};
    }

    /// All next vertices of v, ascending.
    [[nodiscard]] std::vector<VertexId> of(VertexId v) const {
        const auto some = some_of(v);
        std::vector<VertexId> all(some.begin(), some.end());
        for (const HalfEdge& edge : more_of(v)) all.push_back(edge.to);
        std::ranges::sort(all);
        return all;
    }

    /// How often `to` is a next vertex of v.
    [[nodiscard]] std::ptrdiff_t count(VertexId v, VertexId to) const {
        return std::ranges::count(some_of(v), static_cast<std::int32_t>(to)) +
               static_cast<std::ptrdiff_t>(
                   std::ranges::equal_range(more_of(v), HalfEdge{v, to}).size());
    }
};

NextVertices::NextVertices(const VertexCorners& corners, std::size_t vertex_count)
    : none(static_cast<std::int32_t>(vertex_count)),
      values(kLanes * (vertex_count + 1)),
      counts(vertex_count + 1) {
    const std::vector<VertexRange> ranges = vertex_shares(vertex_count);
    std::vector<std::vector<HalfEdge>> beyond(ranges.size());
    std::fill_n(values.data() + kLanes * vertex_count, kLanes, none);
    tbb::parallel_for(std::size_t{0}, ranges.size(),
                      [&](std::size_t i) { collect(corners, ranges[i], beyond[i]); });
    for (const auto& some : beyond) more.insert(more.end(), some.begin(), some.end());
    std::ranges::sort(more);
}

void NextVertices::collect(const VertexCorners& corners, const VertexRange& share,
                           std::vector<HalfEdge>& beyond) {
    std::int32_t* const rows = values.data();
    std::uint8_t* const sizes = counts.data();
    std::size_t empty = share.first;
    const auto empty_until = [&](std::size_t last) {  // shortly before they are written
        if (last <= empty) return;
        std::fill(rows + kLanes * empty, rows + kLanes * last, none);
        std::fill(sizes + empty, sizes + last, std::uint8_t{0});
        empty = last;
    };
    const auto add = [&](VertexId v, VertexId next, VertexId, TriangleId)
        __attribute__((always_inline)) {
        const std::size_t known = sizes[v];
        if (known < kLanes)
            rows[kLanes * static_cast<std::size_t>(v) + known] = static_cast<std::int32_t>(next);
        else
            beyond.push_back({v, next});
        sizes[v] = static_cast<std::uint8_t>(known + (known <= kLanes ? 1 : 0));
    };
    corners.visit_at(share, empty_until, add);
    empty_until(share.last);
}

namespace any_cpu {
#include "geometry/kernel/one_rings.inc"
}

#pragma GCC push_options
#pragma GCC target("avx2")

namespace avx2 {
#include "geometry/kernel/one_rings.inc"
}

#pragma GCC pop_options

bool has_avx2() {
    static const bool has = __builtin_cpu_supports("avx2") != 0;
    return has;
}

/// True if v looks like an inner vertex of a manifold: its row is right if this holds for all
/// vertices that have v as a next vertex, too.
bool is_inner(const NextVertices& next, VertexId v, const std::vector<VertexId>& around) {
    return std::ranges::adjacent_find(around) == around.end() &&
           std::ranges::all_of(around, [&](VertexId u) { return u != v && next.count(u, v) == 1; });
}

/// 1 at all vertices that are not inner vertices of a manifold, and at some around them, #V.
std::vector<std::uint8_t> find_irregular(const NextVertices& next, std::size_t vertex_count) {
    std::vector<std::uint8_t> irregular(vertex_count, 0);
    const auto mark = [&](VertexId v) {
        std::atomic_ref(irregular[v]).store(1, std::memory_order_relaxed);
    };
    const auto look_closer = [&](VertexId v) {
        const std::vector<VertexId> around = next.of(v);
        if (is_inner(next, v, around)) return;
        mark(v);
        for (const VertexId u : around) mark(u);
    };
    const tbb::blocked_range<std::size_t> all(0, vertex_count, kGrain);
    tbb::parallel_for(all, [&](const auto& range) {
        if (has_avx2())
            avx2::find_doubts(next, range.begin(), range.end(), look_closer);
        else
            any_cpu::find_doubts(next, range.begin(), range.end(), look_closer);
    });
    return irregular;
}

/// Rows of the irregular vertices of a share.
struct GeneralRows {
    std::vector<VertexId> vertices;
    CompressedRows corners;            ///< the other corners of their triangles; rows at the front
    std::vector<std::uint32_t> sizes;  ///< of the rows

    [[nodiscard]] std::span<std::uint32_t> around(std::size_t i) {
        return {corners.values.data() + corners.offsets[i],
                corners.values.data() + corners.offsets[i + 1]};
    }
};

void collect_corners(const VertexCorners& corners, const VertexRange& share,
                     const std::vector<std::uint8_t>& irregular, GeneralRows& found) {
    std::vector<std::uint32_t> index(share.last - share.first);
    for (std::uint32_t i = 0; i < found.vertices.size(); ++i)
        index[found.vertices[i] - share.first] = i;
    auto& offsets = found.corners.offsets;
    offsets.assign(found.vertices.size() + 1, 0);
    corners.visit_at(share, [&](VertexId v, VertexId, VertexId, TriangleId) {
        if (irregular[v] != 0) offsets[index[v - share.first] + 1] += 2;
    });
    for (std::size_t i = 1; i < offsets.size(); ++i) offsets[i] += offsets[i - 1];
    found.corners.values.resize(offsets.back());
    std::vector<std::uint32_t> place(offsets.begin(), offsets.end() - 1);
    corners.visit_at(share, [&](VertexId v, VertexId next, VertexId previous, TriangleId) {
        if (irregular[v] == 0) return;
        std::uint32_t& at = place[index[v - share.first]];
        found.corners.values[at++] = next;
        found.corners.values[at++] = previous;
    });
}

/// A row of arbitrary corners: repeated ones, of degenerate triangles. It is moved to the front of
/// `around`.
/// \return its size
std::uint32_t make_row(VertexId v, std::span<std::uint32_t> around, std::uint8_t& boundary) {
    std::ranges::sort(around);
    std::uint32_t size = 0;
    boundary = 0;
    for (std::size_t i = 0, end = 0; i < around.size(); i = end) {
        while (end < around.size() && around[end] == around[i]) ++end;
        if (around[i] == v) continue;
        if (end - i == 1) boundary = 1;
        around[size++] = around[i];
    }
    return size;
}

/// \param flags 1 at the irregular vertices; afterwards 1 at those on a boundary
GeneralRows general_rows(const VertexCorners& corners, const VertexRange& share,
                         std::vector<std::uint8_t>& flags) {
    GeneralRows found;
    for (VertexId v = share.first; v < share.last; ++v)
        if (flags[v] != 0) found.vertices.push_back(v);
    if (found.vertices.empty()) return found;
    collect_corners(corners, share, flags, found);
    for (std::size_t i = 0; i < found.vertices.size(); ++i) {
        const VertexId v = found.vertices[i];
        found.sizes.push_back(make_row(v, found.around(i), flags[v]));
    }
    return found;
}

std::vector<std::uint32_t> row_offsets(const NextVertices& next, std::size_t vertex_count,
                                       std::span<const GeneralRows> general) {
    std::vector<std::uint32_t> offsets(vertex_count + 1, 0);
    for (std::size_t v = 0; v < vertex_count; ++v)
        offsets[v + 1] = std::min<std::uint32_t>(next.counts[v], kLanes);
    for (const HalfEdge& edge : next.more) ++offsets[edge.from + 1];
    for (const GeneralRows& some : general)
        for (std::size_t i = 0; i < some.vertices.size(); ++i)
            offsets[some.vertices[i] + 1] = some.sizes[i];
    for (std::size_t v = 0; v < vertex_count; ++v) offsets[v + 1] += offsets[v];
    return offsets;
}

/// Writes the rows with more than kLanes next vertices; those of irregular vertices are still
/// wrong.
void write_long_rows(const NextVertices& next, CompressedRows& rows) {
    for (std::size_t i = 0; i < next.more.size();) {
        const VertexId v = next.more[i].from;
        const std::vector<VertexId> row = next.of(v);
        i += row.size() - kLanes;
        if (row.size() == rows.row(v).size())
            std::ranges::copy(row, rows.values.begin() + rows.offsets[v]);
    }
}

}  // namespace

OneRings one_rings(std::span<const Triangle> triangles, std::size_t vertex_count) {
    const VertexCorners corners(triangles);
    const NextVertices next(corners, vertex_count);
    OneRings rings;
    rings.boundary = find_irregular(next, vertex_count);
    const std::vector<VertexRange> ranges = vertex_shares(vertex_count);
    std::vector<GeneralRows> general(ranges.size());
    tbb::parallel_for(std::size_t{0}, ranges.size(), [&](std::size_t i) {
        general[i] = general_rows(corners, ranges[i], rings.boundary);
    });
    CompressedRows& rows = rings.rows;
    rows.offsets = row_offsets(next, vertex_count, general);
    rows.values.resize(rows.offsets.back());
    const tbb::blocked_range<std::size_t> all(0, vertex_count, kGrain);
    tbb::parallel_for(all, [&](const auto& range) {
        if (has_avx2())
            avx2::write_rows(next, range.begin(), range.end(), rows);
        else
            any_cpu::write_rows(next, range.begin(), range.end(), rows);
    });
    write_long_rows(next, rows);
    for (GeneralRows& some : general)
        for (std::size_t i = 0; i < some.vertices.size(); ++i)
            std::copy_n(some.around(i).begin(), some.sizes[i],
                        rows.values.begin() + rows.offsets[some.vertices[i]]);
    return rings;
}

}  // namespace vesselbench
