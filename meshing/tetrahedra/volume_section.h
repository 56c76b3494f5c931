#pragma once

#include <span>
#include <vector>

#include "geometry/kernel/cross_section.h"
#include "geometry/kernel/progress.h"
#include "meshing/tetrahedra/volume_mesh.h"

namespace vesselbench {

/// Where a plane cuts the cells: a polygon of each one that it cuts.
struct VolumeSection {
    std::vector<Positions> cells;  ///< corners of each polygon in order [mm]
    std::vector<double> values;    ///< #cells, of its cell

    /// The polygons as triangles that share no vertices; empty if there are none.
    [[nodiscard]] Surface surface() const;

    /// The values at that surface's vertices, #V.
    [[nodiscard]] std::vector<double> vertex_values() const;
};

/// \param values of the cells
/// \throw InvalidInput unless there is a value for each cell; Cancelled
[[nodiscard]] VolumeSection section_of(const VolumeMesh& mesh, std::span<const double> values,
                                       const Plane& plane, const Progress& progress);

}  // namespace vesselbench
