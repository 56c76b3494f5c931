#include "workbench/flow/flow_watch.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>

namespace vesselbench {

namespace {

/// As most runs take; the estimate until their own figures tell.
constexpr double kUsualIterations = 150.0;
/// The iterations at the end by which the fall of residuals is estimated.
constexpr std::size_t kTrend = 20;

/// Largest minus least of the last values; infinite with a value that is not finite.
double range_of(std::span<const double> values) {
    if (!std::ranges::all_of(values, [](double x) { return std::isfinite(x); }))
        return std::numeric_limits<double>::infinity();
    const auto [least, most] = std::ranges::minmax(values);
    return most - least;
}

/// The largest residual of an iteration.
double residual_at(const FlowHistory& history, std::size_t row) {
    double largest = 0.0;
    for (const auto& [equation, values] : history.residuals)
        largest = std::isfinite(values[row]) ? std::max(largest, values[row])
                                             : std::numeric_limits<double>::infinity();
    return largest;
}

double change_over(const FlowHistory& history, const FlowRecord& record, std::size_t window) {
    const auto change = [&](const FlowSeries& series, double scale) {
        const double range = range_of(std::span(series).last(window));
        return range > 0.0 ? range / std::abs(scale) : 0.0;
    };
    double largest = change(history.wall_shear, history.wall_shear.back());
    const double drop = pressure_drop(history, record), inflow = total_inflow(history, record);
    for (const auto& [name, series] : history.pressures)
        largest = std::max(largest, change(series, drop));
    for (const auto& [name, series] : history.flows)
        largest = std::max(largest, change(series, inflow));
    return largest;
}

/// Iterations until the residual falls to the limit, at the pace of the last ones.
double iterations_to(const FlowHistory& history, double residual, double limit) {
    const std::size_t count = history.iterations.size();
    if (residual <= limit) return 0.0;
    if (count <= kTrend) return kUsualIterations;
    const double before = residual_at(history, count - 1 - kTrend);
    const double pace = std::log(before / residual) / static_cast<double>(kTrend);
    return pace > 0.0 ? std::min(std::log(residual / limit) / pace, 10.0 * kUsualIterations)
                      : kUsualIterations;
}

}  // namespace

double counted_value(const FlowSeries& series, const FlowRecord& record) {
    const auto last = std::span(series).last(std::min(series.size(), record.counted_steps()));
    return std::accumulate(last.begin(), last.end(), 0.0) / static_cast<double>(last.size());
}

double pressure_drop(const FlowHistory& history, const FlowRecord& record) {
    double highest = 0.0, lowest = 0.0;
    if (history.iterations.empty()) return 0.0;
    for (const RecordedOpening& opening : record.openings) {
        const double pressure = counted_value(history.pressures.at(opening.name), record);
        highest = std::max(highest, pressure);
        lowest = std::min(lowest, pressure);
    }
    return highest - lowest;
}

double total_inflow(const FlowHistory& history, const FlowRecord& record) {
    double inflow = 0.0;
    if (history.iterations.empty()) return 0.0;
    for (const RecordedOpening& opening : record.openings)
        if (opening.kind == PatchKind::Inlet)
            inflow -= counted_value(history.flows.at(opening.name), record);
    return inflow;
}

Settling settling_of(const FlowHistory& history, const FlowRecord& record,
                     const SettlingLimits& limits) {
    const std::size_t count = history.iterations.size();
    const auto window = static_cast<std::size_t>(limits.window);
    Settling found{.remaining = kUsualIterations};
    if (count == 0) return found;
    found.residual = residual_at(history, count - 1);
    if (count >= window) found.change = change_over(history, record, window);
    found.settled =
        count >= window && found.change < limits.change && found.residual < limits.residual;
    // Figures rest about a window after the residuals have fallen.
    const double begun = static_cast<double>(std::min(count, window));
    found.remaining = found.settled
                          ? 0.0
                          : std::max({iterations_to(history, found.residual, limits.residual),
                                      static_cast<double>(window) - begun,
                                      found.change < limits.change ? 1.0 : 0.2 * kUsualIterations});
    return found;
}

}  // namespace vesselbench
