#include "smoothing/quality/comparison_meter.h"

#include <cmath>
#include <utility>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/mean_curvature.h"
#include "geometry/kernel/measure.h"
#include "geometry/kernel/triangle_shape.h"

namespace vesselbench {

namespace {

/// All measures except the distance.
QualityMeasures shape_of(const Surface& surface) {
    if (surface.empty() || !(area(surface) > 0.0))
        throw InvalidInput("a surface without an area cannot be measured");
    QualityMeasures measures{.volume = volume(surface),
                             .triangles = static_cast<double>(surface.triangle_count()),
                             .skewness = triangle_shape(surface).equiangle_skewness.mean};
    const MeanCurvature curvature = mean_curvature(surface);
    for (std::size_t v = 0; v < curvature.values.size(); ++v) {
        measures.curvature += curvature.values[v] * curvature.areas[v];
        measures.curvature_abs += std::abs(curvature.values[v]) * curvature.areas[v];
    }
    return measures;
}

}  // namespace

ComparisonMeter::ComparisonMeter(Surface original)
    : original_(std::move(original)),
      original_measures_(shape_of(original_)),
      distance_(distance_to(original_)),
      mean_edge_(mean_edge_length(original_)),
      samples_(surface_samples(original_, mean_edge_)) {}

QualityMeasures ComparisonMeter::measure(const Surface& surface, const Progress& progress) const {
    progress.check_cancelled();
    QualityMeasures measures = shape_of(surface);
    progress.check_cancelled();
    const SampledDistance there = sampled_distance(surface_samples(surface, mean_edge_), distance_);
    progress.check_cancelled();
    const SampledDistance back = sampled_distance(samples_, SurfaceDistance(surface));
    measures.error = (there.sum + back.sum) / (there.area + back.area);
    return measures;
}

}  // namespace vesselbench
