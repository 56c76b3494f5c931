#include "geometry/one_rings.h"

#include <algorithm>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace vesselbench {

namespace {

constexpr std::size_t kGrain = 4096;
constexpr int kLanes = 8;
constexpr std::int32_t kNone = 0x7fffffff;  // greater than every vertex

/// Four vertex ids in one register of any x86-64.
using Quad = std::int32_t __attribute__((vector_size(16), may_alias));

/// The two other corners of one triangle at a vertex, counter-clockwise.
struct Corner {
    std::int32_t next, previous;
};

/// Corners around every vertex in one array: row v is [offsets[v], offsets[v + 1]).
struct Corners {
    std::vector<std::uint32_t> offsets;
    std::vector<Corner> values;
};

/// Calls work(first, last) for as many ranges of vertices as there are threads. Every range looks
/// at all triangles, so few and large ranges are best.
template <class Work>
void for_each_share(std::size_t vertex_count, const Work& work) {
    const auto shares = static_cast<std::size_t>(
        std::clamp(tbb::this_task_arena::max_concurrency(), 1, 16));  // beyond: reading dominates
    tbb::parallel_for(std::size_t{0}, shares, [&](std::size_t i) {
        work(static_cast<VertexId>(vertex_count * i / shares),
             static_cast<VertexId>(vertex_count * (i + 1) / shares));
    });
}

Corners corners_by_vertex(std::span<const Triangle> triangles, std::size_t vertex_count) {
    Corners corners;
    auto& offsets = corners.offsets;
    offsets.assign(vertex_count + 1, 0);
    for_each_share(vertex_count, [&](VertexId first, VertexId last) {
        for (const Triangle& t : triangles)
            for (const VertexId v : t)
                if (v - first < last - first) ++offsets[v + 1];
    });
    for (std::size_t v = 0; v < vertex_count; ++v) offsets[v + 1] += offsets[v];
    corners.values.resize(offsets.back());
    std::vector<std::uint32_t> place(offsets.begin(), offsets.end() - 1);
    for_each_share(vertex_count, [&](VertexId first, VertexId last) {
        for (const Triangle& t : triangles)
            for (int k = 0; k < 3; ++k)
                if (t[k] - first < last - first)
                    corners.values[place[t[k]]++] = {static_cast<std::int32_t>(t[(k + 1) % 3]),
                                                     static_cast<std::int32_t>(t[(k + 2) % 3])};
    });
    return corners;
}

/// A row before it is packed; it stands at the place of its vertex' corners.
struct RawRow {
    std::uint32_t size;
    bool boundary;
};

/// The general case: any corners, repeated ones, degenerate triangles.
RawRow sorted_row(VertexId v, std::span<const Corner> at, std::int32_t* row) {
    std::vector<std::int32_t> around;
    for (const Corner& corner : at)
        for (const std::int32_t u : {corner.next, corner.previous})
            if (u != static_cast<std::int32_t>(v)) around.push_back(u);
    std::sort(around.begin(), around.end());
    RawRow result{0, false};
    for (std::size_t i = 0; i < around.size();) {
        std::size_t end = i + 1;
        while (end < around.size() && around[end] == around[i]) ++end;
        if (end - i == 1) result.boundary = true;
        row[result.size++] = around[i];
        i = end;
    }
    return result;
}

/// How many of eight values are smaller than each of eight others.
inline void rank(const std::int32_t* values, const std::int32_t* others, std::int32_t* ranks) {
    const auto* quads = reinterpret_cast<const Quad*>(others);
    Quad low{}, high{};
    for (int i = 0; i < kLanes; ++i) {
        const Quad all{values[i], values[i], values[i], values[i]};
        low -= all < quads[0];  // a true lane is -1
        high -= all < quads[1];
    }
    reinterpret_cast<Quad*>(ranks)[0] = low;
    reinterpret_cast<Quad*>(ranks)[1] = high;
}

/// The usual case, without a branch: an inner vertex of a manifold with at most eight triangles,
/// whose neighbours stand once as `next` and once as `previous`. They are sorted by their ranks.
/// \return 0 if the vertex is not of this kind
inline std::uint32_t manifold_row(VertexId v, const Corner* at, std::uint32_t size,
                                  std::int32_t* row) {
    alignas(16) std::int32_t next[kLanes], previous[kLanes], next_rank[kLanes],
        previous_rank[kLanes], sorted[kLanes + 1];
    for (std::uint32_t i = 0; i < kLanes; ++i) {
        next[i] = i < size ? at[i].next : kNone;
        previous[i] = i < size ? at[i].previous : kNone;
    }
    rank(next, next, next_rank);
    rank(next, previous, previous_rank);
    std::uint32_t seen = 0, seen_previous = 0;
    std::int32_t different = 0;
    for (int i = 0; i < kLanes; ++i) {
        sorted[next_rank[i]] = next[i];
        seen |= 1U << next_rank[i];
    }
    for (int i = 0; i < kLanes; ++i) {
        different |= sorted[previous_rank[i]] ^ previous[i];
        seen_previous |= 1U << previous_rank[i];
    }
    const std::uint32_t every = size < kLanes ? (2U << size) - 1U : 255U;
    bool self = false;
    for (std::uint32_t i = 0; i < size; ++i) self |= sorted[i] == static_cast<std::int32_t>(v);
    if (seen != every || seen_previous != every || different != 0 || self) return 0;
    for (std::uint32_t i = 0; i < size; ++i) row[i] = sorted[i];
    return size;
}

/// Replaces the corners of the vertices [first, last) by their neighbours.
void make_rows(Corners& corners, std::size_t first, std::size_t last, OneRings& rings) {
    for (std::size_t v = first; v < last; ++v) {
        Corner* at = corners.values.data() + corners.offsets[v];
        auto* row = reinterpret_cast<std::int32_t*>(at);
        const std::uint32_t size = corners.offsets[v + 1] - corners.offsets[v];
        std::uint32_t made = 0;
        if (size > 0 && size <= kLanes)
            made = manifold_row(static_cast<VertexId>(v), at, size, row);
        if (made == 0) {
            const RawRow raw = sorted_row(static_cast<VertexId>(v), {at, size}, row);
            made = raw.size;
            rings.boundary[v] = raw.boundary ? 1 : 0;
        }
        rings.rows.offsets[v + 1] = made;
    }
}

}  // namespace

OneRings one_rings(std::span<const Triangle> triangles, std::size_t vertex_count) {
    Corners corners = corners_by_vertex(triangles, vertex_count);
    OneRings rings;
    rings.boundary.assign(vertex_count, 0);
    auto& offsets = rings.rows.offsets;
    offsets.assign(vertex_count + 1, 0);
    const tbb::blocked_range<std::size_t> all(0, vertex_count, kGrain);
    tbb::parallel_for(
        all, [&](const auto& range) { make_rows(corners, range.begin(), range.end(), rings); });
    for (std::size_t v = 0; v < vertex_count; ++v) offsets[v + 1] += offsets[v];
    rings.rows.values.resize(offsets.back());
    tbb::parallel_for(all, [&](const auto& range) {
        for (std::size_t v = range.begin(); v < range.end(); ++v) {
            const auto* row =
                reinterpret_cast<const std::uint32_t*>(corners.values.data() + corners.offsets[v]);
            std::copy_n(row, offsets[v + 1] - offsets[v], rings.rows.values.data() + offsets[v]);
        }
    });
    return rings;
}

}  // namespace vesselbench
