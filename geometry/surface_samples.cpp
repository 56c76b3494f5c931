#include "geometry/surface_samples.h"

#include <algorithm>
#include <cmath>

#include "geometry/measure.h"

namespace vesselbench {

namespace {

/// Samples per triangle edge are limited: a giant triangle must not cost minutes.
constexpr int kMostSamples = 24;

double longest_edge(const Positions& points, const Triangle& t) {
    return std::max({(points[t[0]] - points[t[1]]).norm(), (points[t[1]] - points[t[2]]).norm(),
                     (points[t[2]] - points[t[0]]).norm()});
}

}  // namespace

SurfaceSamples surface_samples(const Surface& surface, double spacing) {
    SurfaceSamples samples;
    samples.points = surface.points();
    samples.areas.assign(samples.points.size(), 0.0);
    samples.triangles.assign(samples.points.size(), 0);
    const auto& points = surface.points();
    for (TriangleId id = 0; id < surface.triangle_count(); ++id) {
        const Triangle& t = surface.triangles()[id];
        for (const VertexId corner : t) samples.triangles[corner] = id;
        const double parts = std::ceil(longest_edge(points, t) / spacing);
        const int n = static_cast<int>(std::clamp(parts, 1.0, double{kMostSamples}));
        const Vec3 u = (points[t[1]] - points[t[0]]) / n, v = (points[t[2]] - points[t[0]]) / n;
        const double part = triangle_area(points, t) / (n * n);
        const auto add = [&](double i, double j) {
            samples.points.push_back(points[t[0]] + i * u + j * v);
            samples.areas.push_back(part);
            samples.triangles.push_back(id);
        };
        for (int i = 0; i < n; ++i)
            for (int j = 0; i + j < n; ++j) {
                add(i + 1.0 / 3, j + 1.0 / 3);
                if (i + j + 1 < n) add(i + 2.0 / 3, j + 2.0 / 3);
            }
    }
    return samples;
}

void SampledDistance::add(double distance, double sample_area) {
    largest = std::max(largest, distance);
    sum += distance * sample_area;
    area += sample_area;
}

SampledDistance sampled_distance(const SurfaceSamples& samples, const SurfaceDistance& to) {
    const auto found = to.closest_points(samples.points);
    SampledDistance result;
    for (std::size_t i = 0; i < found.size(); ++i) result.add(found[i].distance, samples.areas[i]);
    return result;
}

}  // namespace vesselbench
