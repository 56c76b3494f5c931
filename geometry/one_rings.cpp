#include "geometry/one_rings.h"

#include <algorithm>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "geometry/large_array.h"

namespace vesselbench {

namespace {

constexpr std::size_t kGrain = 4096;
constexpr int kLanes = 8;
constexpr std::int32_t kNone = 0x7fffffff;  // greater than every vertex

/// Eight vertex ids: one AVX2 register, or two of any x86-64.
using Lanes = std::int32_t __attribute__((vector_size(32), may_alias));

/// The two other corners of one triangle at a vertex, counter-clockwise.
struct Corner {
    std::int32_t next, previous;
};

/// Corners around every vertex in one array: row v is [offsets[v], offsets[v + 1]).
struct Corners {
    std::vector<std::uint32_t> offsets;
    LargeArray<Corner> values;
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
    corners.values = LargeArray<Corner>(offsets.back());
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

namespace any_cpu {
#include "geometry/one_rings.inc"
}

#pragma GCC push_options
#pragma GCC target("avx2")

namespace avx2 {
#include "geometry/one_rings.inc"
}

#pragma GCC pop_options

void make_rows(Corners& corners, std::size_t first, std::size_t last, OneRings& rings) {
    static const bool wide = __builtin_cpu_supports("avx2") != 0;
    if (wide)
        avx2::make_rows(corners, first, last, rings);
    else
        any_cpu::make_rows(corners, first, last, rings);
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
