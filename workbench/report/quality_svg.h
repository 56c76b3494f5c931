#pragma once

#include <string>

#include "smoothing/quality/sensitivity.h"

namespace vesselbench {

/// The heading of graphs and bars.
struct QualityTitle {
    std::string source;  ///< "aorta.stl, 12,345 vertices"
    std::string change;  ///< "filter laplace"
    double tau = 0.5;    ///< of the suggestions
};

/// Model quality graphs (thesis 6.5.3): a panel for each parameter, the measures as curves,
/// the current value as a dashed line, the suggested one as a mark on the axis.
[[nodiscard]] std::string quality_graphs_svg(const SensitivityAnalysis& analysis,
                                             const QualityTitle& title);

/// Model quality bars (6.5.4): a row of coloured fields for each parameter and measure, brighter is
/// better, the current value in a dashed frame.
[[nodiscard]] std::string quality_bars_svg(const SensitivityAnalysis& analysis,
                                           const QualityTitle& title, BarOrder order);

}  // namespace vesselbench
