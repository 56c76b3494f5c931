#include "workbench/report/quality_svg.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <span>
#include <sstream>

#include "geometry/kernel/wording.h"
#include "workbench/report/quality_graph.h"

namespace vesselbench {

namespace {

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

    void box(double x, double y, double width, double height, const std::string& look) {
        out_ << "<rect x=\"" << coordinate(x) << "\" y=\"" << coordinate(y) << "\" width=\""
             << coordinate(width) << "\" height=\"" << coordinate(height) << "\" " << look
             << "/>\n";
    }

    void curve(const std::vector<GraphPoint>& points, const std::string& look) {
        out_ << "<polyline points=\"" << listed(points) << "\" fill=\"none\" " << look << "/>\n";
    }

    /// The mark of a suggested value, whose tip is at x, y.
    void mark(double x, double y) {
        out_ << "<polygon points=\"" << listed(suggestion_mark({x, y}, 5, 9))
             << "\" fill=\"#8a2be2\"/>\n";
    }

    [[nodiscard]] std::string finished() const { return out_.str() + "</svg>\n"; }

private:
    static std::string listed(std::span<const GraphPoint> points) {
        std::string text;
        for (const auto& [x, y] : points)
            text += (text.empty() ? "" : " ") + coordinate(x) + ',' + coordinate(y);
        return text;
    }

    std::ostringstream out_;
};

/// \param colour 0xRRGGBB
std::string hex(std::uint32_t colour) {
    char text[16];
    std::snprintf(text, sizeof text, "#%06x", colour);
    return text;
}

std::string hex(const PixelColour& colour) {
    return hex(colour[0] << 16 | colour[1] << 8 | colour[2]);
}

std::string stroke(const std::string& colour, double width, const std::string& dashes = "") {
    return "stroke=\"" + colour + "\" stroke-width=\"" + coordinate(width) + "\"" +
           (dashes.empty() ? "" : " stroke-dasharray=\"" + dashes + "\"");
}

std::string axis_title(const QualityCurve& curve) {
    return curve.name + (curve.unit.empty() ? "" : " [" + curve.unit + "]");
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
    for (const MeasureLook& look : looks_of(measures_of(analysis.scale))) {
        drawing.line(20, y - 4, 56, y - 4, stroke(hex(look.colour), 2.2, look.dashes));
        drawing.text(64, y, look.name, "font-weight=\"bold\"");
        drawing.text(170, y, whole_text(analysis.scale, look.measure));
        y += 18;
    }
    drawing.line(38, y - 12, 38, y + 2, stroke(kInk, 1.4, "4 3"));
    drawing.text(64, y, "current value");
    drawing.mark(176, y - 8);
    drawing.text(190, y, "suggested, others fixed (tau " + formatted(title.tau) + ")");
    drawing.text(20, y + 20,
                 "strong change: " + analysis.scale.strong + "; values above " +
                     formatted(100.0 * kMostShown) + " % are drawn at the upper edge",
                 "fill=\"#666\"");
    return y + 26;
}

void add_grid(Drawing& drawing, const GraphFrame& panel, const QualityCurve& curve,
              bool with_labels) {
    for (const double share : axis_ticks(0.0, panel.high, 6)) {
        drawing.line(panel.left, panel.y(share), panel.right(), panel.y(share), stroke(kFaint, 1));
        if (with_labels)
            drawing.text(panel.left - 8, panel.y(share) + 4, formatted(100.0 * share, "%.4g"),
                         "text-anchor=\"end\"");
    }
    for (const double value : axis_ticks(panel.from, panel.to, 5)) {
        drawing.line(panel.x(value), panel.bottom(), panel.x(value), panel.bottom() + 5,
                     stroke(kInk, 1));
        drawing.text(panel.x(value), panel.bottom() + 30, formatted(value),
                     "text-anchor=\"middle\"");
    }
    drawing.box(panel.left, panel.top, panel.width, panel.height,
                "fill=\"none\" " + stroke(kInk, 1));
    drawing.text(panel.left + panel.width / 2, panel.bottom() + 50, axis_title(curve),
                 "text-anchor=\"middle\" font-weight=\"bold\"");
}

void add_curves(Drawing& drawing, const GraphFrame& panel, const QualityCurve& curve,
                const std::vector<MeasureLook>& looks) {
    for (const MeasureLook& look : looks) {
        const auto share = [&](const CurvePoint& point) { return point.scaled.of(look.measure); };
        for (const auto& line : graph_lines(curve, panel, share))
            drawing.curve(line, stroke(hex(look.colour), 2.2, look.dashes));
    }
    drawing.line(panel.x(curve.current), panel.top, panel.x(curve.current), panel.bottom(),
                 stroke(kInk, 1.4, "4 3"));
    drawing.mark(panel.x(curve.suggested), panel.bottom() + 6);
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

void add_bar(Drawing& drawing, const QualityCurve& curve, const QualityBar& bar,
             const GraphFrame& at) {
    for (const BarField& field : bar_fields(curve, bar, at))
        drawing.box(field.left, at.top, field.right - field.left + 0.3, at.height,
                    "fill=\"" + (field.colour ? hex(*field.colour) : "#e8e8f4") + "\"");
    drawing.box(at.left, at.top, at.width, at.height, "fill=\"none\" " + stroke("#888", 0.8));
    const double x = std::clamp(at.x(curve.current), at.left + 4, at.right() - 4);
    drawing.box(x - 4, at.top - 2, 8, at.height + 4, "fill=\"none\" " + stroke("white", 3));
    drawing.box(x - 4, at.top - 2, 8, at.height + 4, "fill=\"none\" " + stroke(kInk, 1.4, "4 2"));
    drawing.mark(at.x(curve.suggested), at.bottom() + 1);
}

void add_bar_axis(Drawing& drawing, const QualityCurve& curve, const GraphFrame& at) {
    for (const double value : axis_ticks(at.from, at.to, 5)) {
        drawing.line(at.x(value), at.top, at.x(value), at.top + 4, stroke(kInk, 1));
        drawing.text(at.x(value), at.top + 17, formatted(value), "text-anchor=\"middle\"");
    }
    drawing.text(at.right() + 14, at.top + 17, axis_title(curve), "fill=\"#444\"");
}

double add_colour_scale(Drawing& drawing, double y, const QualityScale& scale) {
    for (int i = 0; i < 60; ++i)
        drawing.box(190 + 4 * i, y - 11, 4.3, 14,
                    "fill=\"" + hex(pixel_colour(heated_colour(i / 59.0))) + "\"");
    drawing.box(190, y - 11, 240, 14, "fill=\"none\" " + stroke("#888", 0.8));
    drawing.text(182, y, "worse (100 %)", "text-anchor=\"end\"");
    drawing.text(438, y, "better (0 %)");
    y += 24;
    for (const MeasureLook& look : looks_of(measures_of(scale))) {
        drawing.text(20, y, look.name, "font-weight=\"bold\"");
        drawing.text(130, y, whole_text(scale, look.measure));
        y += 18;
    }
    drawing.box(22, y - 12, 8, 16, "fill=\"none\" " + stroke(kInk, 1.4, "4 2"));
    drawing.text(40, y, "current value");
    drawing.mark(144, y - 8);
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
        const GraphFrame panel{kLeft + static_cast<double>(i) * (kWidth + kGap),
                               kTop,
                               kWidth,
                               kHeight,
                               curve.points.front().value,
                               curve.points.back().value,
                               high};
        add_grid(drawing, panel, curve, i == 0);
        add_curves(drawing, panel, curve, looks_of(measures_of(analysis.scale)));
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
        const GraphFrame at{
            kLeft, y, kWidth, kBar, curve.points.front().value, curve.points.back().value, 1.0};
        const MeasureLook look = looks_of({bars[i].measure}).front();
        drawing.text(kLeft - 10, y + 16, std::string(look.name) + ", " + curve.name,
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
