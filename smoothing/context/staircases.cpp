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
inline __attribute__((always_inline)) double orientation(const FaceNormal& face, const Vec3& axis) {
    if (face.length == 0.0) return kDegenerate;
    return std::max(0.0, 1.0 - std::abs(face.weighted().dot(axis)) / face.length);
}

/// \param normal_of (TriangleId) -> FaceNormal
template <class NormalOf>
LargeArray<double> orientations(std::size_t count, const Vec3& stack_axis,
                                const NormalOf& normal_of) {
    const Vec3 axis = unit_axis(stack_axis);
    LargeArray<double> theta(count);
    for_each_vertex(count, [&](std::size_t t) {
        theta[t] = orientation(normal_of(static_cast<TriangleId>(t)), axis);
    });
    return theta;
}

LargeArray<double> orientations(const Topology& topology, const Positions& positions,
                                const Vec3& stack_axis) {
    if (positions.size() != topology.vertex_count())
        throw InvalidInput("got " + std::to_string(positions.size()) + " positions for " +
                           std::to_string(topology.vertex_count()) + " vertices");
    const auto triangles = topology.triangles();
    return orientations(triangles.size(), stack_axis,
                        [&](TriangleId t) { return face_normal(positions, triangles[t]); });
}

/// Raises the changes to those of one axis (Eq. 5.4).
void add_change(const Topology& topology, const LargeArray<double>& theta,
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
    const LargeArray<double> theta = orientations(topology, positions, stack_axis);
    std::vector<double> found(theta.data(), theta.data() + theta.size());
    for (double& value : found) value = std::max(0.0, value);
    return found;
}

std::vector<double> orientation_change(const Topology& topology, const Positions& positions,
                                       const StackAxes& stack_axes) {
    std::vector<double> change(positions.size(), 0.0);
    for (const Vec3& axis : stack_axes)
        add_change(topology, orientations(topology, positions, axis), change);
    return change;
}

std::vector<double> orientation_change(const AreaNormals& faces, const StackAxes& stack_axes) {
    const Topology& topology = *faces.surface().topology;
    std::vector<double> change(topology.vertex_count(), 0.0);
    for (const Vec3& axis : stack_axes)
        add_change(
            topology,
            orientations(topology.triangle_count(), axis, [&](TriangleId t) { return faces[t]; }),
            change);
    return change;
}

}  // namespace vesselbench
