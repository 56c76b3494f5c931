#include "meshing/tetrahedra/volume_section.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/kernel/errors.h"

namespace vesselbench {

namespace {

constexpr std::size_t kCellsBetweenChecks = 16384;

/// Corners of a tetrahedron on either side of a plane.
struct Sides {
    std::array<VertexId, 4> above{}, below{};
    std::size_t above_count = 0, below_count = 0;
};

/// The polygon in which the plane meets a prism; empty if it does not. Prisms are convex: around
/// the mean of the points in which it cuts their edges, these are in order by angle.
Positions polygon_of(const Prism& prism, const Positions& points,
                     const std::vector<double>& distances, const Vec3& normal) {
    Positions cuts;
    const auto cut = [&](VertexId a, VertexId b) {
        if ((distances[a] >= 0.0) == (distances[b] >= 0.0)) return;
        const double share = distances[a] / (distances[a] - distances[b]);
        cuts.emplace_back(points[a] + share * (points[b] - points[a]));
    };
    for (std::size_t k = 0; k < 3; ++k) {
        cut(prism[k], prism[(k + 1) % 3]);
        cut(prism[k], prism[k + 3]);
        cut(prism[k + 3], prism[(k + 1) % 3 + 3]);
    }
    if (cuts.empty()) return cuts;
    Vec3 middle = Vec3::Zero();
    for (const Vec3& p : cuts) middle += p / static_cast<double>(cuts.size());
    const Vec3 x = normal.unitOrthogonal(), y = normal.cross(x);
    std::ranges::sort(
        cuts, {}, [&](const Vec3& p) { return std::atan2(y.dot(p - middle), x.dot(p - middle)); });
    return cuts;
}

Sides sides_of(const Tetrahedron& cell, const std::vector<double>& distances) {
    Sides sides;
    for (const VertexId v : cell)
        if (distances[v] >= 0.0)
            sides.above[sides.above_count++] = v;
        else
            sides.below[sides.below_count++] = v;
    return sides;
}

/// The polygon in which the plane meets a tetrahedron; empty if it does not.
Positions polygon_of(const Sides& sides, const Positions& points,
                     const std::vector<double>& distances) {
    Positions polygon;
    const auto cross = [&](VertexId above, VertexId below) {
        const double share = distances[above] / (distances[above] - distances[below]);
        polygon.emplace_back(points[above] + share * (points[below] - points[above]));
    };
    if (sides.above_count == 2) {  // around the quadrangle, one corner changes at a time
        cross(sides.above[0], sides.below[0]);
        cross(sides.above[0], sides.below[1]);
        cross(sides.above[1], sides.below[1]);
        cross(sides.above[1], sides.below[0]);
        return polygon;
    }
    for (std::size_t i = 0; i < sides.above_count; ++i)
        for (std::size_t j = 0; j < sides.below_count; ++j) cross(sides.above[i], sides.below[j]);
    return polygon;
}

}  // namespace

Surface VolumeSection::surface() const {
    Positions positions;
    std::vector<Triangle> triangles;
    for (const Positions& cell : cells) {
        const auto first = static_cast<VertexId>(positions.size());
        const auto count = static_cast<VertexId>(cell.size());
        positions.insert(positions.end(), cell.begin(), cell.end());
        for (VertexId i = 1; i + 1 < count; ++i)
            triangles.push_back({first, first + i, first + i + 1});
    }
    return make_surface(std::move(positions), std::move(triangles));
}

std::vector<double> VolumeSection::vertex_values() const {
    std::vector<double> all;
    for (std::size_t i = 0; i < cells.size(); ++i)
        all.insert(all.end(), cells[i].size(), values[i]);
    return all;
}

VolumeSection section_of(const VolumeMesh& mesh, std::span<const double> values, const Plane& plane,
                         const Progress& progress) {
    if (values.size() != mesh.cell_count())
        throw InvalidInput("a section needs a value for each of the " +
                           std::to_string(mesh.cell_count()) + " cells, not " +
                           std::to_string(values.size()));
    std::vector<double> distances(mesh.points.size());
    std::ranges::transform(mesh.points, distances.begin(),
                           [&](const Vec3& point) { return plane.distance(point); });
    VolumeSection section;
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (i % kCellsBetweenChecks == 0) progress.check_cancelled();
        Positions polygon =
            i < mesh.tetrahedra.size()
                ? polygon_of(sides_of(mesh.tetrahedra[i], distances), mesh.points, distances)
                : polygon_of(mesh.prisms[i - mesh.tetrahedra.size()], mesh.points, distances,
                             plane.normal);
        if (polygon.empty()) continue;
        section.cells.push_back(std::move(polygon));
        section.values.push_back(values[i]);
    }
    return section;
}

}  // namespace vesselbench
