#include "smoothing/filters/new_crossings.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "geometry/kernel/self_intersections.h"

namespace vesselbench {

namespace {

constexpr int kAttempts = 8;
constexpr int kFade = 3;  // rings from no displacement to the full one

/// Rings around the triangles of the pairs: 0 at their corners; `most` + 1 farther away.
std::vector<int> rings_around(const Surface& surface, const std::vector<TrianglePair>& pairs,
                              int most) {
    std::vector<int> ring(surface.vertex_count(), most + 1);
    std::vector<VertexId> front;
    const auto reach = [&](VertexId v, int distance) {
        if (ring[v] <= distance) return;
        ring[v] = distance;
        front.push_back(v);
    };
    for (const auto& [s, t] : pairs)
        for (const TriangleId triangle : {s, t})
            for (const VertexId v : surface.triangles()[triangle]) reach(v, 0);
    for (int distance = 1; distance <= most; ++distance) {
        const std::vector<VertexId> last = std::exchange(front, {});
        for (const VertexId v : last)
            for (const VertexId u : surface.topology->rings().row(v)) reach(u, distance);
    }
    return ring;
}

/// 1 at triangles with a moved vertex.
std::vector<std::uint8_t> moved_triangles(const Surface& surface, const Positions& moved) {
    std::vector<std::uint8_t> flags(surface.triangle_count(), 0);
    for (TriangleId t = 0; t < flags.size(); ++t)
        for (const VertexId v : surface.triangles()[t])
            if (moved[v] != surface.points()[v]) flags[t] = 1;
    return flags;
}

}  // namespace

TakenBack take_back_crossings(const Surface& surface, Positions& moved, const Progress& progress) {
    TakenBack taken;
    // Two triangles that stayed cannot have started to cross.
    const std::vector<std::uint8_t> suspects = moved_triangles(surface, moved);
    const auto crossings = [&] {
        return self_intersections_with(moved, surface.triangles(), suspects, progress);
    };
    auto pairs = crossings();
    if (pairs.empty() && std::ranges::count(suspects, 0) == 0)
        remember_no_self_intersections(*surface.topology, moved);
    if (pairs.empty() || !self_intersections(surface, progress).empty()) return taken;
    taken.place = moved[surface.triangles()[pairs.front().first][0]];
    const Positions wanted = moved;
    std::vector<double> share(moved.size(), 1.0);
    for (int attempt = 0; attempt < kAttempts && !pairs.empty(); ++attempt) {
        const std::vector<int> ring = rings_around(surface, pairs, attempt + kFade);
        for (VertexId v = 0; v < moved.size(); ++v) {
            const double fade = std::clamp((ring[v] - attempt) / (kFade + 1.0), 0.0, 1.0);
            share[v] = std::min(share[v], fade);
            if (share[v] < 1.0)
                moved[v] = surface.points()[v] + share[v] * (wanted[v] - surface.points()[v]);
        }
        pairs = crossings();
    }
    taken.crossings_left = pairs.size();
    taken.vertices = static_cast<std::size_t>(
        std::count_if(share.begin(), share.end(), [](double s) { return s < 1.0; }));
    return taken;
}

}  // namespace vesselbench
