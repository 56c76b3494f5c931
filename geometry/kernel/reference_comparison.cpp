#include "geometry/kernel/reference_comparison.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/local_error.h"
#include "geometry/kernel/measure.h"
#include "geometry/kernel/surface_samples.h"

namespace vesselbench {

namespace {

/// At most half the mean edge of the finer surface apart.
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
    const SampledDistance there =
        sampled_distance(surface_samples(surface, spacing), distance_to(reference));
    const SampledDistance back =
        sampled_distance(surface_samples(reference, spacing), distance_to(surface));
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
    SampledDistance inside, outside;
    const SurfaceSamples here = surface_samples(surface, spacing);
    const auto there = distance_to(reference).closest_points(here.points);
    for (std::size_t i = 0; i < there.size(); ++i)
        (weighs_much(there[i].triangle) ? inside : outside).add(there[i].distance, here.areas[i]);
    const SurfaceSamples references = surface_samples(reference, spacing);
    const auto back = distance_to(surface).closest_points(references.points);
    for (std::size_t i = 0; i < back.size(); ++i)
        (weighs_much(references.triangles[i]) ? inside : outside)
            .add(back[i].distance, references.areas[i]);
    return {{inside.mean(), inside.largest}, {outside.mean(), outside.largest}};
}

}  // namespace vesselbench
