#include "geometry/reference_comparison.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "geometry/errors.h"
#include "geometry/local_error.h"
#include "geometry/measure.h"
#include "geometry/surface_distance.h"

namespace vesselbench {

namespace {

/// Samples per triangle edge are limited: a giant triangle must not cost minutes.
constexpr int kMostSamples = 24;

/// Gathers distances of samples.
struct Distances {
    double largest = 0.0;  ///< [mm]
    double sum = 0.0;      ///< of distance x area [mm^3]
    double area = 0.0;     ///< [mm^2]

    void add(double distance, double sample_area) {
        largest = std::max(largest, distance);
        sum += distance * sample_area;
        area += sample_area;
    }

    [[nodiscard]] PartDistance mean() const { return {area > 0.0 ? sum / area : 0.0, largest}; }
};

struct Samples {
    Positions points;
    std::vector<double> areas;          ///< each point stands for [mm^2]
    std::vector<TriangleId> triangles;  ///< one that each point lies in
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
    samples.triangles.assign(samples.points.size(), 0);
    for (TriangleId id = 0; id < surface.triangle_count(); ++id) {
        const Triangle& t = surface.triangles()[id];
        for (const VertexId corner : t) samples.triangles[corner] = id;
        const auto& points = surface.points();
        const int n = std::clamp(static_cast<int>(std::ceil(longest_edge(points, t) / spacing)), 1,
                                 kMostSamples);
        const Vec3 u = (points[t[1]] - points[t[0]]) / n, v = (points[t[2]] - points[t[0]]) / n;
        const double part = triangle_area(points, t) / (n * n);
        samples.areas.resize(samples.areas.size() + n * n, part);
        samples.triangles.resize(samples.areas.size(), id);
        for (int i = 0; i < n; ++i)
            for (int j = 0; i + j < n; ++j) {
                samples.points.push_back(points[t[0]] + (i + 1.0 / 3) * u + (j + 1.0 / 3) * v);
                if (i + j + 1 == n) continue;
                samples.points.push_back(points[t[0]] + (i + 2.0 / 3) * u + (j + 2.0 / 3) * v);
            }
    }
    return samples;
}

struct Found {
    Samples samples;
    std::vector<SurfacePoint> closest;  ///< on the other surface
};

Found found_from(const Surface& from, const Surface& to, double spacing) {
    Found found{samples_of(from, spacing), {}};
    found.closest = SurfaceDistance(to).closest_points(found.samples.points);
    return found;
}

Distances one_way(const Surface& from, const Surface& to, double spacing) {
    const auto [samples, closest] = found_from(from, to, spacing);
    Distances result;
    for (std::size_t i = 0; i < closest.size(); ++i)
        result.add(closest[i].distance, samples.areas[i]);
    return result;
}

/// No wider apart than half the mean edge of the finer surface.
/// \throw InvalidInput if one of them cannot be compared
double sample_spacing(const Surface& surface, const Surface& reference) {
    if (surface.empty() || reference.empty())
        throw InvalidInput("a comparison needs two surfaces with at least one triangle each");
    if (!(area(surface) > 0.0) || !(area(reference) > 0.0))
        throw InvalidInput(
            "a comparison needs two surfaces with an area: all triangles of one have none");
    return 0.5 * std::min(mean_edge_length(surface), mean_edge_length(reference));
}

bool same_triangles(const Surface& a, const Surface& b) {
    return a.vertex_count() == b.vertex_count() && std::ranges::equal(a.triangles(), b.triangles());
}

}  // namespace

ReferenceComparison compare_with_reference(const Surface& surface, const Surface& reference) {
    const double spacing = sample_spacing(surface, reference);
    const Distances there = one_way(surface, reference, spacing);
    const Distances back = one_way(reference, surface, spacing);
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

WeighedComparison compare_by_weight(const Surface& surface, const Surface& reference,
                                    std::span<const double> weights) {
    const double spacing = sample_spacing(surface, reference);
    if (weights.size() != reference.vertex_count())
        throw InvalidInput("there are " + std::to_string(weights.size()) + " weights for " +
                           std::to_string(reference.vertex_count()) + " vertices");
    const auto weighs_much = [&](TriangleId t) {
        double sum = 0.0;
        for (const VertexId v : reference.triangles()[t]) sum += weights[v];
        return sum > 1.5;
    };
    Distances inside, outside;
    const Found there = found_from(surface, reference, spacing);
    for (std::size_t i = 0; i < there.closest.size(); ++i)
        (weighs_much(there.closest[i].triangle) ? inside : outside)
            .add(there.closest[i].distance, there.samples.areas[i]);
    const Found back = found_from(reference, surface, spacing);
    for (std::size_t i = 0; i < back.closest.size(); ++i)
        (weighs_much(back.samples.triangles[i]) ? inside : outside)
            .add(back.closest[i].distance, back.samples.areas[i]);
    return {inside.mean(), outside.mean()};
}

}  // namespace vesselbench
