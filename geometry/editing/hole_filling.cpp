#include "geometry/editing/hole_filling.h"

#include <algorithm>

#include "geometry/editing/hole_patch.h"
#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/errors.h"

namespace vesselbench {

namespace {

/// Fairing uses two rings around the hole; the others are for safety.
constexpr int kRings = 5;

Hole hole_in(const EditableSurface& surface, std::span<const VertexId> loop,
             const HoleChart* chart) {
    Hole hole{.loop = {loop.begin(), loop.end()},
              .around = {},
              .point =
                  [&surface, chart](VertexId v) {
                      const Vec3 x = surface.point(v);
                      return chart != nullptr ? chart->to_chart(x) : x;
                  },
              .first_new = static_cast<VertexId>(surface.vertex_count()),
              .fills_touching_rims = true};
    const auto at = [&](VertexId v) { return surface.triangles_at(v); };
    const auto corners = [&](TriangleId t) { return surface.triangle(t); };
    for (const TriangleId t : triangles_around(loop, kRings, at, corners))
        hole.around.push_back(surface.triangle(t));
    return hole;
}

VertexId nearest(const EditableSurface& surface, std::span<const VertexId> loop, const Vec3& x) {
    return *std::min_element(loop.begin(), loop.end(), [&](VertexId a, VertexId b) {
        return (surface.point(a) - x).squaredNorm() < (surface.point(b) - x).squaredNorm();
    });
}

}  // namespace

std::size_t fill_rim(EditableSurface& surface, std::span<const VertexId> loop, int continuity,
                     const HoleChart* chart) {
    if (loop.size() < 3) throw InvalidInput("a border loop has at least 3 vertices");
    const Hole hole = hole_in(surface, loop, chart);
    const HolePatch patch = chart != nullptr ? fill_seen_along_x(hole, continuity)
                                             : fill_smoothly(hole, continuity, PatchOrder::AsMade);
    if (patch.result == HolePatch::Result::NotManifold)
        throw DiagnosedFailure({.code = "hole-not-manifold",
                                .place = loop_centre(surface.points_of(loop)),
                                .remedies = {{.operation = "repair"}}});
    if (patch.result == HolePatch::Result::NotTriangulated)
        throw DiagnosedFailure(
            {.code = "hole-cap-crosses", .place = loop_centre(surface.points_of(loop))});
    const auto beside = surface.triangles_on(loop[0], loop[1]);
    const std::uint16_t label = beside.empty() ? std::uint16_t{0} : surface.label(beside.front());
    for (const Vec3& p : patch.points) {
        const Vec3 x = chart != nullptr ? chart->from_chart(p) : p;
        const VertexId source[] = {nearest(surface, loop, x)};
        const double weight[] = {1.0};
        surface.add_vertex(x, source, weight);
    }
    for (const Triangle& t : patch.triangles) surface.add_triangle(t, label);
    return patch.triangles.size();
}

FilledHole fill_hole(const Surface& surface, std::span<const VertexId> loop, int continuity) {
    EditableSurface edited(surface);
    const std::size_t before = edited.vertex_count();
    fill_rim(edited, loop, continuity);
    FilledHole filled{.surface = edited.to_surface(),
                      .first_new_triangle = surface.triangle_count()};
    filled.first_new_vertex = filled.surface.vertex_count() - (edited.vertex_count() - before);
    return filled;
}

Vec3 loop_centre(const Positions& corners) {
    Vec3 sum = Vec3::Zero();
    double length = 0.0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Vec3& p = corners[i];
        const Vec3& q = corners[(i + 1) % corners.size()];
        sum += 0.5 * (p + q) * (q - p).norm();
        length += (q - p).norm();
    }
    return length > 0.0 ? Vec3(sum / length) : corners[0];
}

Vec3 loop_centre(const Surface& surface, std::span<const VertexId> loop) {
    Positions corners;
    for (const VertexId v : loop) corners.push_back(surface.points()[v]);
    return loop_centre(corners);
}

}  // namespace vesselbench
