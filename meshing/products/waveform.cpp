#include "meshing/products/waveform.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <optional>
#include <sstream>
#include <utility>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/wording.h"

namespace vesselbench {

namespace {

constexpr int kSyntheticSteps = 100;
constexpr std::size_t kFewestRows = 3, kMostRows = 1000;
/// Difference of the last flow from the first, relative to the largest: what rounding leaves.
constexpr double kClosing = 0.01;

std::optional<double> number_in(const std::string& word) {
    double number = 0.0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(number))
        return std::nullopt;
    return number;
}

[[noreturn]] void refuse(const std::string& name, const std::string& why) {
    throw UsageError("openfoam.waveform: " + name + " " + why);
}

void add_row(Waveform& wave, std::string line, const std::string& name, int number) {
    std::ranges::replace(line, ',', ' ');
    std::istringstream stream(line);
    std::vector<std::optional<double>> row;
    for (std::string word; stream >> word;) row.push_back(number_in(word));
    if (row.size() != 2 || !row[0] || !row[1])
        refuse(name, "line " + std::to_string(number) + " is not a time [s] and a flow [cm^3/s]");
    if (!wave.times.empty() && !(*row[0] > wave.times.back()))
        refuse(name, "line " + std::to_string(number) + ": times must increase");
    wave.times.push_back(*row[0]);
    wave.flows.push_back(*row[1]);
}

void close(Waveform& wave, const std::string& name) {
    double largest = 0.0;
    for (const double flow : wave.flows) largest = std::max(largest, std::abs(flow));
    if (std::abs(wave.flows.back() - wave.flows.front()) > kClosing * largest)
        refuse(name, "does not close: it begins with" + formatted(wave.flows.front(), " %g") +
                         " and ends with" + formatted(wave.flows.back(), " %g cm^3/s"));
    wave.flows.back() = wave.flows.front();
}

}  // namespace

double Waveform::mean() const {
    double sum = 0.0;
    for (std::size_t i = 1; i < times.size(); ++i)
        sum += 0.5 * (flows[i - 1] + flows[i]) * (times[i] - times[i - 1]);
    return sum / period();
}

Waveform synthetic_waveform(double mean) {
    struct Harmonic {
        double size, delay;
    };

    constexpr std::array kHarmonics = {Harmonic{0.5, 1.2}, Harmonic{0.25, 2.4}, Harmonic{0.1, 3.6}};
    Waveform wave{.times = {}, .flows = {}, .synthetic = true};
    for (int k = 0; k <= kSyntheticSteps; ++k) {
        const double time = k / static_cast<double>(kSyntheticSteps);
        double factor = 1.0;
        for (std::size_t n = 0; n < kHarmonics.size(); ++n)
            factor +=
                kHarmonics[n].size * std::cos(2.0 * std::numbers::pi * static_cast<double>(n + 1) *
                                                  (k % kSyntheticSteps) / kSyntheticSteps -
                                              kHarmonics[n].delay);
        wave.times.push_back(time);
        wave.flows.push_back(mean * factor);
    }
    return wave;
}

Waveform waveform_from_text(const std::string& text, const std::string& name) {
    Waveform wave;
    std::istringstream lines(text);
    int number = 0;
    for (std::string line; std::getline(lines, line);) {
        ++number;
        const std::size_t begin = line.find_first_not_of(" \t\r");
        if (begin == std::string::npos || line[begin] == '#') continue;
        add_row(wave, line, name, number);
        if (wave.times.size() > kMostRows)
            refuse(name, "has more than " + std::to_string(kMostRows) + " rows");
    }
    if (wave.times.size() < kFewestRows)
        refuse(name, "has fewer than " + std::to_string(kFewestRows) + " rows");
    const double first = wave.times.front();
    for (double& time : wave.times) time -= first;
    close(wave, name);
    if (!(wave.mean() > 0.0)) refuse(name, "has no mean flow above 0");
    return wave;
}

}  // namespace vesselbench
