#include "meshing/remeshing/cell_estimate.h"

namespace vesselbench {

namespace {

/// Volume of a cell in cubes of the target edge, as meshes have it whose edges are somewhat shorter
/// than their target [-]; a regular tetrahedron has 0.118.
constexpr double kCellVolume = 0.075;

/// Integral of (1 - s / radius) / (size + growth s)^3 over the depth s from 0 to the radius: what
/// is left of a wall's area at that depth of a tube, by the volume of the cells there [1/mm^2].
double cells_behind(double size, double radius, double growth) {
    const double axis = size + growth * radius;
    const double squares = 1.0 / (size * size) - 1.0 / (axis * axis);
    const double straight = squares / (2.0 * growth);
    const double tapered = ((1.0 / size - 1.0 / axis) - 0.5 * size * squares) / (growth * growth);
    return straight - tapered / radius;
}

}  // namespace

double expected_cells(const Surface& surface, const std::vector<double>& sizes,
                      const std::vector<double>& radii, double growth) {
    double cells = 0.0;
    for (TriangleId t = 0; t < surface.triangle_count(); ++t) {
        if (surface.patch_of(t).kind != PatchKind::Wall) continue;
        const auto& [a, b, c] = surface.triangles()[t];
        const double size = (sizes[a] + sizes[b] + sizes[c]) / 3.0,
                     radius = (radii[a] + radii[b] + radii[c]) / 3.0;
        if (!(radius > 0.0)) continue;
        cells += 0.5 * area_normal(surface.points(), {a, b, c}).norm() *
                 cells_behind(size, radius, growth) / kCellVolume;
    }
    return cells;
}

}  // namespace vesselbench
