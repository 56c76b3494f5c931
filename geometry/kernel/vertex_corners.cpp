#include "geometry/kernel/vertex_corners.h"

#include <cstdint>

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace vesselbench {

namespace {

/// Checks the corners of some triangles, eight at a time.
VertexRange range_of(std::span<const Triangle> triangles) {
    constexpr std::size_t kLanes = 8;
    using Lanes = std::int32_t __attribute__((vector_size(32), may_alias, aligned(4)));
    const auto* ids = reinterpret_cast<const std::int32_t*>(triangles.data());
    const std::size_t count = 3 * triangles.size(), whole = count / kLanes * kLanes;
    Lanes least{}, largest{};
    least += ids[0];
    largest += ids[0];
    for (std::size_t i = 0; i < whole; i += kLanes) {
        const Lanes some = *reinterpret_cast<const Lanes*>(ids + i);
        least = some < least ? some : least;
        largest = some > largest ? some : largest;
    }
    VertexRange range{static_cast<VertexId>(ids[0]), static_cast<VertexId>(ids[0])};
    const auto extend = [&](std::int32_t low, std::int32_t high) {
        range.first = std::min(range.first, static_cast<VertexId>(low));
        range.last = std::max(range.last, static_cast<VertexId>(high));
    };
    for (std::size_t i = 0; i < kLanes; ++i) extend(least[i], largest[i]);
    for (std::size_t i = whole; i < count; ++i) extend(ids[i], ids[i]);
    ++range.last;
    return range;
}

}  // namespace

std::vector<VertexRange> vertex_shares(std::size_t vertex_count) {
    const auto count =
        static_cast<std::size_t>(std::clamp(tbb::this_task_arena::max_concurrency(), 1, 64));
    std::vector<VertexRange> ranges(count);
    for (std::size_t i = 0; i < count; ++i)
        ranges[i] = {static_cast<VertexId>(vertex_count * i / count),
                     static_cast<VertexId>(vertex_count * (i + 1) / count)};
    return ranges;
}

VertexCorners::VertexCorners(std::span<const Triangle> triangles)
    : triangles_(triangles), ranges_((triangles.size() + kPart - 1) / kPart) {
    tbb::parallel_for(std::size_t{0}, ranges_.size(), [&](std::size_t i) {
        const std::size_t first = i * kPart;
        ranges_[i] = range_of(triangles.subspan(first, std::min(kPart, triangles.size() - first)));
    });
}

}  // namespace vesselbench
