#pragma once

#include <string>
#include <vector>

#include "workbench/suggest/live_search.h"

namespace vesselbench {

/// "curvature", "error", "volume", "triangles", "skewness"
[[nodiscard]] std::string measure_name(QualityMeasure measure);

/// The measures worth seeing: where the number of triangles is what suggestions aim at, not the
/// curvature, which such operations do not mean to change.
[[nodiscard]] std::vector<QualityMeasure> seen_measures(const QualityScale& scale,
                                                        const Operation& operation);

/// Height of a measure in a graph [-], 1: 100 %. That of triangles is relative to their largest
/// number, before or at any value.
[[nodiscard]] double shown_share(const SensitivityAnalysis& analysis, const CurvePoint& point,
                                 QualityMeasure measure);

/// What 100 % of a measure is: "0.031 mm, decimate share=0.02"
[[nodiscard]] std::string whole_words(const SensitivityAnalysis& analysis, QualityMeasure measure);

/// "Lambda 0.62: curvature 35.2 %, error 3.12 %, volume 0.4 %": the point of the curve next to a
/// value, or that it cannot be combined with the others; empty for a curve without points. If
/// triangles change, in units: "Share 0.5: error 0.0123 mm, volume -0.21 %, triangles 12400,
/// skewness 0.18".
[[nodiscard]] std::string values_at(const QualityCurve& curve, double value,
                                    const QualityScale& scale = {});

/// "Alpha 0.05, Iterations 50; as it is: Lambda": what a suggestion fills in, and what else was
/// analysed.
[[nodiscard]] std::string suggestion_words(const Arguments& best,
                                           const SensitivityAnalysis& analysis);

}  // namespace vesselbench
