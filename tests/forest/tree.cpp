#include "tests/forest/tree.h"

#include <algorithm>
#include <array>

namespace vesselbench::forest {

namespace {

/// The piece of the line that holds abscissa s, and the fraction along it.
std::pair<std::size_t, double> piece_at(const Line& line, double s) {
    const std::vector<double> sums = abscissas(line);
    const auto after = std::upper_bound(sums.begin() + 1, sums.end() - 1, s);
    const auto i = static_cast<std::size_t>(after - sums.begin()) - 1;
    const double fraction = (s - sums[i]) / std::max(sums[i + 1] - sums[i], 1e-12);
    return {i, std::clamp(fraction, 0.0, 1.0)};
}

Vec3 vertex_tangent(const Line& line, std::size_t i) {
    const std::size_t before = i == 0 ? 0 : i - 1, after = std::min(i + 1, line.size() - 1);
    return (line[after].at - line[before].at).normalized();
}

}  // namespace

std::string to_string(CaseKind kind) {
    static const std::array names = {"open surface", "closed surface", "voxel surface",
                                     "mask image", "intensity image"};
    return names[static_cast<std::size_t>(kind)];
}

bool is_image(CaseKind kind) {
    return kind == CaseKind::MaskImage || kind == CaseKind::IntensityImage;
}

std::string to_string(EndKind kind) {
    static const std::array names = {"flat", "oblique", "ragged", "furcation", "rounded", "border"};
    return names[static_cast<std::size_t>(kind)];
}

std::vector<double> abscissas(const Line& line) {
    std::vector<double> sums = {0.0};
    for (std::size_t i = 1; i < line.size(); ++i)
        sums.push_back(sums.back() + (line[i].at - line[i - 1].at).norm());
    return sums;
}

LinePoint at_abscissa(const Line& line, double s) {
    const auto [i, u] = piece_at(line, s);
    const LinePoint &a = line[i], &b = line[i + 1];
    return {a.at + u * (b.at - a.at), a.radius + u * (b.radius - a.radius)};
}

Vec3 tangent_at(const Line& line, double s) {
    const auto [i, u] = piece_at(line, s);
    return ((1.0 - u) * vertex_tangent(line, i) + u * vertex_tangent(line, i + 1)).normalized();
}

double length_of(const Line& line) {
    return abscissas(line).back();
}

Line part_of(const Line& line, double s, double t) {
    constexpr double kSame = 1e-6;
    const std::vector<double> sums = abscissas(line);
    Line part = {at_abscissa(line, s)};
    for (std::size_t i = 0; i < line.size(); ++i)
        if (sums[i] > s + kSame && sums[i] < t - kSame) part.push_back(line[i]);
    part.push_back(at_abscissa(line, t));
    return part;
}

}  // namespace vesselbench::forest
