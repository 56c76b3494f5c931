#include "smoothing/filters/mean_curvature_flow.h"

#include <utility>

#include "geometry/kernel/argument_checks.h"
#include "geometry/kernel/parallel.h"
#include "smoothing/filters/cotangents.h"
#include "smoothing/filters/filter_settings.h"
#include "smoothing/filters/vertex_mover.h"

namespace vesselbench {

Positions mean_curvature_flow(const Topology& topology, const Positions& positions,
                              const MeanCurvatureFlowParameters& parameters,
                              const FilterSettings& settings, const Progress& progress) {
    require_range("lambda", parameters.lambda, 0.0, 1.0);
    require_one_ring("mean curvature flow", settings);
    const VertexMover mover(topology, positions, settings);
    Positions now = positions, next = positions;
    Cotangents cotangents;
    for (int iteration = 0; iteration < settings.iterations; ++iteration) {
        progress.report(static_cast<double>(iteration) / settings.iterations, "smoothing");
        find_cotangents(topology, now, cotangents);
        for_each_vertex(now.size(), [&](std::size_t v) {
            if (mover.stays(v)) return;
            const Vec3 umbrella =
                cotangent_umbrella(topology, now, cotangents, static_cast<VertexId>(v));
            next[v] = mover.moved(v, now[v], parameters.lambda * umbrella);
        });
        std::swap(now, next);
    }
    return now;
}

}  // namespace vesselbench
