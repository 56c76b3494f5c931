#include "smoothing/context/staircases.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/parallel.h"
#include "geometry/kernel/surface.h"

namespace vesselbench {

namespace {

constexpr double kDegenerate = -1.0;

/// Eq. 5.3; kDegenerate where a face has no normal.
std::vector<double> raw_orientations(const Topology& topology, const Positions& positions,
                                     const Vec3& stack_axis) {
    const Vec3 axis = unit_axis(stack_axis);
    if (positions.size() != topology.vertex_count())
        throw InvalidInput("got " + std::to_string(positions.size()) + " positions for " +
                           std::to_string(topology.vertex_count()) + " vertices");
    const auto triangles = topology.triangles();
    std::vector<double> theta(triangles.size());
    for_each_vertex(triangles.size(), [&](std::size_t t) {
        const Vec3 normal = area_normal(positions, triangles[t]);
        const double length = normal.norm();
        const bool valid = length > 0.0 && std::isfinite(length);
        theta[t] = valid ? std::max(0.0, 1.0 - std::abs(normal.dot(axis)) / length) : kDegenerate;
    });
    return theta;
}

/// Raises the changes to those of one axis (Eq. 5.4).
void add_change(const Topology& topology, const std::vector<double>& theta,
                std::vector<double>& change) {
    const CompressedRows& rows = topology.triangles_at();
    for_each_vertex(change.size(), [&](std::size_t v) {
        constexpr double kNone = std::numeric_limits<double>::infinity();
        double smallest = kNone, largest = -kNone;
        for (const TriangleId t : rows.row(v)) {
            if (theta[t] == kDegenerate) continue;
            smallest = std::min(smallest, theta[t]);
            largest = std::max(largest, theta[t]);
        }
        if (smallest != kNone) change[v] = std::max(change[v], largest - smallest);
    });
}

}  // namespace

Vec3 unit_axis(const Vec3& stack_axis) {
    const double length = stack_axis.norm();
    if (!(length > 0.0) || !std::isfinite(length))
        throw InvalidInput("stack_axis needs a direction: three finite numbers, not all of them 0");
    return stack_axis / length;
}

std::vector<double> face_orientations(const Topology& topology, const Positions& positions,
                                      const Vec3& stack_axis) {
    std::vector<double> theta = raw_orientations(topology, positions, stack_axis);
    for (double& value : theta) value = std::max(0.0, value);
    return theta;
}

std::vector<double> orientation_change(const Topology& topology, const Positions& positions,
                                       const StackAxes& stack_axes) {
    std::vector<double> change(positions.size(), 0.0);
    for (const Vec3& axis : stack_axes)
        add_change(topology, raw_orientations(topology, positions, axis), change);
    return change;
}

}  // namespace vesselbench
