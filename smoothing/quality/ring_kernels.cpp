#include "smoothing/quality/ring_kernels.h"

#include <algorithm>

#include <immintrin.h>
#include <tbb/parallel_for.h>

#include "geometry/kernel/edges.h"

// Functions that return wide vectors are always inlined, so their calling convention is irrelevant.
#pragma GCC diagnostic ignored "-Wpsabi"

#define ALWAYS_INLINED __attribute__((always_inline))
#define ALWAYS_INLINE inline ALWAYS_INLINED

namespace vesselbench {

namespace {

using Mask = long long __attribute__((vector_size(32)));

/// A neighbour and the next one around a vertex.
using Side = std::pair<VertexId, VertexId>;

/// Appends the neighbours around a vertex in order. \return false, appending nothing, unless its
/// triangles form a single fan
bool append_fan(const Topology& topology, VertexId v, std::vector<Side>& sides,
                std::vector<std::uint32_t>& members) {
    sides.clear();
    for (const TriangleId t : topology.triangles_at().row(v)) {
        const Triangle& c = topology.triangles()[t];
        const std::uint32_t k = corner_of(c, v);
        const VertexId from = c[(k + 1) % 3], to = c[(k + 2) % 3];
        if (from == to || from == v || to == v) return false;
        sides.emplace_back(from, to);
    }
    if (sides.empty()) return false;
    auto side = std::ranges::find_if(sides, [&](const Side& s) {  // the one no other leads to
        return std::ranges::find(sides, s.first, &Side::second) == sides.end();
    });
    if (side == sides.end()) side = sides.begin();
    const std::size_t start = members.size();
    members.push_back(side->first);
    while (side != sides.end()) {
        members.push_back(side->second);
        *side = sides.back();
        sides.pop_back();
        side = std::ranges::find(sides, members.back(), &Side::first);
    }
    if (!sides.empty()) members.resize(start);
    return sides.empty();
}

/// The fans of some vertices, one after the other.
struct FanPart {
    std::vector<std::uint32_t> sizes, members;
    std::vector<VertexId> irregular;
};

FanPart fans_of(const Topology& topology, std::size_t first, std::size_t last) {
    FanPart part;
    part.members.reserve(8 * (last - first));
    std::vector<Side> sides;
    for (std::size_t v = first; v < last; ++v) {
        const std::size_t before = part.members.size();
        if (!append_fan(topology, static_cast<VertexId>(v), sides, part.members)) {
            part.irregular.push_back(static_cast<VertexId>(v));
            part.members.push_back(static_cast<std::uint32_t>(v));
        }
        part.sizes.push_back(static_cast<std::uint32_t>(part.members.size() - before));
    }
    return part;
}

}  // namespace

Fans make_fans(const Topology& topology) {
    constexpr std::size_t kPart = 4096;
    const std::size_t count = topology.vertex_count();
    std::vector<FanPart> parts((count + kPart - 1) / kPart);
    tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t i) {
        parts[i] = fans_of(topology, i * kPart, std::min(count, (i + 1) * kPart));
    });
    Fans fans;
    fans.offsets.reserve(count + 1);
    fans.offsets.push_back(0);
    fans.irregular.assign(count, 0);
    for (const FanPart& part : parts) {
        for (const std::uint32_t size : part.sizes)
            fans.offsets.push_back(fans.offsets.back() + size);
        fans.members.insert(fans.members.end(), part.members.begin(), part.members.end());
        for (const VertexId v : part.irregular) fans.irregular[v] = 1;
        fans.any_irregular = fans.any_irregular || !part.irregular.empty();
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

#include "smoothing/quality/ring_kernels.inc"
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

#include "smoothing/quality/ring_kernels.inc"
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

void find_normal_angles(const Fans& fans, const PackRow* positions, const std::uint32_t* vertices,
                        std::size_t count, double* angles) {
    if (wide())
        avx2::normal_angles(fans, positions, vertices, count, angles);
    else
        any_cpu::normal_angles(fans, positions, vertices, count, angles);
}

double six_volumes(const PackRow* positions, std::span<const Triangle> triangles,
                   const PackRow& origin) {
    return wide() ? avx2::sum_six_volumes(positions, triangles, origin)
                  : any_cpu::sum_six_volumes(positions, triangles, origin);
}

}  // namespace vesselbench
