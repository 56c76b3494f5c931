#include "workbench/window/features/quality/quality_words.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "geometry/kernel/wording.h"
#include "workbench/suggest/processing_subject.h"
#include "workbench/window/case/readable.h"

namespace vesselbench {

namespace {

/// By the number before; at least 1 [-].
double most_triangles(const SensitivityAnalysis& analysis) {
    double most = 1.0;
    for (const QualityCurve& curve : analysis.curves)
        for (const CurvePoint& point : curve.points) most = std::max(most, point.scaled.triangles);
    return most;
}

/// The change that leaves a volume: "-0.21 %"
std::string signed_percent(const QualityScale& scale, double volume) {
    const QualityMeasures before{.volume = scale.original_volume}, after{.volume = volume};
    return formatted(volume_change_percent(before, after), "%+.2f %%");
}

}  // namespace

std::string measure_name(QualityMeasure measure) {
    switch (measure) {
        case QualityMeasure::Curvature:
            return "curvature";
        case QualityMeasure::Error:
            return "error";
        case QualityMeasure::Volume:
            return "volume";
        case QualityMeasure::Triangles:
            return "triangles";
        case QualityMeasure::Skewness:
            break;
    }
    return "skewness";
}

std::vector<QualityMeasure> seen_measures(const QualityScale& scale, const Operation& operation) {
    std::vector<QualityMeasure> measures = measures_of(scale);
    if (counts_triangles(operation.search)) std::erase(measures, QualityMeasure::Curvature);
    return measures;
}

double shown_share(const SensitivityAnalysis& analysis, const CurvePoint& point,
                   QualityMeasure measure) {
    const double share = point.scaled.of(measure);
    return measure == QualityMeasure::Triangles ? share / most_triangles(analysis) : share;
}

std::string whole_words(const SensitivityAnalysis& analysis, QualityMeasure measure) {
    const QualityScale& scale = analysis.scale;
    switch (measure) {
        case QualityMeasure::Curvature:
            return formatted(scale.curvature_abs) + " mm, before; 0 %: " + scale.strong;
        case QualityMeasure::Error:
            return formatted(scale.error) + " mm, " + scale.strong;
        case QualityMeasure::Volume:
            return signed_percent(scale, scale.original_volume + scale.volume) +
                   " of the volume, " + scale.strong;
        case QualityMeasure::Triangles:
            return formatted(most_triangles(analysis) * scale.triangles, "%.0f");
        case QualityMeasure::Skewness:
            break;
    }
    return "triangles without an area";
}

std::string values_at(const QualityCurve& curve, double value, const QualityScale& scale) {
    const auto nearest = std::ranges::min_element(
        curve.points, {}, [&](const CurvePoint& point) { return std::abs(point.value - value); });
    if (nearest == curve.points.end()) return "";
    const std::string title = readable(curve.name) + " " + formatted(nearest->value, "%.4g");
    const auto& measures = nearest->measures;
    if (!measures) return title + " cannot be combined with the other values";
    if (scale.triangles > 0.0)
        return title + ": " +
               joined(
                   std::vector<std::string>{"error " + formatted(measures->error) + " mm",
                                            "volume " + signed_percent(scale, measures->volume),
                                            "triangles " + formatted(measures->triangles, "%.0f"),
                                            "skewness " + formatted(measures->skewness)});
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
