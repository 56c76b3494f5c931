#include "workbench/batch/batch_cost.h"

#include <algorithm>
#include <cmath>

#include "geometry/kernel/amounts.h"
#include "geometry/kernel/wording.h"

namespace vesselbench {

namespace {

constexpr std::size_t kFewestForLine = 5;
constexpr double kMebibyte = 1024.0 * 1024.0;

/// A case's time over the size of its input.
struct Cost {
    double mib = 0.0, seconds = 0.0, peak_mib = 0.0;
};

/// Of those that came to an end by themselves and have a model: a refusal in the first second says
/// nothing about the others.
std::vector<Cost> costs_of(const std::vector<PlannedCase>& cases) {
    std::vector<Cost> costs;
    for (const PlannedCase& one : cases)
        if (one.record && !one.record->failure)
            costs.push_back({static_cast<double>(one.input_bytes) / kMebibyte, one.record->seconds,
                             one.record->peak_mib});
    return costs;
}

double mean_of(const std::vector<Cost>& costs, double Cost::*what) {
    double sum = 0.0;
    for (const Cost& cost : costs) sum += cost.*what;
    return sum / static_cast<double>(costs.size());
}

/// Seconds = fixed + slope x MiB.
struct Line {
    double fixed = 0.0, slope = 0.0;

    [[nodiscard]] double at(double mib) const { return fixed + slope * mib; }
};

/// Least squares; flat where larger inputs do not take longer.
Line line_through(const std::vector<Cost>& costs) {
    const double mib = mean_of(costs, &Cost::mib), seconds = mean_of(costs, &Cost::seconds);
    double together = 0.0, alone = 0.0;
    for (const Cost& cost : costs) {
        together += (cost.mib - mib) * (cost.seconds - seconds);
        alone += (cost.mib - mib) * (cost.mib - mib);
    }
    const bool is_line = costs.size() >= kFewestForLine && alone > 0.0 && together > 0.0;
    const double slope = is_line ? std::min(together / alone, seconds / mib) : 0.0;
    return {seconds - slope * mib, slope};
}

double mean_error(const Line& line, const std::vector<Cost>& costs) {
    double sum = 0.0;
    for (const Cost& cost : costs) sum += std::abs(line.at(cost.mib) - cost.seconds);
    return sum / static_cast<double>(costs.size());
}

}  // namespace

std::string cost_text(const std::vector<PlannedCase>& cases, std::size_t jobs) {
    std::vector<Cost> costs = costs_of(cases);
    if (costs.empty()) return "";
    const double seconds = mean_of(costs, &Cost::seconds);
    std::ranges::sort(costs, {}, &Cost::peak_mib);
    const std::string each = duration_text(seconds) + " a case";
    const double hourly = 3600.0 * static_cast<double>(jobs) / seconds;
    const std::string pace = jobs == 0 ? each
                                       : formatted(hourly, "%.0f cases an hour with ") +
                                             counted(jobs, "job") + " (" + each + ")";
    return "by " + counted(costs.size(), "case") + ": " + pace + ", memory " +
           mebibytes_text(costs[costs.size() / 2].peak_mib) + " a case (median), " +
           mebibytes_text(costs.back().peak_mib) + " at most";
}

std::string estimate_text(const std::vector<PlannedCase>& cases, std::size_t jobs) {
    const std::vector<Cost> costs = costs_of(cases);
    if (costs.empty()) return "";
    const Line line = line_through(costs);
    double seconds = 0.0;
    std::size_t left = 0;
    for (const PlannedCase& one : cases)
        if (!one.record) {
            seconds += line.at(static_cast<double>(one.input_bytes) / kMebibyte);
            ++left;
        }
    if (left == 0) return "";
    return counted(left, "case") + " left: about " +
           duration_text(seconds / static_cast<double>(std::max<std::size_t>(jobs, 1))) + " with " +
           counted(std::max<std::size_t>(jobs, 1), "job") + ", by the " +
           (line.slope > 0.0 ? "times and sizes" : "mean time") + " of " +
           counted(costs.size(), "finished case") +
           formatted(mean_error(line, costs), ", which it misses by %.1f s on average");
}

std::string costs_csv(const std::vector<PlannedCase>& cases) {
    std::string text = "case,seconds,peak_memory_mib,input_bytes\r\n";
    for (const PlannedCase& one : cases)
        if (one.record)
            text += one.what.name + "," + formatted(one.record->seconds, "%.2f") + "," +
                    formatted(one.record->peak_mib, "%.1f") + "," +
                    std::to_string(one.input_bytes) + "\r\n";
    return text;
}

}  // namespace vesselbench
