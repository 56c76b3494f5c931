#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "gpu/colours.h"
#include "smoothing/quality/sensitivity.h"

namespace vesselbench {

/// How a measure is drawn; colours are distinguishable for the colour-blind, dashes in print.
struct MeasureLook {
    QualityMeasure measure = QualityMeasure::Curvature;
    const char* name = "";      ///< "volume change"
    std::uint32_t colour = 0;   ///< 0xRRGGBB on light ground
    std::uint32_t on_dark = 0;  ///< the same on dark ground
    const char* dashes = "";    ///< lengths of dashes and gaps, as SVG has them; empty: solid
};

/// Those of some measures, in the order in which they are drawn.
[[nodiscard]] std::vector<MeasureLook> looks_of(const std::vector<QualityMeasure>& measures);

/// A place on a page whose y axis points down, in the page's unit.
struct GraphPoint {
    double x = 0.0, y = 0.0;
};

/// A graph or a bar: its rectangle on the page and what its axes show.
struct GraphFrame {
    double left = 0.0, top = 0.0, width = 0.0, height = 0.0;
    double from = 0.0, to = 0.0;  ///< the parameter's values at the left and right side
    double high = 1.0;            ///< a measure's share at the top; 0 is at the bottom [-]

    [[nodiscard]] double right() const { return left + width; }

    [[nodiscard]] double bottom() const { return top + height; }

    [[nodiscard]] double x(double value) const;  ///< values beyond the axis lie at its ends
    [[nodiscard]] double value(double x) const;  ///< the inverse
    [[nodiscard]] double y(double share) const;  ///< shares beyond the axis lie at its ends
};

/// The lines of a measure: a curve is interrupted at values without measures.
/// \param share of a measure at a point of the curve [-]
[[nodiscard]] std::vector<std::vector<GraphPoint>> graph_lines(
    const QualityCurve& curve, const GraphFrame& frame,
    const std::function<double(const CurvePoint&)>& share);

/// The field of a value in a bar.
struct BarField {
    double left = 0.0, right = 0.0;
    std::optional<PixelColour> colour;  ///< brighter is better; none: the value is left out
};

/// They meet half-way between values, and fill the frame.
[[nodiscard]] std::vector<BarField> bar_fields(const QualityCurve& curve, const QualityBar& bar,
                                               const GraphFrame& frame);

/// A triangle that points up to a suggested value.
/// \return the tip and the two corners below it
[[nodiscard]] std::array<GraphPoint, 3> suggestion_mark(GraphPoint tip, double half_width,
                                                        double height);

/// Round values from one end to the other, about as many as wanted.
[[nodiscard]] std::vector<double> axis_ticks(double from, double to, int wanted);

}  // namespace vesselbench
