#include "geometry/kernel/surface_samples.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "geometry/kernel/measure.h"

namespace vesselbench {

namespace {

constexpr int kMostSamples = 24;         // per edge of a triangle
constexpr std::size_t kBlock = 1 << 14;  // searches between two looks for a cancel

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

void for_each_closest(const SurfaceSamples& samples, const SurfaceDistance& to,
                      const std::function<void(std::size_t, const SurfacePoint&)>& visit,
                      const Progress& progress) {
    const std::span<const Vec3> points = samples.points;
    for (std::size_t first = 0; first < points.size(); first += kBlock) {
        progress.check_cancelled();
        const auto found =
            to.closest_points(points.subspan(first, std::min(kBlock, points.size() - first)));
        for (std::size_t i = 0; i < found.size(); ++i) visit(first + i, found[i]);
    }
}

SampledDistance sampled_distance(const SurfaceSamples& samples, const SurfaceDistance& to,
                                 const Progress& progress) {
    SampledDistance result;
    const auto add = [&](std::size_t i, const SurfacePoint& closest) {
        result.add(closest.distance, samples.areas[i]);
    };
    for_each_closest(samples, to, add, progress);
    return result;
}

}  // namespace vesselbench
