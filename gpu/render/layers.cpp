#include "gpu/render/layers.h"

#include <algorithm>

namespace vesselbench {

namespace {

/// The smallest sphere around two.
Sphere joined(const Sphere& a, const Sphere& b) {
    const double apart = (b.centre - a.centre).norm();
    if (apart + b.radius <= a.radius) return a;
    if (apart + a.radius <= b.radius) return b;
    const double radius = 0.5 * (apart + a.radius + b.radius);
    return {a.centre + (b.centre - a.centre) * ((radius - a.radius) / apart), radius};
}

}  // namespace

Sphere bounds_of(const Layers& layers) {
    std::optional<Sphere> all;
    const auto add = [&](const Sphere& sphere) { all = all ? joined(*all, sphere) : sphere; };
    for (const SurfaceLayer& layer : layers.surfaces) add(layer.source->bounds());
    for (const SliceLayer& layer : layers.slices) add(layer.slice->bounds());
    for (const LinesLayer& layer : layers.lines)
        if (layer.lines->segment_count() > 0) add(layer.lines->bounds());
    for (const PointsLayer& layer : layers.points)
        if (layer.points->count() > 0) add(layer.points->bounds());
    return all.value_or(Sphere{});
}

}  // namespace vesselbench
