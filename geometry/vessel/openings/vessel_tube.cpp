#include "geometry/vessel/openings/vessel_tube.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "geometry/kernel/diagnosed_error.h"
#include "geometry/vessel/centerlines/branch_queries.h"

namespace vesselbench {

namespace {

/// Points of an interpolated stretch are this fraction of the radius apart.
constexpr double kSpacing = 0.1;

struct Line {
    Positions points;
    std::vector<double> radii;

    void add(const Vec3& point, double radius) {
        if (!points.empty() && (points.back() - point).norm() < 1e-9 * (1.0 + radius)) return;
        points.push_back(point);
        radii.push_back(radius);
    }
};

/// The branch's points starting at one of its nodes.
Line from_node(const CenterlineBranch& branch, std::size_t node) {
    Line line;
    for (std::size_t i = 0; i < branch.points.size(); ++i)
        line.add(branch.points[i], branch.radii[i]);
    if (branch.start_node != node) {
        std::reverse(line.points.begin(), line.points.end());
        std::reverse(line.radii.begin(), line.radii.end());
    }
    return line;
}

double length_of(const Line& line) {
    double sum = 0.0;
    for (std::size_t i = 1; i < line.points.size(); ++i)
        sum += (line.points[i] - line.points[i - 1]).norm();
    return sum;
}

/// The line without its first `cut` mm; the cut is interpolated.
Line beyond(const Line& line, double cut) {
    Line rest;
    double at = 0.0;
    for (std::size_t i = 0; i + 1 < line.points.size(); ++i) {
        const double step = (line.points[i + 1] - line.points[i]).norm();
        if (at + step > cut) {
            if (rest.points.empty()) {
                const double t = std::clamp((cut - at) / step, 0.0, 1.0);
                rest.add((1 - t) * line.points[i] + t * line.points[i + 1],
                         (1 - t) * line.radii[i] + t * line.radii[i + 1]);
            }
            rest.add(line.points[i + 1], line.radii[i + 1]);
        }
        at += step;
    }
    return rest;
}

/// Direction and slope of the radius over the first `window` mm of a line, fitted.
struct Start {
    Vec3 direction;
    double radius, radius_slope;
};

Start start_of(const Line& line, double window) {
    double s = 0.0, sum_w = 0.0, sum_s = 0.0, sum_ss = 0.0, sum_r = 0.0, sum_rs = 0.0;
    Vec3 sum_p = Vec3::Zero(), sum_ps = Vec3::Zero();
    for (std::size_t i = 0; i < line.points.size() && (s <= window || i < 3); ++i) {
        sum_w += 1.0;
        sum_s += s;
        sum_ss += s * s;
        sum_r += line.radii[i];
        sum_rs += s * line.radii[i];
        sum_p += line.points[i];
        sum_ps += s * line.points[i];
        if (i + 1 < line.points.size()) s += (line.points[i + 1] - line.points[i]).norm();
    }
    const double scale = sum_w * sum_ss - sum_s * sum_s;
    if (!(scale > 0.0)) return {Vec3::UnitX(), line.radii.front(), 0.0};
    const double slope = (sum_w * sum_rs - sum_s * sum_r) / scale;
    return {Vec3((sum_w * sum_ps - sum_s * sum_p) / scale).normalized(),
            (sum_r - slope * sum_s) / sum_w, slope};
}

/// Two lines that leave a furcation, joined by a cubic over the gaps cut from each.
Line joined(const Line& a, double gap_a, const Line& b, double gap_b) {
    const Line before = beyond(a, gap_a), after = beyond(b, gap_b);
    const double ra = before.radii.front(), rb = after.radii.front();
    const Start sa = start_of(before, ra), sb = start_of(after, rb);
    Line line;
    for (std::size_t i = before.points.size(); i-- > 0;)
        line.add(before.points[i], before.radii[i]);
    const Vec3 p = before.points.front(), q = after.points.front();
    const double span = (q - p).norm();
    const int steps = std::max(2, static_cast<int>(span / (kSpacing * std::min(ra, rb))));
    for (int k = 1; k < steps; ++k) {
        const double t = static_cast<double>(k) / steps, t2 = t * t, t3 = t2 * t;
        const Vec3 x = (2 * t3 - 3 * t2 + 1) * p - (t3 - 2 * t2 + t) * span * sa.direction +
                       (3 * t2 - 2 * t3) * q + (t3 - t2) * span * sb.direction;
        line.add(x, (1 - t) * ra + t * rb);
    }
    for (std::size_t i = 0; i < after.points.size(); ++i) line.add(after.points[i], after.radii[i]);
    return line;
}

VesselTube tube_from(Line line) {
    if (line.points.size() < 2) line.add(line.points.at(0) + 1e-6 * Vec3::UnitX(), line.radii[0]);
    const Vec3 direction = line.points[1] - line.points[0];
    int smallest = 0;
    direction.cwiseAbs().minCoeff(&smallest);
    return {std::move(line.points), std::move(line.radii), Vec3::Unit(smallest)};
}

Vec3 perpendicular(const Vec3& axis, const Vec3& tangent) {
    Vec3 result = axis - axis.dot(tangent) * tangent;
    if (result.norm() < 1e-9) {
        int smallest = 0;
        tangent.cwiseAbs().minCoeff(&smallest);
        result = tangent.cross(Vec3::Unit(smallest));
    }
    return result.normalized();
}

Line from_point(const Line& line, std::size_t first) {
    const auto skipped = static_cast<std::ptrdiff_t>(first);
    return {{line.points.begin() + skipped, line.points.end()},
            {line.radii.begin() + skipped, line.radii.end()}};
}

/// The point where a branch's line leaves the spheres of the other vessels.
struct Mouth {
    std::size_t at = 0;          ///< point of the branch's line
    double branch_radius = 0.0;  ///< [mm], the smallest within one parent's radius behind it
    double parent_radius = 0.0;  ///< [mm]
};

/// Radius of the last of the vessels' spheres that contains x, or nothing.
std::optional<double> radius_around(const std::vector<Line>& vessels, const Vec3& x) {
    std::optional<double> radius;
    for (const Line& vessel : vessels)
        for (std::size_t i = 0; i < vessel.points.size(); ++i)
            if ((vessel.points[i] - x).norm() < vessel.radii[i]) radius = vessel.radii[i];
    return radius;
}

Mouth mouth_of(const Line& own, const std::vector<Line>& others, double node_radius) {
    Mouth mouth{.parent_radius = node_radius};
    for (; mouth.at + 1 < own.points.size(); ++mouth.at) {
        const auto around = radius_around(others, own.points[mouth.at]);
        if (!around) break;
        mouth.parent_radius = *around;
    }
    mouth.branch_radius = own.radii[mouth.at];
    double along = 0.0;
    for (std::size_t i = mouth.at; i + 1 < own.points.size() && along < mouth.parent_radius; ++i) {
        mouth.branch_radius = std::min(mouth.branch_radius, own.radii[i]);
        along += (own.points[i + 1] - own.points[i]).norm();
    }
    return mouth;
}

/// Length [mm] of another vessel's line that is drawn towards the branch: as far as the branch's
/// mouth extends.
double gap_at_mouth(const Line& line, const BranchRoot& root) {
    double s = 0.0, nearest = (line.points[0] - root.mouth).norm(), at_s = 0.0;
    for (std::size_t i = 1; i < line.points.size(); ++i) {
        s += (line.points[i] - line.points[i - 1]).norm();
        if (const double d = (line.points[i] - root.mouth).norm(); d < nearest) {
            nearest = d;
            at_s = s;
        }
    }
    return std::min(at_s + root.branch_radius + 0.5 * root.parent_radius, 0.6 * length_of(line));
}

}  // namespace

VesselTube::VesselTube(Positions points, std::vector<double> radii, const Vec3& first_axis)
    : points_(std::move(points)), radii_(std::move(radii)) {
    const std::size_t n = points_.size();
    along_.assign(1, 0.0);
    for (std::size_t i = 1; i < n; ++i)
        along_.push_back(along_.back() + (points_[i] - points_[i - 1]).norm());
    for (std::size_t i = 0; i < n; ++i) {
        const Vec3 &before = points_[i == 0 ? 0 : i - 1], &after = points_[std::min(i + 1, n - 1)];
        tangents_.push_back((after - before).normalized());
    }
    axes_.push_back(perpendicular(first_axis, tangents_[0]));
    for (std::size_t i = 1; i < n; ++i) axes_.push_back(perpendicular(axes_.back(), tangents_[i]));
}

VesselTube::Place VesselTube::nearest(const Vec3& x) const {
    Place best;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i + 1 < points_.size(); ++i) {
        const Vec3 edge = points_[i + 1] - points_[i];
        const double t = std::clamp(edge.dot(x - points_[i]) / edge.squaredNorm(), 0.0, 1.0);
        const double d = (points_[i] + t * edge - x).squaredNorm();
        if (d < least) {
            least = d;
            best = {i, t};
        }
    }
    return best;
}

VesselTube::Place VesselTube::at(double along) const {
    const auto after = std::upper_bound(along_.begin() + 1, along_.end() - 1, along);
    const auto i = static_cast<std::size_t>(after - along_.begin()) - 1;
    return {i, (along - along_[i]) / (along_[i + 1] - along_[i])};
}

Vec3 VesselTube::tangent(const Place& p) const {
    return ((1.0 - p.t) * tangents_[p.segment] + p.t * tangents_[p.segment + 1]).normalized();
}

Vec3 VesselTube::axis(const Place& p) const {
    return perpendicular((1.0 - p.t) * axes_[p.segment] + p.t * axes_[p.segment + 1], tangent(p));
}

double VesselTube::radius(double along) const {
    const Place p = at(std::clamp(along, 0.0, length()));
    return (1.0 - p.t) * radii_[p.segment] + p.t * radii_[p.segment + 1];
}

TubeCoordinates VesselTube::coordinates(const Vec3& x) const {
    const Place p = nearest(x);
    const Vec3 centre = (1.0 - p.t) * points_[p.segment] + p.t * points_[p.segment + 1];
    const Vec3 first = axis(p), second = tangent(p).cross(first), out = x - centre;
    TubeCoordinates found;
    found.along = (1.0 - p.t) * along_[p.segment] + p.t * along_[p.segment + 1];
    found.angle = std::atan2(out.dot(second), out.dot(first));
    found.radius = (1.0 - p.t) * radii_[p.segment] + p.t * radii_[p.segment + 1];
    found.height = out.norm() - found.radius;
    return found;
}

Vec3 VesselTube::position(double along, double angle, double height) const {
    const Place p = at(along);
    const Vec3 centre = (1.0 - p.t) * points_[p.segment] + p.t * points_[p.segment + 1];
    const Vec3 first = axis(p), second = tangent(p).cross(first);
    return centre + (radius(along) + height) * (std::cos(angle) * first + std::sin(angle) * second);
}

VesselTube VesselTube::turned_to(const Vec3& x) const {
    const double angle = coordinates(x).angle;
    const Vec3 second = tangents_[0].cross(axes_[0]);
    return {points_, radii_, std::cos(angle) * axes_[0] + std::sin(angle) * second};
}

BranchRoot branch_root(const CenterlineGraph& graph, std::size_t tip) {
    const std::size_t index = branch_of_tip(graph, tip);
    const auto& branch = graph.branches[index];
    const std::size_t node = branch.start_node == tip ? branch.end_node : branch.start_node;
    const auto& meeting = graph.nodes[node].branches;
    std::vector<Line> others;
    for (const std::size_t b : meeting)
        if (b != index) others.push_back(from_node(graph.branches[b], node));
    if (others.size() < 2)
        throw DiagnosedFailure(
            {.code = "branch-without-parent", .place = graph.nodes[tip].position});
    const Line own = from_node(branch, node);
    const Mouth mouth = mouth_of(own, others, graph.nodes[node].radius);
    BranchRoot root{.branch = index,
                    .node = node,
                    .mouth = own.points[mouth.at],
                    .branch_radius = mouth.branch_radius,
                    .parent_radius = mouth.parent_radius,
                    .parents = {},
                    .others = {},
                    .own = tube_from(from_point(own, mouth.at))};
    const auto gap = [&](const Line& line) { return gap_at_mouth(line, root); };
    for (std::size_t i = 0; i < others.size(); ++i)
        for (std::size_t j = i + 1; j < others.size(); ++j)
            root.parents.push_back(
                tube_from(joined(others[i], gap(others[i]), others[j], gap(others[j])))
                    .turned_to(root.mouth));
    for (std::size_t b = 0; b < graph.branches.size(); ++b)
        if (b != index && std::find(meeting.begin(), meeting.end(), b) == meeting.end())
            root.others.push_back(
                tube_from(from_node(graph.branches[b], graph.branches[b].start_node)));
    return root;
}

}  // namespace vesselbench
