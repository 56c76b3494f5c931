#include "workbench/review/page_wall.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "geometry/kernel/measure.h"
#include "geometry/kernel/parallel.h"

namespace vesselbench {

namespace {

/// Rays that measure a vessel start so far below its wall [mm].
constexpr double kBelowWall = 1e-4;
/// A radius is measured on the triangles that are so near, by the longest edge of the nearest one.
constexpr double kReach = 2.0;

/// Half the way from a triangle's middle to the opposite wall.
std::optional<double> radius_below(const Surface& surface, const SurfaceDistance& distance,
                                   TriangleId t) {
    const Triangle& triangle = surface.triangles()[t];
    const Vec3 area = area_normal(surface.points(), triangle);
    if (area.isZero() || surface.patch_of(t).kind != PatchKind::Wall) return std::nullopt;
    Vec3 middle = Vec3::Zero();
    for (const VertexId v : triangle) middle += surface.points()[v] / 3.0;
    const Vec3 inward = -area.normalized();
    const auto hit = distance.first_hit(middle + kBelowWall * inward, inward);
    if (!hit || hit->distance <= 0.0) return std::nullopt;
    return hit->distance / 2;
}

double magnitude(double value) {
    return std::abs(value);
}

/// \return true if it was taken
bool take_largest(const Surface& surface, std::span<const double> values, WallChange& change) {
    const auto largest = std::ranges::max_element(values, {}, magnitude);
    if (largest == values.end() || magnitude(*largest) <= change.largest) return false;
    change.largest = magnitude(*largest);
    change.inward = *largest < 0.0;
    change.place = surface.points()[static_cast<std::size_t>(largest - values.begin())];
    return true;
}

double mean_square(std::span<const double> values) {
    if (values.empty()) return 0.0;
    return std::inner_product(values.begin(), values.end(), values.begin(), 0.0) /
           static_cast<double>(values.size());
}

}  // namespace

std::optional<double> radius_near(const Surface& surface, const SurfaceDistance& distance,
                                  const Vec3& place) {
    const SurfacePoint wall = distance.closest_point(place);
    const double edge = longest_edge(surface.points(), surface.triangles()[wall.triangle]);
    std::vector<double> radii;
    for (const TriangleId t : distance.triangles_within(wall.point, kReach * edge))
        if (const auto radius = radius_below(surface, distance, t)) radii.push_back(*radius);
    if (radii.empty()) return std::nullopt;
    const auto middle = radii.begin() + static_cast<std::ptrdiff_t>(radii.size() / 2);
    std::ranges::nth_element(radii, middle);
    return *middle;
}

std::vector<bool> vertices_at_ends(const Surface& surface) {
    const std::vector<std::uint8_t>& border = surface.topology->boundary_vertices();
    std::vector<bool> ends(border.begin(), border.end());
    const auto triangles = surface.triangles();
    for (TriangleId t = 0; t < triangles.size(); ++t)
        if (surface.patch_of(t).kind != PatchKind::Wall)
            for (const VertexId v : triangles[t]) ends[v] = true;
    std::vector<bool> wider = ends;
    for (const Triangle& triangle : triangles)
        if (std::ranges::any_of(triangle, [&](VertexId v) { return ends[v]; }))
            for (const VertexId v : triangle) wider[v] = true;
    return wider;
}

std::vector<double> signed_distances(const Surface& of, const SurfaceDistance& other,
                                     std::span<const SurfacePoint> closest) {
    std::vector<double> values(of.vertex_count());
    for_each_vertex(values.size(), [&](std::size_t v) {
        const double distance = closest[v].distance;
        values[v] = distance > 0.0 && other.inside(of.points()[v]) ? -distance : distance;
    });
    return values;
}

std::vector<double> wall_deviations(const Surface& of, const Surface& to,
                                    std::span<const SurfacePoint> closest,
                                    std::span<const double> distances) {
    const std::vector<bool> own = vertices_at_ends(of), other = vertices_at_ends(to);
    std::vector<double> values(of.vertex_count(), 0.0);
    for (std::size_t v = 0; v < values.size(); ++v) {
        if (own[v] || distances[v] == 0.0) continue;
        const Triangle& triangle = to.triangles()[closest[v].triangle];
        if (std::ranges::none_of(triangle, [&](VertexId corner) { return other[corner]; }))
            values[v] = distances[v];
    }
    return values;
}

std::optional<WallChange> wall_change(const Surface& before, std::span<const double> lost,
                                      const Surface& after, std::span<const double> gained,
                                      double least) {
    WallChange change{.largest = least};
    take_largest(after, gained, change);
    // where the surface before is outside of the one after, the wall moved inwards
    if (take_largest(before, lost, change)) change.inward = !change.inward;
    if (change.largest <= least) return std::nullopt;
    change.usual = std::sqrt(std::max(mean_square(lost), mean_square(gained)));
    change.radius = radius_near(before, distance_to(before), change.place);
    return change;
}

}  // namespace vesselbench
