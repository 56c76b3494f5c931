#include "quality/ring_kernels.h"

#include <algorithm>

#include <immintrin.h>
#include <tbb/parallel_for.h>

// Functions that return wide vectors are inlined everywhere: how they would be called is no matter.
#pragma GCC diagnostic ignored "-Wpsabi"

#define ALWAYS_INLINED __attribute__((always_inline))
#define ALWAYS_INLINE inline ALWAYS_INLINED

namespace vesselbench::detail {

namespace {

using Mask = long long __attribute__((vector_size(32)));

/// The neighbours around a vertex in order; empty unless its triangles are one fan.
std::vector<std::uint32_t> fan_of(const Topology& topology, VertexId v) {
    std::vector<std::pair<VertexId, VertexId>> sides;  // from one neighbour to the next
    for (const TriangleId t : topology.triangles_at().row(v)) {
        const Triangle& c = topology.triangles()[t];
        const int k = c[0] == v ? 0 : c[1] == v ? 1 : 2;
        const VertexId from = c[(k + 1) % 3], to = c[(k + 2) % 3];
        if (from == to || from == v || to == v) return {};
        sides.emplace_back(from, to);
    }
    if (sides.empty()) return {};
    const auto goes_from = [&](VertexId u) {
        return std::ranges::find(sides, u, [](const auto& s) { return s.first; });
    };
    auto side = std::ranges::find_if(sides, [&](const auto& s) {  // that no other one leads to
        return std::ranges::find(sides, s.first, [](const auto& o) { return o.second; }) ==
               sides.end();
    });
    if (side == sides.end()) side = sides.begin();
    std::vector<std::uint32_t> fan = {side->first};
    while (side != sides.end()) {
        fan.push_back(side->second);
        sides.erase(side);
        side = goes_from(fan.back());
    }
    if (!sides.empty()) return {};
    return fan;
}

}  // namespace

Fans make_fans(const Topology& topology) {
    const std::size_t count = topology.vertex_count();
    std::vector<std::vector<std::uint32_t>> all(count);
    tbb::parallel_for(std::size_t{0}, count,
                      [&](std::size_t v) { all[v] = fan_of(topology, static_cast<VertexId>(v)); });
    Fans fans;
    fans.offsets.reserve(count + 1);
    fans.offsets.push_back(0);
    fans.irregular.assign(count, 0);
    for (std::size_t v = 0; v < count; ++v) {
        if (all[v].empty()) {
            fans.irregular[v] = 1;
            fans.any_irregular = true;
            all[v].push_back(static_cast<std::uint32_t>(v));
        }
        fans.members.insert(fans.members.end(), all[v].begin(), all[v].end());
        fans.offsets.push_back(static_cast<std::uint32_t>(fans.members.size()));
    }
    return fans;
}

namespace any_cpu {

namespace {

ALWAYS_INLINE Pack root(const Pack& v) {
    const __m128d low = _mm_sqrt_pd(__m128d{v[0], v[1]}), high = _mm_sqrt_pd(__m128d{v[2], v[3]});
    return Pack{low[0], low[1], high[0], high[1]};
}

ALWAYS_INLINE bool any(const Mask& m) {
    return (m[0] | m[1] | m[2] | m[3]) != 0;
}

#include "quality/ring_kernels.inc"
}  // namespace

}  // namespace any_cpu

#pragma GCC push_options
#pragma GCC target("avx2")

namespace avx2 {

namespace {

ALWAYS_INLINE Pack root(const Pack& v) {
    return _mm256_sqrt_pd(v);
}

ALWAYS_INLINE bool any(const Mask& m) {
    return _mm256_movemask_pd(reinterpret_cast<const __m256d&>(m)) != 0;
}

#include "quality/ring_kernels.inc"
}  // namespace

}  // namespace avx2

#pragma GCC pop_options

namespace {

bool wide() {
    static const bool has = __builtin_cpu_supports("avx2") != 0;
    return has;
}

}  // namespace

void find_ring_distances(const Fans& fans, const RingQuery& query, const RingAnswer& answer) {
    const bool planes = answer.planes != nullptr;
    if (wide())
        planes ? avx2::ring_distances<true>(fans, query, answer)
               : avx2::ring_distances<false>(fans, query, answer);
    else
        planes ? any_cpu::ring_distances<true>(fans, query, answer)
               : any_cpu::ring_distances<false>(fans, query, answer);
}

CurvatureSums curvature_sums(const Fans& fans, const PackRow* positions,
                             const std::uint32_t* vertices, std::size_t count,
                             const double* interior, const PackRow& origin) {
    return wide() ? avx2::sum_curvatures(fans, positions, vertices, count, interior, origin)
                  : any_cpu::sum_curvatures(fans, positions, vertices, count, interior, origin);
}

}  // namespace vesselbench::detail
