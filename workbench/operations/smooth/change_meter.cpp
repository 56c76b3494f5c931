#include "workbench/operations/smooth/change_meter.h"

#include <utility>

#include "geometry/kernel/measure.h"
#include "geometry/kernel/statistics.h"

namespace vesselbench {

namespace {

double mean_normal_curvature(const Surface& surface, DerivedCache& cache) {
    return mean(normal_curvature(surface, cache));
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
            .volume_change_percent = volume_ != 0.0 ? 100.0 * change / volume_ : 0.0,
            .normal_curvature_before_deg = normal_curvature_deg_,
            .normal_curvature_after_deg = mean_normal_curvature(after, cache_)};
}

}  // namespace vesselbench
