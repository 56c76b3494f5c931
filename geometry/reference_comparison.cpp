#include "geometry/reference_comparison.h"

#include <algorithm>
#include <cmath>

#include "geometry/errors.h"
#include "geometry/local_error.h"
#include "geometry/measure.h"
#include "geometry/surface_distance.h"

namespace vesselbench {

namespace {

/// Samples per triangle edge are limited: a giant triangle must not cost minutes.
constexpr int kMostSamples = 24;

struct OneWay {
    double largest = 0.0;  ///< [mm]
    double sum = 0.0;      ///< of distance x area [mm^3]
    double area = 0.0;     ///< [mm^2]
};

struct Samples {
    Positions points;
    std::vector<double> areas;  ///< each point stands for [mm^2]
};

double longest_edge(const Positions& points, const Triangle& t) {
    return std::max({(points[t[0]] - points[t[1]]).norm(), (points[t[1]] - points[t[2]]).norm(),
                     (points[t[2]] - points[t[0]]).norm()});
}

/// Centres of the n^2 equal parts of every triangle, n from its longest edge; and all vertices,
/// which stand for no area.
Samples samples_of(const Surface& surface, double spacing) {
    Samples samples;
    samples.points = surface.points();
    samples.areas.assign(samples.points.size(), 0.0);
    for (const Triangle& t : surface.triangles()) {
        const auto& points = surface.points();
        const int n = std::clamp(static_cast<int>(std::ceil(longest_edge(points, t) / spacing)), 1,
                                 kMostSamples);
        const Vec3 u = (points[t[1]] - points[t[0]]) / n, v = (points[t[2]] - points[t[0]]) / n;
        const double part = triangle_area(points, t) / (n * n);
        for (int i = 0; i < n; ++i)
            for (int j = 0; i + j < n; ++j) {
                samples.points.push_back(points[t[0]] + (i + 1.0 / 3) * u + (j + 1.0 / 3) * v);
                samples.areas.push_back(part);
                if (i + j + 1 == n) continue;
                samples.points.push_back(points[t[0]] + (i + 2.0 / 3) * u + (j + 2.0 / 3) * v);
                samples.areas.push_back(part);
            }
    }
    return samples;
}

OneWay one_way(const Surface& from, const Surface& to, double spacing) {
    const Samples samples = samples_of(from, spacing);
    const auto found = SurfaceDistance(to).closest_points(samples.points);
    OneWay result;
    for (std::size_t i = 0; i < found.size(); ++i) {
        result.largest = std::max(result.largest, found[i].distance);
        result.sum += found[i].distance * samples.areas[i];
        result.area += samples.areas[i];
    }
    return result;
}

bool same_triangles(const Surface& a, const Surface& b) {
    return a.vertex_count() == b.vertex_count() && std::ranges::equal(a.triangles(), b.triangles());
}

}  // namespace

ReferenceComparison compare_with_reference(const Surface& surface, const Surface& reference) {
    if (surface.empty() || reference.empty())
        throw InvalidInput("a comparison needs two surfaces with at least one triangle each");
    if (!(area(surface) > 0.0) || !(area(reference) > 0.0))
        throw InvalidInput(
            "a comparison needs two surfaces with an area: all triangles of one have none");
    const double spacing = 0.5 * std::min(mean_edge_length(surface), mean_edge_length(reference));
    const OneWay there = one_way(surface, reference, spacing);
    const OneWay back = one_way(reference, surface, spacing);
    ReferenceComparison result;
    result.hausdorff = std::max(there.largest, back.largest);
    result.hausdorff_to_reference = there.largest;
    result.mean_to_reference = there.sum / there.area;
    result.mean_distance = (there.sum + back.sum) / (there.area + back.area);
    if (same_triangles(surface, reference)) {
        const LocalError error =
            local_error(*reference.topology, reference.points(), surface.points());
        result.local_error = {error.mean, error.largest};
    }
    const double before = std::abs(volume(reference));
    if (before > 0.0)
        result.volume_change_percent = 100.0 * (std::abs(volume(surface)) - before) / before;
    return result;
}

}  // namespace vesselbench
