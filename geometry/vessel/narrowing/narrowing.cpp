#include "geometry/vessel/narrowing/narrowing.h"

#include <algorithm>
#include <cmath>

#include "geometry/kernel/argument_checks.h"
#include "geometry/kernel/measure.h"
#include "geometry/vessel/centerlines/branch_queries.h"
#include "geometry/vessel/narrowing/expected_radii.h"

namespace vesselbench {

namespace {

constexpr double kMeasured = 0.9;   ///< of a depth is found: sections are means along the vessel
constexpr double kEnds = 0.04;      ///< share below which a narrowing has ended [-]
constexpr double kRecovered = 0.6;  ///< of the deepest share: on both sides the wall comes back at
                                    ///< least this far; else the vessel is thinner from there on
constexpr double kLongest = 0.5;    ///< of its branch's free length [-]

double linear(const std::vector<double>& along, const std::vector<double>& values, double s) {
    const auto after = std::ranges::upper_bound(along, s);
    if (after == along.begin()) return values.front();
    if (after == along.end()) return values.back();
    const auto i = static_cast<std::size_t>(after - along.begin());
    const double t = (s - along[i - 1]) / (along[i] - along[i - 1]);
    return (1.0 - t) * values[i - 1] + t * values[i];
}

double share_at(const RadiusCourse& course, std::size_t i) {
    return 1.0 - course.found[i] / course.expected[i];
}

/// Grows with the depth in scatters of the vessel's radius.
double certainty_of(double share, double scatter) {
    const double z = -std::log(1.0 - share) / scatter;
    return 1.0 - std::exp(-z * z / 16.0);
}

Narrowing described(const RadiusCourse& course, const std::vector<WallRing>& rings,
                    std::size_t branch, std::size_t deepest) {
    Narrowing found{.branch = branch, .deepest = course.along[deepest]};
    const auto ring = std::ranges::find(rings, found.deepest, &WallRing::along);
    found.place = ring->centre;
    found.expected_radius = course.expected[deepest];
    found.found_radius = course.found[deepest];
    found.certainty = certainty_of(std::max(0.0, found.share()), course.scatter[deepest]);
    return found;
}

/// The first place from `at` on, in steps of `step`, where the narrowing has ended; the last one of
/// the course if it does not.
std::size_t end_of(const RadiusCourse& course, std::size_t at, int step) {
    const double ends = std::max(kEnds, 0.1 * share_at(course, at));
    for (;;) {
        const bool last = step < 0 ? at == 0 : at + 1 == course.along.size();
        if (last || share_at(course, at) < ends) return at;
        at = step < 0 ? at - 1 : at + 1;
    }
}

/// The narrowings of one branch.
std::vector<Narrowing> narrowings_of(const std::vector<WallRing>& rings, std::size_t branch,
                                     double least_share, double resolution) {
    const RadiusCourse course = radius_course(rings);
    std::vector<Narrowing> found;
    for (std::size_t i = 0; i < course.along.size();) {
        const double limit = kMeasured * std::max(least_share, resolution / course.expected[i]);
        if (share_at(course, i) < limit) {
            ++i;
            continue;
        }
        const std::size_t last = end_of(course, i, 1);
        std::size_t deepest = i;
        for (std::size_t k = i; k <= last; ++k)
            if (share_at(course, k) > share_at(course, deepest)) deepest = k;
        const std::size_t first = end_of(course, deepest, -1);
        const double most = kRecovered * share_at(course, deepest);
        const double length = course.along[last] - course.along[first];
        if (share_at(course, first) < most && share_at(course, last) < most &&
            length <= kLongest * (course.along.back() - course.along.front())) {
            found.push_back(described(course, rings, branch, deepest));
            found.back().from = course.along[first];
            found.back().to = course.along[last];
        }
        i = last + 1;
    }
    return found;
}

}  // namespace

double RadiusCourse::found_at(double s) const {
    return linear(along, found, s);
}

double RadiusCourse::expected_at(double s) const {
    return linear(along, expected, s);
}

RadiusCourse radius_course(const std::vector<WallRing>& rings, double from, double to) {
    RadiusCourse course;
    std::vector<RadiusSample> samples;
    for (std::size_t i = 0; i < rings.size(); ++i) {
        if (!rings[i].is_whole()) continue;
        double sum = 0.0, count = 0.0;
        for (std::size_t k = i > 0 ? i - 1 : 0; k < std::min(i + 2, rings.size()); ++k)
            if (rings[k].is_whole()) sum += rings[k].radius, count += 1.0;
        const double s = rings[i].along;
        course.along.push_back(s);
        course.found.push_back(sum / count);
        samples.push_back({s, sum / count, rings[i].aside == 0.0 && !(s >= from && s <= to)});
    }
    ExpectedRadii expected = expected_radii(samples);
    if (expected.radii.empty()) return {};
    course.expected = std::move(expected.radii);
    course.scatter = std::move(expected.scatter);
    return course;
}

std::vector<Narrowing> find_narrowings(const Surface& surface, const CenterlineGraph& graph,
                                       const NarrowingParameters& parameters,
                                       const Progress& progress) {
    require_range("least_share", parameters.least_share, 0.01, 0.99);
    require_range("resolution", parameters.resolution, 0.0, 1e9);
    const double resolution =
        parameters.resolution > 0.0 ? parameters.resolution : mean_edge_length(surface);
    std::vector<Narrowing> found;
    for (std::size_t b = 0; b < graph.branches.size(); ++b) {
        progress.report(static_cast<double>(b) / static_cast<double>(graph.branches.size()),
                        "looking for narrowings");
        const auto rings = wall_rings(surface, graph, b, progress.silent());
        const auto own = narrowings_of(rings, b, parameters.least_share, resolution);
        found.insert(found.end(), own.begin(), own.end());
    }
    std::ranges::stable_sort(found, std::ranges::greater(), &Narrowing::share);
    return found;
}

std::optional<Narrowing> narrowing_between(const std::vector<WallRing>& rings, std::size_t branch,
                                           double from, double to) {
    const RadiusCourse course = radius_course(rings, from, to);
    std::optional<std::size_t> deepest;
    for (std::size_t i = 0; i < course.along.size(); ++i)
        if (course.along[i] >= from && course.along[i] <= to &&
            (!deepest || share_at(course, i) > share_at(course, *deepest)))
            deepest = i;
    if (!deepest) return std::nullopt;
    Narrowing found = described(course, rings, branch, *deepest);
    found.from = from;
    found.to = to;
    return found;
}

}  // namespace vesselbench
