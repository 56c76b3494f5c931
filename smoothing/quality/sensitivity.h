#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "smoothing/quality/search.h"

namespace vesselbench {

enum class QualityMeasure : std::uint8_t { Curvature, Error, Volume, Triangles, Skewness };

/// Measures scaled for graphs and bars (thesis 6.5.3) [-].
struct ScaledQuality {
    /// Integral of |H|: 1 for the original, 0 for the strong change; relative to the original's if
    /// the strong change does not reduce it.
    double curvature = 1.0;
    double error = 0.0;      ///< relative to that of the strong change
    double volume = 0.0;     ///< absolute volume change relative to that of the strong change
    double triangles = 0.0;  ///< relative to the original's
    double skewness = 0.0;   ///< the mean itself: 0 best, 1 degenerate

    [[nodiscard]] double of(QualityMeasure measure) const;
};

/// The measures at one value of a parameter, others fixed; empty if the set is left out.
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
    double current = 0.0;            ///< the parameter's current value
    double suggested = 0.0;          ///< value of the lowest score while the others are fixed
    double least = 0.0, most = 0.0;  ///< all its values, also those without a point yet
};

/// The values that 100 % of a graph represents.
struct QualityScale {
    double curvature_abs = 0.0;    ///< of the original [mm]
    double curvature_zero = 0.0;   ///< of the strong change, represented by 0 % [mm]
    double error = 0.0;            ///< of the strong change [mm]
    double volume = 0.0;           ///< change by the strong change [mm^3], with its sign
    double original_volume = 0.0;  ///< [mm^3]
    double triangles = 0.0;        ///< of the original; 0 if they cannot change
    std::string strong;            ///< the recipe of the strong change
};

/// The measures that change: number and shape of triangles only if they can.
[[nodiscard]] std::vector<QualityMeasure> measures_of(const QualityScale& scale);

struct SensitivityAnalysis {
    QualityScale scale;
    std::vector<QualityCurve> curves;  ///< one for each parameter of the space
};

[[nodiscard]] QualityScale quality_scale(MeasureSource& table, const Progress& progress = {});

[[nodiscard]] ScaledQuality scaled_quality(const QualityScale& scale,
                                           const QualityMeasures& measures);

/// The values of a parameter in its graph, besides the current one.
enum class CurveValues : std::uint8_t {
    All,
    Coarse,  ///< the parameter's coarse values
    Known    ///< those among all, the current one included, that take no more work
};

/// The graph of one parameter. \throw Cancelled
[[nodiscard]] QualityCurve quality_curve(ParameterSearch& search, std::size_t parameter,
                                         const ParameterSet& current,
                                         CurveValues which = CurveValues::All,
                                         const Progress& progress = {});

/// The graphs of all parameters. One run of a filter covers all iteration counts. \throw
/// Cancelled
[[nodiscard]] SensitivityAnalysis sensitivity(ParameterSearch& search, const ParameterSet& current,
                                              CurveValues which = CurveValues::All,
                                              const Progress& progress = {});

/// Model quality bars (6.5.4): the measures of the curves side by side, each value as a colour.
struct QualityBar {
    std::size_t curve = 0;  ///< the curve of its parameter
    QualityMeasure measure = QualityMeasure::Curvature;
    std::vector<double> goodness;  ///< at each point of the curve, 0 bad ... 1 good; NaN: left out
};

enum class BarOrder { Parameter, Measure };  ///< how bars are grouped

[[nodiscard]] std::vector<QualityBar> quality_bars(const SensitivityAnalysis& analysis,
                                                   BarOrder order);

}  // namespace vesselbench
