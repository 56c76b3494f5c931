#pragma once

#include <cstdint>
#include <string>

#include "smoothing/quality/quality_measures.h"

namespace vesselbench {

/// How curvature, error and volume are combined into one number.
enum class ScoreForm : std::uint8_t {
    Default,  ///< dimensionless: integral of |H|, error relative to the mean edge, without the 1/2
    Thesis,   ///< `score-thesis`: Eq. 6.6 as printed, signed curvature and an error in mm
    Compact   ///< as default, with the number of triangles in place of curvature
};

/// \throw UsageError unless "default", "thesis" or "compact"
[[nodiscard]] ScoreForm score_form_from(const std::string& name);
[[nodiscard]] std::string to_string(ScoreForm form);

/// "curvature" or "triangles": the measure that the form's target uses.
[[nodiscard]] std::string target_name(ScoreForm form);

/// The terms of a score, weighted as in its form, each better the smaller [-] (score-thesis: the
/// error in mm).
struct ScoreTerms {
    double target = 1.0;  ///< curvature (compact: triangles) relative to the original's
    double error = 0.0;
    double volume = 0.0;  ///< change relative to the original's
};

/// The factors of error and volume change in the default score; they cancel the 1/2 of Eq. 6.6.
/// With them tau 0.5 ends close to the true surface on noisy spheres, tori, furcations and
/// aneurysms (docs/science/experiments-suggestions.md).
constexpr double kErrorWeight = 2.0, kVolumeWeight = 2.0;

/// The factor of the volume change where staircases are smoothed. Voxels round to both sides, so
/// that removing their steps keeps the volume while it moves every vertex: of the distance from the
/// raw surface, the part that changes the volume is the error. Chosen on masks of known shape
/// (docs/science/experiments-suggestions.md).
constexpr double kVolumeWeightOnStaircases = 6.0;

struct ScoreSettings {
    ScoreForm form = ScoreForm::Default;
    double tau = 0.5;  ///< target smoothness [-], 0: accurate ... 1: smooth (compact: small)
    double volume_weight = kVolumeWeight;  ///< [-]; a search takes its space's
};

/// The reference for measures.
struct ScoreBase {
    QualityMeasures original;
    double mean_edge = 0.0;                ///< [mm]
    double volume_weight = kVolumeWeight;  ///< [-]
};

[[nodiscard]] ScoreTerms score_terms(const ScoreBase& base, const QualityMeasures& measures,
                                     ScoreForm form);

/// S = tau C + (1 - tau) (E + V) / 2 (Eq. 6.6), with the target as C.
/// \throw InvalidInput unless tau is in [0, 1]
[[nodiscard]] double score(const ScoreTerms& terms, double tau);

}  // namespace vesselbench
