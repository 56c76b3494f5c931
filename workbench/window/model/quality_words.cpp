#include "workbench/window/model/quality_words.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "geometry/kernel/wording.h"
#include "workbench/window/model/readable.h"

namespace vesselbench {

std::string measure_name(QualityMeasure measure) {
    switch (measure) {
        case QualityMeasure::Curvature:
            return "curvature";
        case QualityMeasure::Error:
            return "error";
        case QualityMeasure::Volume:
            return "volume";
        case QualityMeasure::Triangles:
            break;
    }
    return "triangles";
}

std::string values_at(const QualityCurve& curve, double value) {
    const auto nearest = std::ranges::min_element(
        curve.points, {}, [&](const CurvePoint& point) { return std::abs(point.value - value); });
    if (nearest == curve.points.end()) return "";
    const std::string title = readable(curve.name) + " " + formatted(nearest->value, "%.4g");
    if (!nearest->measures) return title + " cannot be combined with the other values";
    std::vector<std::string> words;
    for (const auto measure :
         {QualityMeasure::Curvature, QualityMeasure::Error, QualityMeasure::Volume})
        words.push_back(measure_name(measure) +
                        formatted(100.0 * nearest->scaled.of(measure), " %.3g %%"));
    return title + ": " + joined(words);
}

std::string suggestion_words(const Arguments& best, const SensitivityAnalysis& analysis) {
    std::vector<std::string> words, kept;
    for (const auto& [name, value] : best.values())
        words.push_back(readable(name) + " " + formatted(best.real(name)));
    for (const QualityCurve& curve : analysis.curves)
        if (!best.has(curve.name)) kept.push_back(readable(curve.name));
    return joined(words) + (kept.empty() ? "" : "; as it is: " + joined(kept));
}

}  // namespace vesselbench
