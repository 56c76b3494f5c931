#include "geometry/formats/length_unit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

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

/// Ranges for models of vessels [mm]: typical radius from an intracranial artery to an atrium, the
/// thinnest lumen resolved by images, the widest valve of a heart, the extent from the smallest
/// excerpt to a whole body.
constexpr double kSmallestRadius = 1.3;
constexpr double kLargestRadius = 20.0;
/// Of what is longer than kSlender of its radii, and therefore no chamber or excerpt.
constexpr double kLargestTube = 14.0;
constexpr double kSlender = 8.0;
constexpr double kThinnestOpening = 0.5;
constexpr double kWidestOpening = 25.0;
constexpr double kSmallestExtent = 6.0;
constexpr double kLargestExtent = 1000.0;
/// What is larger is no vessel: such a reading loses against any other (in natural logarithms).
constexpr double kNoVessel = 20.0;
/// Root of the wall's area: a heart, or both lungs' arteries, have 0.1 m^2.
constexpr double kLargestSide = 450.0;

/// Another unit than the usual one, mm in most files, is considered only for an implausibility (in
/// natural logarithms) above this one; below kCertain the guess counts as uncertain.
constexpr double kInFavourOfUsual = 0.4;
constexpr double kCertain = 0.45;

/// Above this ratio of extent to radius the volume is meaningless (scattered or reversed
/// triangles).
constexpr double kSlimmestTree = 400.0;

struct Figures {
    double extent = 0.0;
    double side = 0.0;  ///< root of the area
    double radius = 0.0;
    double opening = 0.0;  ///< radius of the smallest round opening; 0: none
    double mouth = 0.0;    ///< of the largest one
};

double too_small(double value, double limit) {
    return value > 0.0 && value < limit ? std::log(limit / value) : 0.0;
}

double too_large(double value, double limit) {
    return value > limit ? std::log(value / limit) : 0.0;
}

/// Area and length of a loop: its equivalent radius if it is round, else 0.
double round_radius(const Positions& points, const std::vector<VertexId>& loop) {
    constexpr std::size_t kFewestEdges = 8;
    constexpr double kRound = 0.7;  // isoperimetric ratio [-]
    if (loop.size() < kFewestEdges) return 0.0;
    Vec3 normal = Vec3::Zero();
    double length = 0.0;
    for (std::size_t i = 0; i < loop.size(); ++i) {
        const Vec3 &a = points[loop[i]], &b = points[loop[(i + 1) % loop.size()]];
        normal += 0.5 * (a - points[loop[0]]).cross(b - points[loop[0]]);
        length += (b - a).norm();
    }
    const double enclosed = normal.norm();
    if (4.0 * std::numbers::pi * enclosed < kRound * length * length) return 0.0;
    return std::sqrt(enclosed / std::numbers::pi);
}

Figures figures_of(const Surface& surface) {
    Figures figures;
    figures.extent = bounds(surface).diagonal();
    const double surface_area = area(surface);
    figures.side = std::sqrt(surface_area);
    if (surface_area > 0.0) figures.radius = 2.0 * std::abs(volume(surface)) / surface_area;
    if (figures.extent > kSlimmestTree * figures.radius) figures.radius = 0.0;
    for (const auto& loop : surface.topology->boundary_loops()) {
        const double radius = round_radius(surface.points(), loop);
        if (radius > 0.0 && (figures.opening == 0.0 || radius < figures.opening))
            figures.opening = radius;
        figures.mouth = std::max(figures.mouth, radius);
    }
    return figures;
}

/// 0: like a vessel; above: deviation in natural logarithms.
double implausibility(const Figures& figures, double factor) {
    const bool slender = figures.extent > kSlender * figures.radius;
    return too_small(factor * figures.radius, kSmallestRadius) +
           too_large(factor * figures.radius, slender ? kLargestTube : kLargestRadius) +
           too_small(factor * figures.opening, kThinnestOpening) +
           too_large(factor * figures.mouth, kWidestOpening) +
           too_small(factor * figures.extent, kSmallestExtent) +
           too_large(factor * figures.extent, kLargestExtent) +
           (factor * figures.extent > kLargestExtent ? kNoVessel : 0.0) +
           too_large(factor * figures.side, kLargestSide);
}

std::string reading_text(const Figures& figures, LengthUnit unit) {
    const double factor = millimetres_per(unit);
    const std::string text =
        "in " + to_string(unit) + " it is " + formatted(factor * figures.extent) + " mm long";
    if (figures.radius == 0.0) return text;
    return text + " with a typical radius of " + formatted(factor * figures.radius) + " mm";
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
    return extent >= kSmallestExcerpt && extent <= kLargestExtent;
}

UnitGuess guess_length_unit(const Surface& surface, LengthUnit usual) {
    const Figures figures = figures_of(surface);
    std::array<double, kUnits.size()> off{};
    for (std::size_t i = 0; i < kUnits.size(); ++i)
        off[i] = implausibility(figures, millimetres_per(kUnits[i])) +
                 (kUnits[i] == usual ? 0.0 : kInFavourOfUsual);
    const auto best =
        static_cast<std::size_t>(std::min_element(off.begin(), off.end()) - off.begin());
    std::size_t next = best == 0 ? 1 : 0;
    for (std::size_t i = 0; i < off.size(); ++i)
        if (i != best && off[i] < off[next]) next = i;
    const std::string reading = reading_text(figures, kUnits[best]);
    const bool near = off[next] - off[best] < kCertain;
    return {kUnits[best], "guessed from the size: " + reading,
            near ? reading + ", " + reading_text(figures, kUnits[next]) : ""};
}

}  // namespace vesselbench
