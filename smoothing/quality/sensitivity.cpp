#include "smoothing/quality/sensitivity.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vesselbench {

namespace {

double share(double value, double whole) {
    return whole != 0.0 ? std::abs(value / whole) : 0.0;
}

std::vector<double> values_of(const SearchParameter& parameter, double current, CurveValues which) {
    std::vector<double> values = chosen_values(parameter, which == CurveValues::Coarse);
    values.push_back(current);
    std::ranges::sort(values);
    values.erase(std::unique(values.begin(), values.end()), values.end());
    return values;
}

/// The sets of a parameter's graph.
std::vector<ParameterSet> sets_of(ParameterSearch& search, std::size_t parameter,
                                  const ParameterSet& current, CurveValues which) {
    std::vector<ParameterSet> sets;
    for (const double value :
         values_of(search.space().parameters.at(parameter), current[parameter], which)) {
        ParameterSet set = current;
        set[parameter] = value;
        if (which != CurveValues::Known || search.table().knows(set))
            sets.push_back(std::move(set));
    }
    return sets;
}

bool is_usable(const CurvePoint& point) {
    return point.measures.has_value();
}

double goodness_of(const CurvePoint& point, QualityMeasure measure) {
    if (!point.measures) return std::numeric_limits<double>::quiet_NaN();
    return 1.0 - std::clamp(point.scaled.of(measure), 0.0, 1.0);
}

}  // namespace

double ScaledQuality::of(QualityMeasure measure) const {
    switch (measure) {
        case QualityMeasure::Curvature:
            return curvature;
        case QualityMeasure::Error:
            return error;
        case QualityMeasure::Volume:
            return volume;
        case QualityMeasure::Triangles:
            return triangles;
        case QualityMeasure::Skewness:
            return skewness;
    }
    return 0.0;
}

std::vector<QualityMeasure> measures_of(const QualityScale& scale) {
    std::vector<QualityMeasure> list = {QualityMeasure::Curvature, QualityMeasure::Error,
                                        QualityMeasure::Volume};
    if (scale.triangles > 0.0)
        list.insert(list.end(), {QualityMeasure::Triangles, QualityMeasure::Skewness});
    return list;
}

QualityScale quality_scale(MeasureSource& table, const Progress& progress) {
    const QualityMeasures& original = table.original();
    const QualityMeasures& strong = table.strong(progress);
    const bool lessens = strong.curvature_abs < original.curvature_abs;
    return {original.curvature_abs, lessens ? strong.curvature_abs : 0.0,
            strong.error,           strong.volume - original.volume,
            original.volume,        original.triangles,
            table.strong_name()};
}

ScaledQuality scaled_quality(const QualityScale& scale, const QualityMeasures& measures) {
    const double whole = scale.curvature_abs - scale.curvature_zero;
    return {whole != 0.0 ? (measures.curvature_abs - scale.curvature_zero) / whole : 1.0,
            share(measures.error, scale.error),
            share(measures.volume - scale.original_volume, scale.volume),
            share(measures.triangles, scale.triangles), measures.skewness};
}

QualityCurve quality_curve(ParameterSearch& search, std::size_t parameter,
                           const ParameterSet& current, CurveValues which,
                           const Progress& progress) {
    const SearchParameter& asked = search.space().parameters.at(parameter);
    QualityCurve curve{.name = asked.name,
                       .unit = asked.unit,
                       .current = current[parameter],
                       .suggested = current[parameter],
                       .least = std::min(asked.values.front(), current[parameter]),
                       .most = std::max(asked.values.back(), current[parameter])};
    const std::vector<ParameterSet> sets = sets_of(search, parameter, current, which);
    MeasureSource& table = search.table();
    const QualityScale scale = quality_scale(table, progress);
    table.find(sets, progress);
    const ScoreBase base{table.original(), table.mean_edge(), search.settings().volume_weight};
    for (const ParameterSet& set : sets) {
        CurvePoint point{.value = set[parameter], .measures = table.at(set, progress)};
        if (point.measures) {
            point.scaled = scaled_quality(scale, *point.measures);
            point.score = score(score_terms(base, *point.measures, search.settings().form),
                                search.settings().tau);
        }
        curve.points.push_back(point);
    }
    // What is known so far may have no usable value yet.
    if (which != CurveValues::Known || std::ranges::any_of(curve.points, is_usable))
        curve.suggested = search.best_of(sets, progress).values[parameter];
    return curve;
}

SensitivityAnalysis sensitivity(ParameterSearch& search, const ParameterSet& current,
                                CurveValues which, const Progress& progress) {
    SensitivityAnalysis analysis{.scale = quality_scale(search.table(), progress)};
    const std::size_t count = search.space().parameters.size();
    for (std::size_t i = 0; i < count; ++i) {
        const double done = static_cast<double>(i) / static_cast<double>(count);
        const Progress part = progress.part(done, done + 1.0 / static_cast<double>(count));
        part.report(0.0, "measuring");
        analysis.curves.push_back(quality_curve(search, i, current, which, part));
    }
    return analysis;
}

std::vector<QualityBar> quality_bars(const SensitivityAnalysis& analysis, BarOrder order) {
    std::vector<QualityBar> bars;
    const std::vector<QualityMeasure> measures = measures_of(analysis.scale);
    const auto add = [&](std::size_t curve, QualityMeasure measure) {
        QualityBar bar{curve, measure, {}};
        for (const CurvePoint& point : analysis.curves[curve].points)
            bar.goodness.push_back(goodness_of(point, measure));
        bars.push_back(std::move(bar));
    };
    if (order == BarOrder::Parameter)
        for (std::size_t i = 0; i < analysis.curves.size(); ++i)
            for (const QualityMeasure measure : measures) add(i, measure);
    else
        for (const QualityMeasure measure : measures)
            for (std::size_t i = 0; i < analysis.curves.size(); ++i) add(i, measure);
    return bars;
}

}  // namespace vesselbench
