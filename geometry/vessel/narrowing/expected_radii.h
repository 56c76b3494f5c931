#pragma once

#include <span>
#include <vector>

namespace vesselbench {

/// A radius measured at a place of a vessel.
struct RadiusSample {
    double along = 0.0;   ///< arc length [mm], ascending
    double radius = 0.0;  ///< [mm], > 0
    bool counts = true;   ///< false: a bulge, or a stretch that is in question
};

/// What a healthy vessel's radius would be at each sample.
struct ExpectedRadii {
    std::vector<double> radii;    ///< [mm], #samples; empty: too few samples count
    std::vector<double> scatter;  ///< of the logarithm of the samples' radii around it [-]
};

/// Robust regression of the logarithm of the radius along the vessel: a line (a vessel tapers by
/// equal shares) within a window of 20 diameters, from repeated medians (Siegel, "Robust regression
/// using repeated medians", Biometrika 1982), refined by reweighted least squares with Tukey's
/// biweight. A narrowing of less than half of the window does not bend it; the
/// taper is at most 5 % a diameter, and none in less than 4 diameters of vessel.
[[nodiscard]] ExpectedRadii expected_radii(std::span<const RadiusSample> samples);

}  // namespace vesselbench
