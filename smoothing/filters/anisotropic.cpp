#include "smoothing/filters/anisotropic.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "geometry/kernel/argument_checks.h"
#include "geometry/kernel/parallel.h"
#include "smoothing/filters/cotangents.h"
#include "smoothing/filters/filter_settings.h"
#include "smoothing/filters/vertex_mover.h"

namespace vesselbench {

namespace {

double flow_share(const VertexCurvature& curvature, double feature) {
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
    return mean > 0.0 ? 0.5 / mean : 1.0;  // any value will do without an edge
}

Positions anisotropic(const Topology& topology, const Positions& positions,
                      const AnisotropicParameters& parameters, const FilterSettings& settings,
                      const Progress& progress) {
    require_range("lambda", parameters.lambda, 0.0, 1.0);
    require_one_ring("anisotropic smoothing", settings);
    const VertexMover mover(topology, positions, settings);
    const double feature = parameters.feature_curvature.value_or(
        default_feature_curvature(topology, start_of(positions, settings)));
    require_positive("feature_curvature", feature);
    Positions now = positions, next = positions;
    Cotangents cotangents;
    for (int iteration = 0; iteration < settings.iterations; ++iteration) {
        progress.report(static_cast<double>(iteration) / settings.iterations, "smoothing");
        find_cotangents(topology, now, cotangents);
        const auto curvatures = vertex_curvatures(topology, now);
        for_each_vertex(now.size(), [&](std::size_t v) {
            if (mover.stays(v)) return;
            const Vec3 umbrella =
                cotangent_umbrella(topology, now, cotangents, static_cast<VertexId>(v));
            const double share = parameters.lambda * flow_share(curvatures[v], feature);
            next[v] = mover.moved(v, now[v], share * umbrella);
        });
        std::swap(now, next);
    }
    return now;
}

}  // namespace vesselbench
