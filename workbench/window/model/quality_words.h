#pragma once

#include <string>

#include "workbench/suggest/live_search.h"

namespace vesselbench {

/// "curvature", "error", "volume"
[[nodiscard]] std::string measure_name(QualityMeasure measure);

/// "Lambda 0.62: curvature 35.2 %, error 3.12 %, volume 0.4 %": the point of the curve next to a
/// value, or that it cannot be combined with the others; empty for a curve without points.
[[nodiscard]] std::string values_at(const QualityCurve& curve, double value);

/// "Alpha 0.05, Iterations 50; as it is: Lambda": what a suggestion fills in, and what else was
/// analysed.
[[nodiscard]] std::string suggestion_words(const Arguments& best,
                                           const SensitivityAnalysis& analysis);

}  // namespace vesselbench
