#include "smoothing/filters/mean_curvature_flow.h"

#include <utility>

#include "smoothing/filters/cotangents.h"
#include "smoothing/filters/filter_support.h"

namespace vesselbench {

Positions mean_curvature_flow(const Topology& topology, const Positions& positions,
                              const MeanCurvatureFlowParameters& parameters,
                              const FilterSettings& settings, const Progress& progress) {
    detail::require_range("lambda", parameters.lambda, 0.0, 1.0);
    detail::require_one_ring("mean curvature flow", settings);
    const detail::VertexMover mover(topology, positions, settings);
    Positions now = positions, next = positions;
    detail::Cotangents cotangents;
    for (int iteration = 0; iteration < settings.iterations; ++iteration) {
        progress.report(static_cast<double>(iteration) / settings.iterations, "smoothing");
        detail::find_cotangents(topology, now, cotangents);
        detail::for_each_vertex(now.size(), [&](std::size_t v) {
            if (mover.stays(v)) return;
            const Vec3 umbrella =
                detail::cotangent_umbrella(topology, now, cotangents, static_cast<VertexId>(v));
            next[v] = mover.moved(v, now[v], parameters.lambda * umbrella);
        });
        std::swap(now, next);
    }
    return now;
}

}  // namespace vesselbench
