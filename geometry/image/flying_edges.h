#pragma once

#include <array>
#include <span>
#include <vector>

#include "geometry/kernel/topology.h"
#include "geometry/kernel/vec3.h"

namespace vesselbench {

/// The points of a regular grid.
struct GridFrame {
    std::array<int, 3> size = {0, 0, 0};  ///< points along each axis
    Vec3 origin = Vec3::Zero();           ///< position of the first point
    double spacing = 1.0;                 ///< side of the cells
};

/// Triangles of a zero set in grid coordinates; they face smaller values.
struct GridSurface {
    std::vector<std::array<float, 3>> points;
    std::vector<Triangle> triangles;
};

/// The zero set of a function sampled on a grid, open at the grid's border.
/// Source: Schroeder et al., "Flying edges: a high-performance scalable isocontouring algorithm",
/// LDAV 2015 (vtkFlyingEdges3D).
/// \param values at the grid's points, the first axis fastest
[[nodiscard]] GridSurface flying_edges(std::span<const float> values, const GridFrame& grid);
[[nodiscard]] GridSurface flying_edges(std::span<const double> values, const GridFrame& grid);

}  // namespace vesselbench
