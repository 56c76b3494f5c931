#include "workbench/surface_change.h"

#include <algorithm>

namespace vesselbench {

namespace {

std::optional<double> volume_of(const std::optional<Surface>& surface) {
    if (!surface || surface->empty()) return std::nullopt;
    const auto& boundary = surface->topology->boundary_vertices();
    if (std::any_of(boundary.begin(), boundary.end(), [](auto flag) { return flag != 0; }))
        return std::nullopt;
    const Positions& points = surface->points();
    const Vec3& origin = points.front();
    double six_fold = 0.0;
    for (const auto& [a, b, c] : surface->triangles())
        six_fold += (points[a] - origin).cross(points[b] - origin).dot(points[c] - origin);
    return six_fold / 6.0;
}

void add_vertex_deviations(const Positions& before, const Positions& after, SurfaceChange& change) {
    double sum = 0.0, largest = 0.0;
    for (std::size_t v = 0; v < after.size(); ++v) {
        if (before[v] == after[v]) continue;
        const double deviation = (after[v] - before[v]).norm();
        sum += deviation;
        largest = std::max(largest, deviation);
        ++change.moved_vertices;
    }
    change.largest_deviation = largest;
    change.mean_deviation =
        change.moved_vertices > 0 ? sum / static_cast<double>(change.moved_vertices) : 0.0;
}

}  // namespace

SurfaceChange surface_change(const Scene& before, const Scene& after) {
    SurfaceChange change;
    const bool old_surface = before.surface && !before.surface->empty();
    const bool new_surface = after.surface && !after.surface->empty();
    if (old_surface) change.triangles_before = before.surface->triangle_count();
    if (new_surface) change.triangles_after = after.surface->triangle_count();
    change.volume_before = volume_of(before.surface);
    const bool same_shape = old_surface && new_surface &&
                            before.surface->positions == after.surface->positions &&
                            before.surface->topology == after.surface->topology;
    change.volume_after = same_shape ? change.volume_before : volume_of(after.surface);
    if (old_surface && new_surface && before.surface->topology == after.surface->topology)
        add_vertex_deviations(before.surface->points(), after.surface->points(), change);
    return change;
}

}  // namespace vesselbench
