#include "workbench/report/quality_svg.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <sstream>

#include "geometry/kernel/wording.h"
#include "gpu/picture.h"

namespace vesselbench {

namespace {

/// How a measure is drawn; colours are distinguishable for the colour-blind, dashes in print.
struct Look {
    QualityMeasure measure;
    const char* name;
    const char* colour;
    const char* dashes;
};

constexpr std::array<Look, 5> kLooks = {
    {{QualityMeasure::Curvature, "curvature", "#1b6ca8", ""},
     {QualityMeasure::Error, "error", "#c8442b", "7 3"},
     {QualityMeasure::Volume, "volume change", "#2e8b57", "2 3"},
     {QualityMeasure::Triangles, "triangles", "#7a6a00", "10 3 2 3"},
     {QualityMeasure::Skewness, "skewness", "#6b4fa0", "12 4"}}};

/// Styles of the measures that change.
std::vector<Look> looks_of(const QualityScale& scale) {
    const std::vector<QualityMeasure> measures = measures_of(scale);
    std::vector<Look> looks;
    for (const Look& look : kLooks)
        if (std::ranges::find(measures, look.measure) != measures.end()) looks.push_back(look);
    return looks;
}

constexpr double kMostShown = 2.0;  // of a graph's measures, relative to 100 %

constexpr const char* kInk = "#222";
constexpr const char* kFaint = "#d9d9d9";

std::string coordinate(double value) {
    return formatted(value, "%.1f");
}

/// An SVG document under construction.
class Drawing {
public:
    Drawing(double width, double height) {
        out_ << "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" << width << "\" height=\""
             << height << "\" viewBox=\"0 0 " << width << ' ' << height
             << "\" font-family=\"Helvetica, Arial, sans-serif\" font-size=\"12\" fill=\"" << kInk
             << "\">\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n";
    }

    void text(double x, double y, const std::string& words, const std::string& more = "") {
        out_ << "<text x=\"" << coordinate(x) << "\" y=\"" << coordinate(y) << "\" " << more << ">"
             << xml_escaped(words) << "</text>\n";
    }

    void line(double x1, double y1, double x2, double y2, const std::string& look) {
        out_ << "<line x1=\"" << coordinate(x1) << "\" y1=\"" << coordinate(y1) << "\" x2=\""
             << coordinate(x2) << "\" y2=\"" << coordinate(y2) << "\" " << look << "/>\n";
    }

    /// \param crisp without antialiasing, for adjacent fields
    void box(double x, double y, double width, double height, const std::string& look,
             bool crisp = false) {
        out_ << "<rect x=\"" << coordinate(x) << "\" y=\"" << coordinate(y) << "\" width=\""
             << coordinate(width) << "\" height=\"" << coordinate(height) << "\" " << look
             << (crisp ? " shape-rendering=\"crispEdges\"" : "") << "/>\n";
    }

    void curve(const std::string& points, const std::string& look) {
        out_ << "<polyline points=\"" << points << "\" fill=\"none\" " << look << "/>\n";
    }

    /// A triangle whose tip is at x, y.
    void mark(double x, double y, bool down, const std::string& look) {
        const double back = down ? y - 9 : y + 9;
        out_ << "<polygon points=\"" << coordinate(x) << ',' << coordinate(y) << ' '
             << coordinate(x - 5) << ',' << coordinate(back) << ' ' << coordinate(x + 5) << ','
             << coordinate(back) << "\" " << look << "/>\n";
    }

    [[nodiscard]] std::string finished() const { return out_.str() + "</svg>\n"; }

private:
    std::ostringstream out_;
};

std::string stroke(const char* colour, double width, const std::string& dashes = "") {
    return std::string("stroke=\"") + colour + "\" stroke-width=\"" + coordinate(width) + "\"" +
           (dashes.empty() ? "" : " stroke-dasharray=\"" + dashes + "\"");
}

std::string axis_title(const QualityCurve& curve) {
    return curve.name + (curve.unit.empty() ? "" : " [" + curve.unit + "]");
}

/// A step of 1, 2 or 5 times a power of ten that yields about `wanted` steps.
double round_step(double range, int wanted) {
    const double rough = range / wanted;
    const double power = std::pow(10.0, std::floor(std::log10(rough)));
    for (const double factor : {1.0, 2.0, 5.0})
        if (factor * power >= 0.999 * rough) return factor * power;
    return 10.0 * power;
}

std::vector<double> ticks(double from, double to, int wanted) {
    std::vector<double> list;
    if (!(to > from)) return {from};
    const double step = round_step(to - from, wanted);
    for (double at = std::ceil(from / step - 1e-9) * step; at <= to + 1e-9 * step; at += step)
        list.push_back(std::abs(at) < 1e-9 * step ? 0.0 : at);
    return list;
}

void add_head(Drawing& drawing, const QualityTitle& title, const std::string& what) {
    drawing.text(20, 26, what + ": " + title.source, "font-size=\"16\" font-weight=\"bold\"");
    drawing.text(20, 46, title.change + "; one parameter varies, the others are fixed");
}

/// The meaning of 100 % for each measure.
std::string whole_text(const QualityScale& scale, QualityMeasure measure) {
    switch (measure) {
        case QualityMeasure::Curvature:
            return "integral of |H|, 100 % = original (" + formatted(scale.curvature_abs) + " mm)" +
                   (scale.curvature_zero > 0.0
                        ? ", 0 % = strong change (" + formatted(scale.curvature_zero) + " mm)"
                        : "");
        case QualityMeasure::Error:
            return "mean distance from the original, 100 % = strong change (" +
                   formatted(scale.error) + " mm)";
        case QualityMeasure::Volume:
            return "100 % = strong change (" +
                   formatted(scale.original_volume != 0.0
                                 ? 100.0 * scale.volume / scale.original_volume
                                 : 0.0) +
                   " % of the volume)";
        case QualityMeasure::Triangles:
            return "number, 100 % = original (" + std::to_string(std::llround(scale.triangles)) +
                   ")";
        case QualityMeasure::Skewness:
            return "mean equiangle skewness, 0 % = all triangles equilateral";
    }
    return "";
}

/// Lower edge of a legend that starts at y.
double add_legend(Drawing& drawing, const SensitivityAnalysis& analysis, const QualityTitle& title,
                  double y) {
    for (const Look& look : looks_of(analysis.scale)) {
        drawing.line(20, y - 4, 56, y - 4, stroke(look.colour, 2.2, look.dashes));
        drawing.text(64, y, look.name, "font-weight=\"bold\"");
        drawing.text(170, y, whole_text(analysis.scale, look.measure));
        y += 18;
    }
    drawing.line(38, y - 12, 38, y + 2, stroke(kInk, 1.4, "4 3"));
    drawing.text(64, y, "current value");
    drawing.mark(176, y - 8, false, "fill=\"#8a2be2\"");
    drawing.text(190, y, "suggested, others fixed (tau " + formatted(title.tau) + ")");
    drawing.text(20, y + 20,
                 "strong change: " + analysis.scale.strong + "; values above " +
                     formatted(100.0 * kMostShown) + " % are drawn at the upper edge",
                 "fill=\"#666\"");
    return y + 26;
}

/// One panel: maps values to the paper.
struct Panel {
    double left, top, width, height;
    double from, to, high;

    [[nodiscard]] double x(double value) const {
        return to > from ? left + width * (value - from) / (to - from) : left + width / 2;
    }

    [[nodiscard]] double y(double share) const { return top + height * (1.0 - share / high); }
};

void add_grid(Drawing& drawing, const Panel& panel, const QualityCurve& curve, bool with_labels) {
    for (const double share : ticks(0.0, panel.high, 6)) {
        drawing.line(panel.left, panel.y(share), panel.left + panel.width, panel.y(share),
                     stroke(kFaint, 1));
        if (with_labels)
            drawing.text(panel.left - 8, panel.y(share) + 4, formatted(100.0 * share, "%.4g"),
                         "text-anchor=\"end\"");
    }
    for (const double value : ticks(panel.from, panel.to, 5)) {
        drawing.line(panel.x(value), panel.top + panel.height, panel.x(value),
                     panel.top + panel.height + 5, stroke(kInk, 1));
        drawing.text(panel.x(value), panel.top + panel.height + 30, formatted(value),
                     "text-anchor=\"middle\"");
    }
    drawing.box(panel.left, panel.top, panel.width, panel.height,
                "fill=\"none\" " + stroke(kInk, 1));
    drawing.text(panel.left + panel.width / 2, panel.top + panel.height + 50, axis_title(curve),
                 "text-anchor=\"middle\" font-weight=\"bold\"");
}

void add_curves(Drawing& drawing, const Panel& panel, const QualityCurve& curve,
                const std::vector<Look>& looks) {
    for (const Look& look : looks) {
        std::string points;
        const auto finish = [&] {
            if (!points.empty()) drawing.curve(points, stroke(look.colour, 2.2, look.dashes));
            points.clear();
        };
        for (const CurvePoint& point : curve.points) {
            if (!point.measures) {
                finish();
                continue;
            }
            points +=
                coordinate(panel.x(point.value)) + ',' +
                coordinate(panel.y(std::clamp(point.scaled.of(look.measure), 0.0, panel.high))) +
                ' ';
        }
        finish();
    }
    drawing.line(panel.x(curve.current), panel.top, panel.x(curve.current),
                 panel.top + panel.height, stroke(kInk, 1.4, "4 3"));
    drawing.mark(panel.x(curve.suggested), panel.top + panel.height + 6, false, "fill=\"#8a2be2\"");
}

/// Top of the percent axis, the same for all panels.
double highest_share(const SensitivityAnalysis& analysis) {
    double high = 1.0;
    const std::vector<QualityMeasure> measures = measures_of(analysis.scale);
    for (const QualityCurve& curve : analysis.curves)
        for (const CurvePoint& point : curve.points)
            if (point.measures)
                for (const QualityMeasure measure : measures)
                    high = std::max(high, point.scaled.of(measure));
    return std::min(high * 1.04,
                    kMostShown);  // beyond twice the strong change, figures are irrelevant
}

std::string colour_text(const Colour& linear) {
    char text[8];
    const auto [red, green, blue] = pixel_colour(linear);
    std::snprintf(text, sizeof text, "#%02x%02x%02x", red, green, blue);
    return text;
}

void add_bar(Drawing& drawing, const QualityCurve& curve, const QualityBar& bar, const Panel& at) {
    const auto& points = curve.points;
    const auto edge = [&](std::size_t i) {  // between two values; the ends extend by half a step
        if (i == 0) return at.left;
        if (i == points.size()) return at.left + at.width;
        return at.x(0.5 * (points[i - 1].value + points[i].value));
    };
    for (std::size_t i = 0; i < points.size(); ++i) {
        const bool known = !std::isnan(bar.goodness[i]);
        drawing.box(
            edge(i), at.top, edge(i + 1) - edge(i) + 0.3, at.height,
            known
                ? "fill=\"" + colour_text(heated_colour(static_cast<float>(bar.goodness[i]))) + "\""
                : std::string("fill=\"#e8e8f4\""));
    }
    drawing.box(at.left, at.top, at.width, at.height, "fill=\"none\" " + stroke("#888", 0.8));
    const double x = std::clamp(at.x(curve.current), at.left + 4, at.left + at.width - 4);
    drawing.box(x - 4, at.top - 2, 8, at.height + 4, "fill=\"none\" " + stroke("white", 3));
    drawing.box(x - 4, at.top - 2, 8, at.height + 4, "fill=\"none\" " + stroke(kInk, 1.4, "4 2"));
    drawing.mark(at.x(curve.suggested), at.top + at.height + 1, false, "fill=\"#8a2be2\"");
}

void add_bar_axis(Drawing& drawing, const QualityCurve& curve, const Panel& at) {
    for (const double value : ticks(at.from, at.to, 5)) {
        drawing.line(at.x(value), at.top, at.x(value), at.top + 4, stroke(kInk, 1));
        drawing.text(at.x(value), at.top + 17, formatted(value), "text-anchor=\"middle\"");
    }
    drawing.text(at.left + at.width + 14, at.top + 17, axis_title(curve), "fill=\"#444\"");
}

double add_colour_scale(Drawing& drawing, double y, const QualityScale& scale) {
    for (int i = 0; i < 60; ++i)
        drawing.box(190 + 4 * i, y - 11, 4.3, 14,
                    "fill=\"" + colour_text(heated_colour(static_cast<float>(i) / 59.0F)) + "\"");
    drawing.box(190, y - 11, 240, 14, "fill=\"none\" " + stroke("#888", 0.8));
    drawing.text(182, y, "worse (100 %)", "text-anchor=\"end\"");
    drawing.text(438, y, "better (0 %)");
    y += 24;
    for (const Look& look : looks_of(scale)) {
        drawing.text(20, y, look.name, "font-weight=\"bold\"");
        drawing.text(130, y, whole_text(scale, look.measure));
        y += 18;
    }
    drawing.box(22, y - 12, 8, 16, "fill=\"none\" " + stroke(kInk, 1.4, "4 2"));
    drawing.text(40, y, "current value");
    drawing.mark(144, y - 8, false, "fill=\"#8a2be2\"");
    drawing.text(158, y, "suggested, others fixed");
    drawing.text(20, y + 20, "strong change: " + scale.strong, "fill=\"#666\"");
    return y + 30;
}

}  // namespace

std::string quality_graphs_svg(const SensitivityAnalysis& analysis, const QualityTitle& title) {
    constexpr double kWidth = 300, kHeight = 240, kGap = 34, kLeft = 70, kTop = 72;
    const auto count = static_cast<double>(analysis.curves.size());
    const double legend = 124.0 + 18.0 * static_cast<double>(measures_of(analysis.scale).size());
    Drawing drawing(std::max(kLeft + count * (kWidth + kGap), 660.0), kTop + kHeight + legend);
    add_head(drawing, title, "Model quality graphs");
    const double high = highest_share(analysis);
    for (std::size_t i = 0; i < analysis.curves.size(); ++i) {
        const QualityCurve& curve = analysis.curves[i];
        const Panel panel{kLeft + static_cast<double>(i) * (kWidth + kGap),
                          kTop,
                          kWidth,
                          kHeight,
                          curve.points.front().value,
                          curve.points.back().value,
                          high};
        add_grid(drawing, panel, curve, i == 0);
        add_curves(drawing, panel, curve, looks_of(analysis.scale));
    }
    drawing.text(22, kTop + kHeight / 2, "measure [%]",
                 "text-anchor=\"middle\" font-weight=\"bold\" transform=\"rotate(-90 22 " +
                     coordinate(kTop + kHeight / 2) + ")\"");
    add_legend(drawing, analysis, title, kTop + kHeight + 82);
    return drawing.finished();
}

std::string quality_bars_svg(const SensitivityAnalysis& analysis, const QualityTitle& title,
                             BarOrder order) {
    constexpr double kLeft = 190, kWidth = 460, kBar = 24, kStep = 38;
    const std::vector<QualityBar> bars = quality_bars(analysis, order);
    const std::size_t groups =
        order == BarOrder::Parameter ? analysis.curves.size() : measures_of(analysis.scale).size();
    const double axes = order == BarOrder::Parameter ? static_cast<double>(groups) * 26.0
                                                     : static_cast<double>(bars.size()) * 22.0;
    const double height =
        74 + static_cast<double>(bars.size()) * kStep + axes + static_cast<double>(groups) * 14;
    Drawing drawing(820,
                    height + 96.0 + 18.0 * static_cast<double>(measures_of(analysis.scale).size()));
    add_head(drawing, title, "Model quality bars");
    double y = 74;
    for (std::size_t i = 0; i < bars.size(); ++i) {
        const QualityCurve& curve = analysis.curves[bars[i].curve];
        const Panel at{
            kLeft, y, kWidth, kBar, curve.points.front().value, curve.points.back().value, 1.0};
        const auto look =
            std::ranges::find(kLooks, bars[i].measure, [](const Look& l) { return l.measure; });
        drawing.text(kLeft - 10, y + 16, std::string(look->name) + ", " + curve.name,
                     "text-anchor=\"end\"");
        add_bar(drawing, curve, bars[i], at);
        y += kStep;
        const bool last = i + 1 == bars.size() ||
                          (order == BarOrder::Parameter ? bars[i + 1].curve != bars[i].curve
                                                        : bars[i + 1].measure != bars[i].measure);
        if (last || order == BarOrder::Measure) {
            add_bar_axis(drawing, curve, {kLeft, y - 4, kWidth, 0, at.from, at.to, 1.0});
            y += order == BarOrder::Parameter ? 26 : 22;
        }
        if (last) y += 14;
    }
    add_colour_scale(drawing, y + 14, analysis.scale);
    return drawing.finished();
}

}  // namespace vesselbench
