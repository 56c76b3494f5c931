#pragma once

#include <optional>
#include <string>
#include <vector>

#include "quality/search.h"

namespace vesselbench {

/// Measures scaled for graphs and bars (thesis 6.5.3) [-].
struct ScaledQuality {
    /// Integral of |H|: 1 of the original, 0 of very strong smoothing; by the original's where
    /// strong smoothing does not lessen it.
    double curvature = 1.0;
    double error = 0.0;   ///< mean local error by that of very strong smoothing
    double volume = 0.0;  ///< size of the volume change by that of very strong smoothing
};

/// What one value of a parameter gives while the others stay; empty where the set is left out.
struct CurvePoint {
    double value = 0.0;
    std::optional<QualityMeasures> measures;
    ScaledQuality scaled;
    double score = 0.0;
};

/// A model quality graph: the measures along the range of one parameter.
struct QualityCurve {
    std::string name;  ///< of the parameter
    std::string unit;
    std::vector<CurvePoint> points;  ///< values ascending
    double current = 0.0;            ///< the parameter's value now
    double suggested = 0.0;          ///< where the score is lowest while the others stay
};

/// What 100 % of a graph stands for.
struct QualityScale {
    double curvature_abs = 0.0;    ///< of the original [mm]
    double curvature_zero = 0.0;   ///< of very strong smoothing, what 0 % stands for [mm]
    double error = 0.0;            ///< of very strong smoothing [mm]
    double volume = 0.0;           ///< change by very strong smoothing [mm^3], with its sign
    double original_volume = 0.0;  ///< [mm^3]
};

struct SensitivityAnalysis {
    QualityScale scale;
    std::vector<QualityCurve> curves;  ///< one for each parameter of the space
};

[[nodiscard]] QualityScale quality_scale(QualityTable& table, const Progress& progress = {});

[[nodiscard]] ScaledQuality scaled_quality(const QualityScale& scale,
                                           const QualityMeasures& measures);

/// The graph of one parameter. Its current value counts among its values.
/// \param coarse takes the parameter's coarse values only \throw Cancelled
[[nodiscard]] QualityCurve quality_curve(ParameterSearch& search, std::size_t parameter,
                                         const ParameterSet& current, bool coarse = false,
                                         const Progress& progress = {});

/// The graphs of all parameters. One run goes through all iteration counts. \throw Cancelled
[[nodiscard]] SensitivityAnalysis sensitivity(ParameterSearch& search, const ParameterSet& current,
                                              bool coarse = false, const Progress& progress = {});

/// Model quality bars (6.5.4): the measures of the curves side by side, each value a colour.
enum class QualityMeasure { Curvature, Error, Volume };

[[nodiscard]] std::string to_string(QualityMeasure measure);

struct QualityBar {
    std::size_t curve = 0;  ///< whose parameter it is
    QualityMeasure measure = QualityMeasure::Curvature;
    std::vector<double> goodness;  ///< at each point of the curve, 0 bad ... 1 good; NaN: left out
};

enum class BarOrder { Parameter, Measure };  ///< which bars stand together

[[nodiscard]] std::vector<QualityBar> quality_bars(const SensitivityAnalysis& analysis,
                                                   BarOrder order);

}  // namespace vesselbench
