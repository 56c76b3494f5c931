#pragma once

#include <optional>
#include <string>
#include <vector>

#include "smoothing/quality/search.h"

namespace vesselbench {

enum class QualityMeasure { Curvature, Error, Volume, Triangles };

/// Measures scaled for graphs and bars (thesis 6.5.3) [-].
struct ScaledQuality {
    /// Integral of |H|: 1 of the original, 0 of the strong change; by the original's where the
    /// strong change does not lessen it.
    double curvature = 1.0;
    double error = 0.0;      ///< by that of the strong change
    double volume = 0.0;     ///< size of the volume change by that of the strong change
    double triangles = 0.0;  ///< by the original's

    [[nodiscard]] double of(QualityMeasure measure) const;
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
    double curvature_zero = 0.0;   ///< of the strong change, what 0 % stands for [mm]
    double error = 0.0;            ///< of the strong change [mm]
    double volume = 0.0;           ///< change by the strong change [mm^3], with its sign
    double original_volume = 0.0;  ///< [mm^3]
    double triangles = 0.0;        ///< of the original; 0 where they cannot change
    std::string strong;            ///< how the strong change is made
};

/// The measures that change: the number of triangles only where it can.
[[nodiscard]] std::vector<QualityMeasure> measures_of(const QualityScale& scale);

struct SensitivityAnalysis {
    QualityScale scale;
    std::vector<QualityCurve> curves;  ///< one for each parameter of the space
};

[[nodiscard]] QualityScale quality_scale(MeasureSource& table, const Progress& progress = {});

[[nodiscard]] ScaledQuality scaled_quality(const QualityScale& scale,
                                           const QualityMeasures& measures);

/// The graph of one parameter. Its current value counts among its values.
/// \param coarse takes the parameter's coarse values only \throw Cancelled
[[nodiscard]] QualityCurve quality_curve(ParameterSearch& search, std::size_t parameter,
                                         const ParameterSet& current, bool coarse = false,
                                         const Progress& progress = {});

/// The graphs of all parameters. One run of a filter goes through all iteration counts. \throw
/// Cancelled
[[nodiscard]] SensitivityAnalysis sensitivity(ParameterSearch& search, const ParameterSet& current,
                                              bool coarse = false, const Progress& progress = {});

/// Model quality bars (6.5.4): the measures of the curves side by side, each value a colour.
struct QualityBar {
    std::size_t curve = 0;  ///< whose parameter it is
    QualityMeasure measure = QualityMeasure::Curvature;
    std::vector<double> goodness;  ///< at each point of the curve, 0 bad ... 1 good; NaN: left out
};

enum class BarOrder { Parameter, Measure };  ///< which bars stand together

[[nodiscard]] std::vector<QualityBar> quality_bars(const SensitivityAnalysis& analysis,
                                                   BarOrder order);

}  // namespace vesselbench
