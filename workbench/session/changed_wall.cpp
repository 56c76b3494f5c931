#include "workbench/session/changed_wall.h"

#include <algorithm>
#include <array>
#include <unordered_set>
#include <utility>

#include "geometry/kernel/content_key.h"
#include "geometry/kernel/surface_distance.h"

namespace vesselbench {

namespace {

struct KeyHash {
    std::size_t operator()(const ContentKey& key) const { return key.low; }
};

using Keys = std::unordered_set<ContentKey, KeyHash>;

/// Of the corners' places, whichever comes first.
ContentKey key_of(const Positions& points, const Triangle& t) {
    const auto before = [&](VertexId a, VertexId b) {
        const Vec3 &p = points[a], &q = points[b];
        return std::lexicographical_compare(p.begin(), p.end(), q.begin(), q.end());
    };
    const auto first = static_cast<std::size_t>(std::ranges::min_element(t, before) - t.begin());
    std::array<double, 9> places{};
    for (std::size_t k = 0; k < 3; ++k)
        for (Eigen::Index axis = 0; axis < 3; ++axis)
            places[3 * k + static_cast<std::size_t>(axis)] =
                points[t[(first + k) % 3]][axis] + 0.0;  // -0.0 is the same place as 0.0
    return content_key(std::span<const double>(places));
}

std::vector<std::uint8_t> outside_flags(const Surface& surface, std::span<const ChangeZone> zones) {
    std::vector<std::uint8_t> outside;
    outside.reserve(surface.vertex_count());
    for (const Vec3& p : surface.points()) outside.push_back(is_outside(p, zones) ? 1 : 0);
    return outside;
}

bool all_outside(const Triangle& t, const std::vector<std::uint8_t>& outside) {
    return outside[t[0]] + outside[t[1]] + outside[t[2]] == 3;
}

/// Of the triangles with all corners outside, in any order.
ContentKey sum_outside(const Surface& surface, const std::vector<std::uint8_t>& outside) {
    ContentKey sum;
    for (const Triangle& t : surface.triangles()) {
        if (!all_outside(t, outside)) continue;
        const ContentKey key = key_of(surface.points(), t);
        sum.high += key.high;
        sum.low += key.low;
    }
    return sum;
}

/// Slow, and asked only if there is a difference.
std::optional<Vec3> first_missing(const Surface& surface, const std::vector<std::uint8_t>& outside,
                                  const Surface& other,
                                  const std::vector<std::uint8_t>& other_outside) {
    Keys known;
    for (const Triangle& t : other.triangles())
        if (all_outside(t, other_outside)) known.insert(key_of(other.points(), t));
    for (const Triangle& t : surface.triangles())
        if (all_outside(t, outside) && !known.contains(key_of(surface.points(), t)))
            return surface.points()[t[0]];
    return std::nullopt;
}

std::optional<Vec3> moved_outside(const Positions& before, const Positions& after,
                                  std::span<const ChangeZone> zones) {
    for (std::size_t v = 0; v < before.size(); ++v)
        if (before[v] != after[v] && is_outside(before[v], zones)) return before[v];
    return std::nullopt;
}

bool has_corner_in(const Surface& surface, const Triangle& t,
                   const std::optional<std::vector<ChangeZone>>& zones) {
    return !zones || std::ranges::any_of(
                         t, [&](VertexId v) { return !is_outside(surface.points()[v], *zones); });
}

/// Middles of the triangles that the other surface lacks [mm].
Positions middles_missing_in(const Surface& other, const Surface& surface) {
    const std::vector<std::uint8_t> missing = triangles_missing_in(other, surface, std::nullopt);
    Positions middles;
    for (TriangleId t = 0; t < missing.size(); ++t) {
        if (!missing[t]) continue;
        const auto& [a, b, c] = surface.triangles()[t];
        middles.emplace_back((surface.points()[a] + surface.points()[b] + surface.points()[c]) /
                             3.0);
    }
    return middles;
}

}  // namespace

bool same_triangles(const Surface& a, const Surface& b) {
    return a.topology == b.topology || (a.vertex_count() == b.vertex_count() &&
                                        std::ranges::equal(a.triangles(), b.triangles()));
}

bool is_outside(const Vec3& place, std::span<const ChangeZone> zones) {
    return std::ranges::none_of(zones, [&](const ChangeZone& zone) {
        return (place - zone.centre).squaredNorm() <= zone.radius * zone.radius;
    });
}

std::optional<Vec3> change_outside(const Surface& before, const Surface& after,
                                   std::span<const ChangeZone> zones) {
    if (same_triangles(before, after)) return moved_outside(before.points(), after.points(), zones);
    const auto was = outside_flags(before, zones), is = outside_flags(after, zones);
    if (sum_outside(before, was) == sum_outside(after, is)) return std::nullopt;
    const auto lost = first_missing(before, was, after, is);
    return lost ? lost : first_missing(after, is, before, was);
}

std::vector<std::uint8_t> triangles_missing_in(
    const Surface& other, const Surface& surface,
    const std::optional<std::vector<ChangeZone>>& zones) {
    std::vector<std::uint8_t> missing(surface.triangle_count(), 0);
    if (same_triangles(other, surface)) {
        for (TriangleId t = 0; t < missing.size(); ++t)
            for (const VertexId v : surface.triangles()[t])
                if (surface.points()[v] != other.points()[v]) missing[t] = 1;
        return missing;
    }
    Keys known;
    for (const Triangle& t : other.triangles())
        if (has_corner_in(other, t, zones)) known.insert(key_of(other.points(), t));
    for (TriangleId t = 0; t < missing.size(); ++t) {
        const Triangle& corners = surface.triangles()[t];
        if (has_corner_in(surface, corners, zones) &&
            !known.contains(key_of(surface.points(), corners)))
            missing[t] = 1;
    }
    return missing;
}

std::optional<Vec3> farthest_change(const Surface& before, const Surface& after) {
    std::optional<Vec3> place;
    if (before.empty() || after.empty()) return place;
    double farthest = -1.0;
    for (const auto& [surface, other] : {std::pair(&before, &after), std::pair(&after, &before)}) {
        const Positions middles = middles_missing_in(*other, *surface);
        if (middles.empty()) continue;
        const std::vector<SurfacePoint> nearest = distance_to(*other).closest_points(middles);
        const auto most = std::ranges::max_element(nearest, {}, &SurfacePoint::distance);
        if (most->distance <= farthest) continue;
        farthest = most->distance;
        place = middles[static_cast<std::size_t>(most - nearest.begin())];
    }
    return place;
}

std::vector<VertexId> corners_of(const Surface& surface, const std::vector<std::uint8_t>& flagged) {
    std::vector<std::uint8_t> seen(surface.vertex_count(), 0);
    std::vector<VertexId> corners;
    for (TriangleId t = 0; t < flagged.size(); ++t)
        if (flagged[t])
            for (const VertexId v : surface.triangles()[t])
                if (!std::exchange(seen[v], 1)) corners.push_back(v);
    return corners;
}

bool meets(const Surface& surface, TriangleId t, const Bounds& box) {
    const auto& [a, b, c] = surface.triangles()[t];
    const Vec3 &p = surface.points()[a], &q = surface.points()[b], &r = surface.points()[c];
    return (p.cwiseMin(q).cwiseMin(r).array() <= box.max.array()).all() &&
           (p.cwiseMax(q).cwiseMax(r).array() >= box.min.array()).all();
}

}  // namespace vesselbench
