#pragma once

#include "geometry/kernel/derived_cache.h"
#include "geometry/kernel/local_error.h"
#include "geometry/kernel/surface.h"
#include "smoothing/quality/surface_meter.h"

namespace vesselbench {

/// What smoothing has changed: the figures of the report of `smooth`.
struct SmoothingChange {
    LocalError error;                          ///< thesis 6.4.1
    double volume_change_percent = 0.0;        ///< 0 if there was no volume
    double normal_curvature_before_deg = 0.0;  ///< mean over the vertices (thesis 5.4.1)
    double normal_curvature_after_deg = 0.0;
};

/// Measures states of a surface against the state before, whose own figures are found once.
class ChangeMeter {
public:
    /// \param cache of vertex normals: one without room where states are seen for a moment only. It
    /// must outlive this
    explicit ChangeMeter(Surface before, DerivedCache& cache = derived_cache());

    /// \param after the same surface with other positions
    [[nodiscard]] SmoothingChange measure(const Surface& after) const;

private:
    Surface before_;
    DerivedCache& cache_;
    double volume_ = 0.0;                ///< [mm^3]
    double normal_curvature_deg_ = 0.0;  ///< mean
};

/// The same within rounding, several times as fast, for states that are seen for a moment.
class QuickChangeMeter {
public:
    explicit QuickChangeMeter(const Surface& before);

    /// \param after the same surface with other positions
    [[nodiscard]] SmoothingChange measure(const Surface& after) const;

private:
    SurfaceMeter meter_;
    SeenMeasures before_;
};

}  // namespace vesselbench
