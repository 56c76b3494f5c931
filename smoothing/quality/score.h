#pragma once

#include <cstdint>
#include <string>

#include "smoothing/quality/quality_measures.h"

namespace vesselbench {

/// How curvature, error and volume become one number.
enum class ScoreForm : std::uint8_t {
    Default,  ///< no unit: integral of |H|, error by the mean edge, without the 1/2
    Thesis,   ///< `score-thesis`: Eq. 6.6 as printed, signed curvature and an error in mm
    Compact   ///< as default, with the number of triangles in place of curvature
};

/// \throw UsageError unless "default", "thesis" or "compact"
[[nodiscard]] ScoreForm score_form_from(const std::string& name);
[[nodiscard]] std::string to_string(ScoreForm form);

/// "curvature" or "triangles": what the form's target is of.
[[nodiscard]] std::string target_name(ScoreForm form);

struct ScoreSettings {
    ScoreForm form = ScoreForm::Default;
    double tau = 0.5;  ///< target smoothness [-], 0: accurate ... 1: smooth (compact: small)
};

/// The parts of a score, weighted as its form does it, each the smaller the better [-]
/// (score-thesis: the error in mm).
struct ScoreTerms {
    double target = 1.0;  ///< curvature (compact: triangles) by the original's
    double error = 0.0;
    double volume = 0.0;  ///< change, by the original's
};

/// What the default score multiplies error and volume change with, which undoes the 1/2 of Eq. 6.6:
/// so tau 0.5 ends all but nearest to the true surface on noisy spheres, tori, furcations and
/// aneurysms (docs/experiments-suggestions.md).
constexpr double kErrorWeight = 2.0, kVolumeWeight = 2.0;

/// What measures are compared with.
struct ScoreBase {
    QualityMeasures original;
    double mean_edge = 0.0;  ///< [mm]
};

[[nodiscard]] ScoreTerms score_terms(const ScoreBase& base, const QualityMeasures& measures,
                                     ScoreForm form);

/// S = tau C + (1 - tau) (E + V) / 2 (Eq. 6.6), with the target for C.
/// \throw InvalidInput unless tau is in [0, 1]
[[nodiscard]] double score(const ScoreTerms& terms, double tau);

}  // namespace vesselbench
