#include "meshing/layers/opening_discs.h"

#include <Eigen/Sparse>
#include <Eigen/SparseCholesky>

#include "geometry/kernel/errors.h"

namespace vesselbench {

namespace {

constexpr double kLeastWeight = 1e-3;  // obtuse angles would make the solution leave its rim
constexpr Eigen::Index kFixed = -1;

// Rows of the system: the vertices that are inside openings.
std::vector<Eigen::Index> rows_of_inner(const Surface& surface, const LayeredWall& wall,
                                        Eigen::Index& count) {
    std::vector<Eigen::Index> rows(surface.vertex_count(), 0);
    for (const VertexId v : wall.origins) rows[v] = kFixed;
    count = 0;
    for (Eigen::Index& row : rows)
        if (row != kFixed) row = count++;
    return rows;
}

}  // namespace

void carry_openings(const Surface& surface, const LayeredWall& wall, Positions& moved) {
    Eigen::Index count = 0;
    const std::vector<Eigen::Index> rows = rows_of_inner(surface, wall, count);
    if (count == 0) return;
    const Positions& points = surface.points();
    std::vector<Eigen::Triplet<double>> entries;
    Eigen::MatrixX3d pull = Eigen::MatrixX3d::Zero(count, 3);
    const auto join = [&](VertexId a, VertexId b, double weight) {
        if (rows[a] == kFixed) return;
        entries.emplace_back(rows[a], rows[a], weight);
        if (rows[b] == kFixed)
            pull.row(rows[a]) += weight * (moved[b] - points[b]).transpose();
        else
            entries.emplace_back(rows[a], rows[b], -weight);
    };
    for (TriangleId t = 0; t < surface.triangle_count(); ++t) {
        if (!LayeredWall::is_opening(surface.patch_of(t))) continue;
        const Triangle& corners = surface.triangles()[t];
        for (int k = 0; k < 3; ++k) {
            const VertexId a = corners[k], b = corners[(k + 1) % 3], c = corners[(k + 2) % 3];
            const Vec3 left = points[a] - points[c], right = points[b] - points[c];
            const double weight = std::max(
                kLeastWeight, left.dot(right) / std::max(left.cross(right).norm(), 1e-300));
            join(a, b, weight);
            join(b, a, weight);
        }
    }
    Eigen::SparseMatrix<double> system(count, count);
    system.setFromTriplets(entries.begin(), entries.end());
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(system);
    if (solver.info() != Eigen::Success)
        throw AlgorithmFailure("layers: an opening is not joined to the wall");
    const Eigen::MatrixX3d way = solver.solve(pull);
    for (VertexId v = 0; v < rows.size(); ++v)
        if (rows[v] != kFixed) moved[v] = points[v] + way.row(rows[v]).transpose();
}

std::vector<std::uint8_t> turned_openings(const Surface& surface, const LayeredWall& wall,
                                          const Positions& moved) {
    std::vector<std::uint8_t> turned(surface.patches.size(), 0);
    for (TriangleId t = 0; t < surface.triangle_count(); ++t) {
        const std::uint16_t patch = (*surface.patch_labels)[t];
        if (LayeredWall::is_opening(surface.patches[patch]) &&
            area_normal(moved, surface.triangles()[t]).dot(wall.planes[patch]) <= 0.0)
            turned[patch] = 1;
    }
    return turned;
}

}  // namespace vesselbench
