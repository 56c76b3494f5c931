#include "workbench/operations/smooth/change_meter.h"

#include <utility>
#include <vector>

#include "geometry/kernel/measure.h"
#include "geometry/kernel/parallel.h"
#include "geometry/kernel/statistics.h"

namespace vesselbench {

namespace {

double mean_normal_curvature(const Surface& surface, DerivedCache& cache) {
    return mean(normal_curvature(surface, cache));
}

std::vector<PackRow> packs_of(const Positions& points) {
    std::vector<PackRow> packs(points.size());
    for_each_vertex(points.size(), [&](std::size_t v) {
        packs[v] = {{points[v].x(), points[v].y(), points[v].z(), 0.0}};
    });
    return packs;
}

double percent_of(double change, double whole) {
    return whole != 0.0 ? 100.0 * change / whole : 0.0;
}

}  // namespace

ChangeMeter::ChangeMeter(Surface before, DerivedCache& cache)
    : before_(std::move(before)),
      cache_(cache),
      volume_(volume(before_)),
      normal_curvature_deg_(mean_normal_curvature(before_, cache)) {}

SmoothingChange ChangeMeter::measure(const Surface& after) const {
    const double change = volume(after) - volume_;
    return {.error = local_error(*before_.topology, before_.points(), after.points()),
            .volume_change_percent = percent_of(change, volume_),
            .normal_curvature_before_deg = normal_curvature_deg_,
            .normal_curvature_after_deg = mean_normal_curvature(after, cache_)};
}

QuickChangeMeter::QuickChangeMeter(const Surface& before)
    : meter_(before.topology, before.positions),
      before_(meter_.measure_seen(packs_of(before.points()))) {}

SmoothingChange QuickChangeMeter::measure(const Surface& after) const {
    SeenMeasures seen = meter_.measure_seen(packs_of(after.points()));
    return {.error = std::move(seen.error),
            .volume_change_percent = percent_of(seen.volume - before_.volume, before_.volume),
            .normal_curvature_before_deg = before_.normal_curvature_deg,
            .normal_curvature_after_deg = seen.normal_curvature_deg};
}

}  // namespace vesselbench
