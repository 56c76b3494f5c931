#pragma once

#include "geometry/kernel/progress.h"
#include "geometry/kernel/surface.h"
#include "geometry/kernel/surface_distance.h"
#include "geometry/kernel/surface_samples.h"
#include "smoothing/quality/quality_measures.h"

namespace vesselbench {

/// Measures surfaces with arbitrary triangles against one original (thesis 7.2: the local error
/// needs the same triangles). The error is the area-weighted mean of the distances both ways, from
/// samples no farther apart than the original's mean edge; curvature, volume and the shape of
/// triangles are those of geometry/kernel.
class ComparisonMeter {
public:
    /// \throw InvalidInput if the surface has no triangle, or none with an area
    explicit ComparisonMeter(Surface original);

    /// \throw InvalidInput as the constructor; Cancelled
    [[nodiscard]] QualityMeasures measure(const Surface& surface,
                                          const Progress& progress = {}) const;

    [[nodiscard]] const QualityMeasures& original() const { return original_measures_; }

    [[nodiscard]] double mean_edge() const { return mean_edge_; }  ///< of the original [mm]

private:
    Surface original_;
    QualityMeasures original_measures_;
    SurfaceDistance distance_;
    double mean_edge_ = 0.0;
    SurfaceSamples samples_;
};

}  // namespace vesselbench
