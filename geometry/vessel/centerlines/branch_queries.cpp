#include "geometry/vessel/centerlines/branch_queries.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <Eigen/Dense>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/robust.h"
#include "geometry/kernel/statistics.h"

namespace vesselbench {
namespace {

/// Segment index and fraction [0, 1] of an abscissa; the branch has at least two points.
struct SegmentPlace {
    std::size_t segment = 0;
    double fraction = 0.0;
};

SegmentPlace locate(const std::vector<double>& s, double abscissa) {
    const double clamped = std::clamp(abscissa, 0.0, s.back());
    const auto above = std::upper_bound(s.begin(), s.end(), clamped);
    const auto i = std::clamp<std::ptrdiff_t>(above - s.begin() - 1, 0,
                                              static_cast<std::ptrdiff_t>(s.size()) - 2);
    const auto k = static_cast<std::size_t>(i);
    const double length = s[k + 1] - s[k];
    return {k, length > 0.0 ? std::clamp((clamped - s[k]) / length, 0.0, 1.0) : 0.0};
}

Vec3 point_between(const CenterlineBranch& branch, const SegmentPlace& at) {
    return (1.0 - at.fraction) * branch.points[at.segment] +
           at.fraction * branch.points[at.segment + 1];
}

double radius_between(const CenterlineBranch& branch, const SegmentPlace& at) {
    return (1.0 - at.fraction) * branch.radii[at.segment] +
           at.fraction * branch.radii[at.segment + 1];
}

Vec3 chord_direction(const CenterlineBranch& branch, const SegmentPlace& at) {
    const Vec3 d = branch.points[at.segment + 1] - branch.points[at.segment];
    return d.norm() > 0.0 ? d.normalized()
                          : (branch.points.back() - branch.points.front()).normalized();
}

/// Slope at `centre` of the least-squares quadratic through the points within the window; weights
/// decrease towards the window's ends.
std::optional<Vec3> quadratic_slope(const CenterlineBranch& branch, const std::vector<double>& s,
                                    double centre, double window) {
    Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
    Eigen::Matrix3d b = Eigen::Matrix3d::Zero();
    int used = 0;
    for (std::size_t i = 0; i < s.size(); ++i) {
        const double u = (s[i] - centre) / window;
        if (std::abs(u) >= 1.0) continue;
        const double weight = biweight(u, 1.0);
        const Vec3 basis(1.0, u, u * u);
        A += weight * basis * basis.transpose();
        b += weight * basis * branch.points[i].transpose();
        ++used;
    }
    if (used < 4) return std::nullopt;
    const Eigen::Matrix3d coefficients = A.ldlt().solve(b);
    const Vec3 slope = coefficients.row(1).transpose();
    if (!(slope.norm() > 0.1 * window)) return std::nullopt;
    return slope.normalized();
}

const CenterlineNode& tip_node(const CenterlineGraph& graph, std::size_t tip) {
    if (tip >= graph.nodes.size() || !graph.nodes[tip].is_tip()) {
        throw InvalidInput("centerline node " + std::to_string(tip) +
                           " is not a tip; choose one of the tips");
    }
    return graph.nodes[tip];
}

bool starts_at(const CenterlineGraph& graph, std::size_t branch, std::size_t node) {
    const CenterlineBranch& b = graph.branches[branch];
    if (b.start_node == node) return true;
    if (b.end_node == node) return false;
    throw InvalidInput("centerline branch " + std::to_string(branch) + " does not end at node " +
                       std::to_string(node));
}

/// True if the sphere overlaps an inscribed sphere of the branch.
bool overlaps(const CenterlineBranch& branch, const Vec3& centre, double radius) {
    for (std::size_t i = 0; i < branch.points.size(); ++i) {
        const double reach = branch.radii[i] + radius;
        if ((branch.points[i] - centre).squaredNorm() < reach * reach) return true;
    }
    return false;
}

/// Arc length from a node at which a branch's spheres, with radii so many times as large, overlap
/// none of the other branches there.
double clear_of_others(const CenterlineGraph& graph, std::size_t branch, std::size_t node,
                       double scale) {
    const CenterlineBranch& own = graph.branches[branch];
    const bool from_start = starts_at(graph, branch, node);
    if (graph.nodes[node].branches.size() < 3) return 0.0;
    const auto s = abscissas(own);
    const auto meets_another = [&](std::size_t i) {
        for (const std::size_t other : graph.nodes[node].branches)
            if (other != branch &&
                overlaps(graph.branches[other], own.points[i], scale * own.radii[i]))
                return true;
        return false;
    };
    for (std::size_t k = 0; k < s.size(); ++k) {
        const std::size_t i = from_start ? k : s.size() - 1 - k;
        if (!meets_another(i)) return from_start ? s[i] : s.back() - s[i];
    }
    return s.back();
}

}  // namespace

std::vector<double> abscissas(const CenterlineBranch& branch) {
    std::vector<double> s(branch.points.size(), 0.0);
    for (std::size_t i = 1; i < s.size(); ++i) {
        s[i] = s[i - 1] + (branch.points[i] - branch.points[i - 1]).norm();
    }
    return s;
}

double branch_length(const CenterlineBranch& branch) {
    return abscissas(branch).back();
}

Vec3 point_at(const CenterlineBranch& branch, double abscissa) {
    return point_between(branch, locate(abscissas(branch), abscissa));
}

double radius_at(const CenterlineBranch& branch, double abscissa) {
    return radius_between(branch, locate(abscissas(branch), abscissa));
}

Vec3 tangent_at(const CenterlineBranch& branch, double abscissa, double window) {
    const auto s = abscissas(branch);
    const SegmentPlace at = locate(s, abscissa);
    const double start = window > 0.0 ? window : std::max(radius_between(branch, at), 1e-9);
    const double centre = std::clamp(abscissa, 0.0, s.back());
    for (double width = start; width < 8.0 * start; width *= 2.0) {
        if (const auto slope = quadratic_slope(branch, s, centre, width)) return *slope;
    }
    return chord_direction(branch, at);
}

std::optional<NearestPlace> nearest_place(const CenterlineGraph& graph, std::size_t branch,
                                          const Vec3& position) {
    std::optional<NearestPlace> best;
    const auto& points = graph.branches[branch].points;
    double s = 0.0;
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        const Vec3 d = points[i + 1] - points[i];
        const double length = d.norm();
        const double f =
            length > 0.0 ? std::clamp((position - points[i]).dot(d) / (length * length), 0.0, 1.0)
                         : 0.0;
        const double distance = (position - points[i] - f * d).norm();
        if (!best || distance < best->distance) best = {{branch, s + f * length}, distance};
        s += length;
    }
    return best;
}

std::optional<NearestPlace> nearest_place(const CenterlineGraph& graph, const Vec3& position) {
    std::optional<NearestPlace> best;
    for (std::size_t b = 0; b < graph.branches.size(); ++b) {
        const auto nearest = nearest_place(graph, b, position);
        if (nearest && (!best || nearest->distance < best->distance)) best = nearest;
    }
    return best;
}

std::size_t branch_of_tip(const CenterlineGraph& graph, std::size_t tip) {
    return tip_node(graph, tip).branches.front();
}

double tip_radius(const CenterlineGraph& graph, std::size_t tip) {
    const std::size_t b = branch_of_tip(graph, tip);
    const CenterlineBranch& branch = graph.branches[b];
    const bool from_start = starts_at(graph, b, tip);
    const auto s = abscissas(branch);
    const double widest = *std::max_element(branch.radii.begin(), branch.radii.end());
    std::vector<double> radii;
    for (std::size_t k = 0; k < s.size(); ++k) {
        const std::size_t i = from_start ? k : s.size() - 1 - k;
        const double inward = from_start ? s[i] : s.back() - s[i];
        if (inward > 2.0 * widest || inward > 0.75 * s.back()) break;
        if (inward >= 0.5 * branch.radii[i] && inward <= 2.0 * branch.radii[i]) {
            radii.push_back(branch.radii[i]);
        }
    }
    if (radii.empty()) return radius_at(branch, from_start ? 0.25 * s.back() : 0.75 * s.back());
    return median(radii);
}

std::vector<std::size_t> tips_by_radius(const CenterlineGraph& graph) {
    std::vector<std::pair<double, std::size_t>> tips;
    for (std::size_t n = 0; n < graph.nodes.size(); ++n) {
        if (graph.nodes[n].is_tip()) tips.emplace_back(-tip_radius(graph, n), n);
    }
    std::sort(tips.begin(), tips.end());
    std::vector<std::size_t> order;
    for (const auto& [radius, node] : tips) order.push_back(node);
    return order;
}

std::optional<std::size_t> nearest_tip(const CenterlineGraph& graph, const Vec3& position) {
    std::optional<std::size_t> best;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t n = 0; n < graph.nodes.size(); ++n) {
        const double distance = (graph.nodes[n].position - position).norm();
        if (!graph.nodes[n].is_tip() || distance >= least) continue;
        least = distance;
        best = n;
    }
    return best;
}

std::optional<std::size_t> tip_near(const CenterlineGraph& graph, const Vec3& position,
                                    double reach) {
    const auto tip = nearest_tip(graph, position);
    if (!tip) return std::nullopt;
    const double distance = (graph.nodes[*tip].position - position).norm();
    return distance <= reach * tip_radius(graph, *tip) ? tip : std::nullopt;
}

std::size_t other_node(const CenterlineGraph& graph, std::size_t branch, std::size_t node) {
    return starts_at(graph, branch, node) ? graph.branches[branch].end_node
                                          : graph.branches[branch].start_node;
}

std::optional<BranchPlace> inward_from_tip(const CenterlineGraph& graph, std::size_t tip,
                                           double distance) {
    const std::size_t b = branch_of_tip(graph, tip);
    if (distance > branch_length(graph.branches[b])) return std::nullopt;
    return place_from_node(graph, b, tip, distance);
}

Vec3 outward_direction(const CenterlineGraph& graph, std::size_t tip, double distance,
                       double window) {
    const std::size_t b = branch_of_tip(graph, tip);
    const BranchPlace place = place_from_node(graph, b, tip, distance);
    const Vec3 forward = tangent_at(graph.branches[b], place.abscissa, window);
    return starts_at(graph, b, tip) ? Vec3(-forward) : forward;
}

Vec3 beyond_tip(const CenterlineGraph& graph, std::size_t tip, double distance) {
    const double window = 2.0 * tip_radius(graph, tip);
    return graph.nodes[tip].position + distance * outward_direction(graph, tip, 0.0, window);
}

double distance_from_node(const CenterlineGraph& graph, const BranchPlace& place,
                          std::size_t node) {
    return starts_at(graph, place.branch, node)
               ? place.abscissa
               : branch_length(graph.branches[place.branch]) - place.abscissa;
}

BranchPlace place_from_node(const CenterlineGraph& graph, std::size_t branch, std::size_t node,
                            double distance) {
    const double length = branch_length(graph.branches[branch]);
    const double clamped = std::clamp(distance, 0.0, length);
    return {branch, starts_at(graph, branch, node) ? clamped : length - clamped};
}

double furcation_zone_end(const CenterlineGraph& graph, std::size_t branch, std::size_t node) {
    return clear_of_others(graph, branch, node, 1.0);
}

double parents_exit(const CenterlineGraph& graph, std::size_t branch, std::size_t node) {
    return clear_of_others(graph, branch, node, 0.0);
}

}  // namespace vesselbench
