#include "smoothing/filters/curvature_triggered.h"

#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "geometry/kernel/argument_checks.h"
#include "geometry/kernel/parallel.h"
#include "smoothing/filters/anisotropic.h"
#include "smoothing/filters/cotangents.h"
#include "smoothing/filters/filter_settings.h"
#include "smoothing/filters/two_rings.h"
#include "smoothing/filters/vertex_mover.h"

namespace vesselbench {

namespace {

constexpr int kNever = std::numeric_limits<int>::max();

/// The iteration from which each vertex may move: 0 where the curvature exceeds the threshold, one
/// more for each further ring around moving vertices.
std::vector<int> first_iterations(const Topology& topology, const CompressedRows& neighbours,
                                  const Positions& positions, const VertexMover& mover,
                                  double trigger) {
    const auto curvatures = vertex_curvatures(topology, positions);
    std::vector<int> first(positions.size(), kNever);
    std::vector<VertexId> queue;
    for (VertexId v = 0; v < positions.size(); ++v)
        if (!mover.stays(v) && std::abs(curvatures[v].mean) > trigger) {
            first[v] = 0;
            queue.push_back(v);
        }
    for (std::size_t i = 0; i < queue.size(); ++i)
        for (const VertexId u : neighbours.row(queue[i]))
            if (first[u] == kNever && !mover.stays(u)) {
                first[u] = first[queue[i]] + 1;
                queue.push_back(u);
            }
    return first;
}

Vec3 umbrella(const CompressedRows& neighbours, const Positions& x, std::size_t v) {
    const auto row = neighbours.row(v);
    if (row.empty()) return Vec3::Zero();
    Vec3 sum = Vec3::Zero();
    for (const VertexId u : row) sum += x[u];
    return sum / static_cast<double>(row.size()) - x[v];
}

}  // namespace

double default_trigger_curvature(const Topology& topology, const Positions& positions) {
    return 0.5 * default_feature_curvature(topology, positions);
}

Positions curvature_triggered(const Topology& topology, const Positions& positions,
                              const CurvatureTriggeredParameters& parameters,
                              const FilterSettings& settings, const Progress& progress) {
    require_range("lambda", parameters.lambda, 0.0, 1.0);
    const VertexMover mover(topology, positions, settings);
    const Positions& start = start_of(positions, settings);
    const int done = settings.earlier ? settings.earlier->iterations : 0;
    const double trigger =
        parameters.trigger_curvature.value_or(default_trigger_curvature(topology, start));
    require_positive("trigger_curvature", trigger);
    const CompressedRows wide = settings.rings == 1 ? CompressedRows{} : two_rings(topology);
    const CompressedRows& neighbours = settings.rings == 1 ? topology.rings() : wide;
    const auto first = first_iterations(topology, neighbours, start, mover, trigger);
    Positions now = positions, next = positions;
    for (int iteration = 0; iteration < settings.iterations; ++iteration) {
        progress.report(static_cast<double>(iteration) / settings.iterations, "smoothing");
        for_each_vertex(now.size(), [&](std::size_t v) {
            if (first[v] > done + iteration) return;
            const Vec3 displacement = parameters.lambda * umbrella(neighbours, now, v);
            next[v] = mover.moved(v, now[v], displacement);
        });
        std::swap(now, next);
    }
    return now;
}

}  // namespace vesselbench
