#include "workbench/report/quality_graph.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace vesselbench {

namespace {

constexpr std::array<MeasureLook, 5> kLooks = {
    {{QualityMeasure::Curvature, "curvature", 0x1B6CA8, 0x5B9BE0, ""},
     {QualityMeasure::Error, "error", 0xC8442B, 0xE8806E, "7 3"},
     {QualityMeasure::Volume, "volume change", 0x2E8B57, 0x5FB87A, "2 3"},
     {QualityMeasure::Triangles, "triangles", 0x7A6A00, 0xD2B04C, "10 3 2 3"},
     {QualityMeasure::Skewness, "skewness", 0x6B4FA0, 0xA9A3D8, "12 4"}}};

/// A step of 1, 2 or 5 times a power of ten that yields about `wanted` steps.
double round_step(double range, int wanted) {
    const double rough = range / wanted;
    const double power = std::pow(10.0, std::floor(std::log10(rough)));
    for (const double factor : {1.0, 2.0, 5.0})
        if (factor * power >= 0.999 * rough) return factor * power;
    return 10.0 * power;
}

}  // namespace

std::vector<MeasureLook> looks_of(const std::vector<QualityMeasure>& measures) {
    std::vector<MeasureLook> looks;
    for (const MeasureLook& look : kLooks)
        if (std::ranges::count(measures, look.measure) > 0) looks.push_back(look);
    return looks;
}

double GraphFrame::x(double value) const {
    const double share = to > from ? (value - from) / (to - from) : 0.5;
    return left + width * std::clamp(share, 0.0, 1.0);
}

double GraphFrame::value(double x) const {
    return from + (to - from) * (width > 0.0 ? std::clamp((x - left) / width, 0.0, 1.0) : 0.0);
}

double GraphFrame::y(double share) const {
    return top + height * (1.0 - std::clamp(share / high, 0.0, 1.0));
}

std::vector<std::vector<GraphPoint>> graph_lines(
    const QualityCurve& curve, const GraphFrame& frame,
    const std::function<double(const CurvePoint&)>& share) {
    std::vector<std::vector<GraphPoint>> lines;
    bool ended = true;
    for (const CurvePoint& point : curve.points) {
        if (!point.measures) {
            ended = true;
            continue;
        }
        if (std::exchange(ended, false)) lines.emplace_back();
        lines.back().push_back({frame.x(point.value), frame.y(share(point))});
    }
    return lines;
}

std::vector<BarField> bar_fields(const QualityCurve& curve, const QualityBar& bar,
                                 const GraphFrame& frame) {
    std::vector<BarField> fields;
    const auto& points = curve.points;
    for (std::size_t i = 0; i < points.size(); ++i) {
        BarField field{.left = fields.empty() ? frame.left : fields.back().right,
                       .right = i + 1 == points.size()
                                    ? frame.right()
                                    : frame.x(0.5 * (points[i].value + points[i + 1].value)),
                       .colour = std::nullopt};
        if (!std::isnan(bar.goodness[i]))
            field.colour = pixel_colour(heated_colour(bar.goodness[i]));
        fields.push_back(field);
    }
    return fields;
}

std::array<GraphPoint, 3> suggestion_mark(GraphPoint tip, double half_width, double height) {
    return {tip, {tip.x - half_width, tip.y + height}, {tip.x + half_width, tip.y + height}};
}

std::vector<double> axis_ticks(double from, double to, int wanted) {
    std::vector<double> list;
    if (!(to > from)) return {from};
    const double step = round_step(to - from, wanted);
    for (double at = std::ceil(from / step - 1e-9) * step; at <= to + 1e-9 * step; at += step)
        list.push_back(std::abs(at) < 1e-9 * step ? 0.0 : at);
    return list;
}

}  // namespace vesselbench
