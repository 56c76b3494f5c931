#include "geometry/vessel/openings/branch_root.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "geometry/kernel/diagnosed_error.h"
#include "geometry/vessel/centerlines/branch_queries.h"
#include "geometry/vessel/centerlines/line_smoothing.h"

namespace vesselbench {

namespace {

/// Points of an interpolated stretch are this fraction of the radius apart.
constexpr double kSpacing = 0.1;

void add(Line& line, const Vec3& point, double radius) {
    if (!line.points.empty() && (line.points.back() - point).norm() < 1e-9 * (1.0 + radius)) return;
    line.points.push_back(point);
    line.radii.push_back(radius);
}

/// The branch's points starting at one of its nodes.
Line from_node(const CenterlineBranch& branch, std::size_t node) {
    Line line;
    for (std::size_t i = 0; i < branch.points.size(); ++i)
        add(line, branch.points[i], branch.radii[i]);
    if (branch.start_node != node) {
        std::reverse(line.points.begin(), line.points.end());
        std::reverse(line.radii.begin(), line.radii.end());
    }
    return line;
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
                add(rest, (1 - t) * line.points[i] + t * line.points[i + 1],
                    (1 - t) * line.radii[i] + t * line.radii[i + 1]);
            }
            add(rest, line.points[i + 1], line.radii[i + 1]);
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
        add(line, before.points[i], before.radii[i]);
    const Vec3 p = before.points.front(), q = after.points.front();
    const double span = (q - p).norm();
    const int steps = std::max(2, static_cast<int>(span / (kSpacing * std::min(ra, rb))));
    for (int k = 1; k < steps; ++k) {
        const double t = static_cast<double>(k) / steps, t2 = t * t, t3 = t2 * t;
        const Vec3 x = (2 * t3 - 3 * t2 + 1) * p - (t3 - 2 * t2 + t) * span * sa.direction +
                       (3 * t2 - 2 * t3) * q + (t3 - t2) * span * sb.direction;
        add(line, x, (1 - t) * ra + t * rb);
    }
    for (std::size_t i = 0; i < after.points.size(); ++i)
        add(line, after.points[i], after.radii[i]);
    return line;
}

Tube tube_from(Line line) {
    if (line.points.size() < 2) add(line, line.points.at(0) + 1e-6 * Vec3::UnitX(), line.radii[0]);
    return {std::move(line.points), std::move(line.radii)};
}

Line from_point(const Line& line, std::size_t first) {
    const auto skipped = static_cast<std::ptrdiff_t>(first);
    return {.points = {line.points.begin() + skipped, line.points.end()},
            .radii = {line.radii.begin() + skipped, line.radii.end()},
            .weights = {}};
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
    return std::min(at_s + root.branch_radius + 0.5 * root.parent_radius, 0.6 * line_length(line));
}

}  // namespace

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
