#pragma once

namespace vesselbench {

/// The effect of a change on a surface, in a few numbers (thesis 6.4-6.5).
struct QualityMeasures {
    double error = 0.0;          ///< mean distance from the original [mm]: the local error (6.4.1),
                                 ///< or the distance of the surfaces both ways if triangles change
    double error_thesis = 0.0;   ///< the local error as printed in Eq. 6.2 [mm]
    double curvature = 0.0;      ///< integral of H = H_M n / 2 [mm] (Eqs. 6.3-6.4)
    double curvature_abs = 0.0;  ///< integral of |H| [mm]
    double volume = 0.0;         ///< [mm^3] (Eq. 6.5)
    double triangles = 0.0;      ///< their number; 0 if it cannot change
    double skewness = 0.0;       ///< mean equiangle skewness [-]; 0 if triangles cannot change

    bool operator==(const QualityMeasures&) const = default;
};

/// Change of the volume [%]; 0 if the original has none.
[[nodiscard]] inline double volume_change_percent(const QualityMeasures& original,
                                                  const QualityMeasures& measures) {
    return original.volume != 0.0 ? 100.0 * (measures.volume / original.volume - 1.0) : 0.0;
}

/// Remaining part of the integral of |H| [%]; 100 if the original has none.
[[nodiscard]] inline double curvature_percent(const QualityMeasures& original,
                                              const QualityMeasures& measures) {
    return original.curvature_abs > 0.0 ? 100.0 * measures.curvature_abs / original.curvature_abs
                                        : 100.0;
}

}  // namespace vesselbench
