#include "geometry/kernel/surface_samples.h"

#include <algorithm>
#include <cmath>

#include "geometry/kernel/measure.h"

namespace vesselbench {

namespace {

constexpr int kMostSamples = 24;  // per edge of a triangle

}  // namespace

int sample_parts(double longest, double spacing) {
    const double parts = std::ceil(longest / spacing);  // NaN if both are 0
    return parts > 1.0 ? static_cast<int>(std::min(parts, double{kMostSamples})) : 1;
}

SurfaceSamples surface_samples(const Surface& surface, double spacing) {
    SurfaceSamples samples;
    samples.points = surface.points();
    samples.areas.assign(samples.points.size(), 0.0);
    samples.triangles.assign(samples.points.size(), 0);
    const auto& points = surface.points();
    for (TriangleId id = 0; id < surface.triangle_count(); ++id) {
        const Triangle& t = surface.triangles()[id];
        for (const VertexId corner : t) samples.triangles[corner] = id;
        const int n = sample_parts(longest_edge(points, t), spacing);
        const Vec3 ab = points[t[1]] - points[t[0]], ac = points[t[2]] - points[t[0]];
        const double part = triangle_area(points, t) / (n * n);
        for_each_part(n, [&](double u, double v) {
            samples.points.push_back(points[t[0]] + u * ab + v * ac);
            samples.areas.push_back(part);
            samples.triangles.push_back(id);
        });
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
