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

ReferenceComparison compare_with_reference(const Surface& surface, const Surface& reference,
                                           const Progress& progress) {
    const double spacing = sample_spacing(surface, reference);
    const SampledDistance there =
        sampled_distance(surface_samples(surface, spacing), distance_to(reference), progress);
    const SampledDistance back =
        sampled_distance(surface_samples(reference, spacing), distance_to(surface), progress);
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
                                    std::span<const double> weights, const Progress& progress) {
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
    const auto add_here = [&](std::size_t i, const SurfacePoint& there) {
        (weighs_much(there.triangle) ? inside : outside).add(there.distance, here.areas[i]);
    };
    for_each_closest(here, distance_to(reference), add_here, progress);
    const SurfaceSamples references = surface_samples(reference, spacing);
    const auto add_back = [&](std::size_t i, const SurfacePoint& back) {
        (weighs_much(references.triangles[i]) ? inside : outside)
            .add(back.distance, references.areas[i]);
    };
    for_each_closest(references, distance_to(surface), add_back, progress);
    return {{inside.mean(), inside.largest}, {outside.mean(), outside.largest}};
}

}  // namespace vesselbench
