#include "smoothing/filters/anisotropic.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "smoothing/filters/cotangents.h"
#include "smoothing/filters/filter_support.h"

namespace vesselbench {

namespace {

double flow_share(const detail::VertexCurvature& curvature, double feature) {
    const double mean = curvature.mean;
    const double spread = std::sqrt(std::max(0.0, mean * mean - curvature.gauss));
    const double one = mean + spread, two = mean - spread;
    if (std::abs(one) <= feature && std::abs(two) <= feature) return 1.0;
    if (std::abs(one) > feature && std::abs(two) > feature && curvature.gauss > 0.0) return 0.0;
    const double smallest = std::abs(one) < std::abs(two) ? one : two;
    if (std::abs(mean) <= std::abs(smallest)) return 1.0;
    return std::clamp(smallest / mean, 0.0, 1.0);
}

}  // namespace

double default_feature_curvature(const Topology& topology, const Positions& positions) {
    double sum = 0.0;
    for (const Triangle& t : topology.triangles())
        for (int k = 0; k < 3; ++k) sum += (positions[t[k]] - positions[t[(k + 1) % 3]]).norm();
    const double mean = sum / (3.0 * static_cast<double>(topology.triangle_count()));
    return mean > 0.0 ? 0.5 / mean : 1.0;  // without an edge there is nothing to decide
}

Positions anisotropic(const Topology& topology, const Positions& positions,
                      const AnisotropicParameters& parameters, const FilterSettings& settings,
                      const Progress& progress) {
    detail::require_range("lambda", parameters.lambda, 0.0, 1.0);
    detail::require_one_ring("anisotropic smoothing", settings);
    const detail::VertexMover mover(topology, positions, settings);
    const double feature = parameters.feature_curvature.value_or(
        default_feature_curvature(topology, detail::start_of(positions, settings)));
    detail::require_positive("feature_curvature", feature);
    Positions now = positions, next = positions;
    detail::Cotangents cotangents;
    for (int iteration = 0; iteration < settings.iterations; ++iteration) {
        progress.report(static_cast<double>(iteration) / settings.iterations, "smoothing");
        detail::find_cotangents(topology, now, cotangents);
        const auto curvatures = detail::vertex_curvatures(topology, now);
        detail::for_each_vertex(now.size(), [&](std::size_t v) {
            if (mover.stays(v)) return;
            const Vec3 umbrella =
                detail::cotangent_umbrella(topology, now, cotangents, static_cast<VertexId>(v));
            const double share = parameters.lambda * flow_share(curvatures[v], feature);
            next[v] = mover.moved(v, now[v], share * umbrella);
        });
        std::swap(now, next);
    }
    return now;
}

}  // namespace vesselbench
