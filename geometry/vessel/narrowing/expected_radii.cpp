#include "geometry/vessel/narrowing/expected_radii.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

#include "geometry/kernel/robust.h"
#include "geometry/kernel/statistics.h"

namespace vesselbench {

namespace {

constexpr double kWindow = 20.0;     ///< length of vessel that is taken for one line [diameters]
constexpr double kTaperFrom = 4.0;   ///< a shorter vessel has one radius [diameters]
constexpr double kMostTaper = 0.05;  ///< of the radius in one diameter [-]
constexpr double kLeastScatter = 0.02, kMostScatter = 0.06;  ///< [-]; a narrowing is no scatter
constexpr int kRounds = 12;
constexpr std::size_t kFewest = 6;        ///< samples
constexpr std::size_t kMostPoints = 120;  ///< for the repeated medians, whose cost is quadratic

struct Point {
    double x, y;
};

struct Fit {
    double x0 = 0.0, y0 = 0.0, slope = 0.0, scatter = 0.0;

    [[nodiscard]] double at(double x) const { return y0 + slope * (x - x0); }
};

double repeated_median_slope(const std::vector<Point>& points) {
    std::vector<Point> chosen;
    const std::size_t step = 1 + points.size() / kMostPoints;
    for (std::size_t i = 0; i < points.size(); i += step) chosen.push_back(points[i]);
    std::vector<double> slopes;
    for (const Point& p : chosen) {
        std::vector<double> own;
        for (const Point& q : chosen)
            if (p.x != q.x) own.push_back((q.y - p.y) / (q.x - p.x));
        if (!own.empty()) slopes.push_back(median(std::move(own)));
    }
    return median(std::move(slopes));
}

std::vector<double> residuals(const std::vector<Point>& points, const Fit& fit) {
    std::vector<double> left;
    for (const Point& p : points) left.push_back(p.y - fit.at(p.x));
    return left;
}

double limited_scatter(std::vector<double> left) {
    return std::clamp(scatter_of(std::move(left)), kLeastScatter, kMostScatter);
}

/// One step of reweighted least squares. \param steepest [1/mm], at least 0
Fit reweighted(const std::vector<Point>& points, const Fit& fit, double steepest) {
    double w = 0.0, wx = 0.0, wy = 0.0, wxx = 0.0, wxy = 0.0;
    for (const Point& p : points) {
        const double weight = biweight(p.y - fit.at(p.x), kTukeyReach * fit.scatter);
        const double x = p.x - fit.x0;
        w += weight;
        wx += weight * x;
        wy += weight * p.y;
        wxx += weight * x * x;
        wxy += weight * x * p.y;
    }
    if (!(w > 0.0)) return fit;
    const double spread = wxx - wx * wx / w;
    Fit next = fit;
    next.slope = spread > 0.0 ? std::clamp((wxy - wx * wy / w) / spread, -steepest, steepest) : 0.0;
    next.x0 = fit.x0 + wx / w;
    next.y0 = wy / w;
    next.scatter = limited_scatter(residuals(points, next));
    return next;
}

Fit fitted(const std::vector<Point>& points, double diameter) {
    const double length = points.back().x - points.front().x;
    const double steepest = length < kTaperFrom * diameter ? 0.0 : kMostTaper / diameter;
    Fit fit{.x0 = points[points.size() / 2].x};
    fit.slope = std::clamp(repeated_median_slope(points), -steepest, steepest);
    fit.y0 = median(residuals(points, fit));
    fit.scatter = limited_scatter(residuals(points, fit));
    for (int round = 0; round < kRounds; ++round) fit = reweighted(points, fit, steepest);
    return fit;
}

/// The range of points in a window around x that does not reach beyond the ends.
std::pair<std::size_t, std::size_t> window_at(const std::vector<Point>& points, double x,
                                              double width) {
    const double low = std::min(x - 0.5 * width, points.back().x - width);
    const double high = std::max(low, points.front().x) + width;
    const auto first = std::ranges::lower_bound(points, low, {}, &Point::x);
    const auto last = std::ranges::upper_bound(points, high, {}, &Point::x);
    return {static_cast<std::size_t>(first - points.begin()),
            static_cast<std::size_t>(last - points.begin())};
}

}  // namespace

ExpectedRadii expected_radii(std::span<const RadiusSample> samples) {
    std::vector<Point> points;
    std::vector<double> radii;
    for (const RadiusSample& s : samples)
        if (s.counts) {
            points.push_back({s.along, std::log(s.radius)});
            radii.push_back(s.radius);
        }
    if (points.size() < kFewest) return {};
    const double diameter = 2.0 * median(std::move(radii));
    ExpectedRadii expected;
    std::optional<std::pair<std::size_t, std::size_t>> known;
    Fit fit;
    for (const RadiusSample& s : samples) {
        auto window = window_at(points, s.along, kWindow * diameter);
        if (window.second - window.first < kFewest) window = {0, points.size()};
        // A window that has hardly moved has the same line.
        const bool moved =
            !known || window.first > known->first + 3 || window.second > known->second + 3;
        if (moved) {
            fit = fitted({points.begin() + static_cast<std::ptrdiff_t>(window.first),
                          points.begin() + static_cast<std::ptrdiff_t>(window.second)},
                         diameter);
            known = window;
        }
        expected.radii.push_back(std::exp(fit.at(s.along)));
        expected.scatter.push_back(fit.scatter);
    }
    return expected;
}

}  // namespace vesselbench
