#include "geometry/kernel/triangle_shape.h"

namespace vesselbench {

namespace {

template <class Wanted>
TriangleShape shape_where(const Surface& surface, const Wanted& wanted) {
    SpreadBuilder skewness, ratio;
    for (TriangleId t = 0; t < surface.triangle_count(); ++t) {
        if (!wanted(t)) continue;
        const auto& [a, b, c] = surface.triangles()[t];
        const Positions& points = surface.points();
        skewness.add(equiangle_skewness(points[a], points[b], points[c]));
        ratio.add(std::min(1.0, radius_ratio(points[a], points[b], points[c])));  // rounding
    }
    return {skewness.result(), ratio.result()};
}

}  // namespace

TriangleShape triangle_shape(const Surface& surface) {
    return shape_where(surface, [](TriangleId) { return true; });
}

TriangleShape wall_shape(const Surface& surface) {
    return shape_where(surface,
                       [&](TriangleId t) { return surface.patch_of(t).kind == PatchKind::Wall; });
}

TriangleShape openings_shape(const Surface& surface) {
    return shape_where(surface,
                       [&](TriangleId t) { return surface.patch_of(t).kind != PatchKind::Wall; });
}

}  // namespace vesselbench
