#include "geometry/formats/length_unit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>
#include <utility>

#include "geometry/formats/vessel_size.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/measure.h"
#include "geometry/kernel/wording.h"

namespace vesselbench {

namespace {

constexpr std::array kUnits = {LengthUnit::Millimetre, LengthUnit::Centimetre, LengthUnit::Metre,
                               LengthUnit::Micrometre};

/// What files call them, beside their symbols; the micro sign and the Greek letter look alike.
constexpr std::pair<std::string_view, LengthUnit> kNames[] = {
    {"millimeter", LengthUnit::Millimetre}, {"millimetre", LengthUnit::Millimetre},
    {"centimeter", LengthUnit::Centimetre}, {"centimetre", LengthUnit::Centimetre},
    {"meter", LengthUnit::Metre},           {"metre", LengthUnit::Metre},
    {"micrometer", LengthUnit::Micrometre}, {"micrometre", LengthUnit::Micrometre},
    {"micron", LengthUnit::Micrometre},     {"\xc2\xb5m", LengthUnit::Micrometre},
    {"\xce\xbcm", LengthUnit::Micrometre}};

/// Shares of the files that state no unit [-]: of the usual one, of the next likely ones, and of
/// micrometres, which microscopes write.
constexpr double kUsualShare = 0.85;
constexpr double kOtherShares[] = {0.10, 0.05};
constexpr double kMicrometreShare = 1e-3;

/// What is less likely is asked about.
constexpr double kCertain = 0.95;

/// Before anything is known of the surface; mm come before cm, and cm before m.
std::array<double, kUnits.size()> shares(LengthUnit usual) {
    std::array<double, kUnits.size()> result{};
    std::size_t other = 0;
    for (std::size_t i = 0; i < kUnits.size(); ++i)
        result[i] = kUnits[i] == usual                    ? kUsualShare
                    : kUnits[i] == LengthUnit::Micrometre ? kMicrometreShare
                                                          : kOtherShares[other++];
    return result;
}

/// Of each unit that it is the file's.
std::array<double, kUnits.size()> odds(const VesselSize& size, LengthUnit usual) {
    std::array<double, kUnits.size()> result = shares(usual);
    for (std::size_t i = 0; i < kUnits.size(); ++i)
        result[i] = std::log(result[i]) + log_plausibility(size, millimetres_per(kUnits[i]));
    const double most = *std::ranges::max_element(result);
    double sum = 0.0;
    for (double& odd : result) sum += odd = std::exp(odd - most);
    for (double& odd : result) odd /= sum;
    return result;
}

std::string reading_text(const VesselSize& size, LengthUnit unit) {
    const double factor = millimetres_per(unit);
    const std::string text =
        "in " + to_string(unit) + " it is " + formatted(factor * size.extent) + " mm long";
    if (size.radius == 0.0) return text;
    return text + " with a typical radius of " + formatted(factor * size.radius) + " mm";
}

}  // namespace

std::string to_string(LengthUnit unit) {
    switch (unit) {
        case LengthUnit::Centimetre:
            return "cm";
        case LengthUnit::Metre:
            return "m";
        case LengthUnit::Micrometre:
            return "um";
        default:
            return "mm";
    }
}

std::optional<LengthUnit> unit_named(std::string_view name) {
    std::string lower = lower_case(name);
    for (const LengthUnit unit : kUnits)
        if (lower == to_string(unit)) return unit;
    if (lower.ends_with('s')) lower.pop_back();
    for (const auto& [known, unit] : kNames)
        if (lower == known) return unit;
    return std::nullopt;
}

LengthUnit length_unit_from(const std::string& text) {
    for (const LengthUnit unit : kUnits)
        if (text == to_string(unit)) return unit;
    throw UsageError("'" + text + "' is not a unit of length: use mm, cm, m or um");
}

double millimetres_per(LengthUnit unit) {
    switch (unit) {
        case LengthUnit::Centimetre:
            return 10.0;
        case LengthUnit::Metre:
            return 1000.0;
        case LengthUnit::Micrometre:
            return 1e-3;
        default:
            return 1.0;
    }
}

bool is_vessel_sized(const Surface& surface) {
    constexpr double kSmallestExcerpt = 1.0;  // [mm]
    const double extent = bounds(surface).diagonal();
    return extent >= kSmallestExcerpt && !is_beyond_vessels(extent);
}

UnitGuess guess_length_unit(const Surface& surface, LengthUnit usual) {
    const VesselSize size = vessel_size(surface);
    const auto likely = odds(size, usual);
    std::array<std::size_t, kUnits.size()> order{};
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, std::greater(), [&](std::size_t i) { return likely[i]; });
    const LengthUnit best = kUnits[order[0]];
    const std::string reading = reading_text(size, best);
    const bool certain = likely[order[0]] >= kCertain;
    return {best, "guessed from the size: " + reading,
            certain ? "" : reading + ", " + reading_text(size, kUnits[order[1]])};
}

}  // namespace vesselbench
