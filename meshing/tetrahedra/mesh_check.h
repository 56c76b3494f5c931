#pragma once

#include <span>
#include <string>

#include "geometry/kernel/surface.h"
#include "meshing/tetrahedra/quality.h"
#include "meshing/tetrahedra/volume_mesh.h"

namespace vesselbench {

/// How a mesh departs from the surface that it fills: volume, patches, their areas and triangles,
/// inverted cells, several regions. Empty if it does not.
/// \param faces of `mesh_faces`
/// \param keeps_surface the boundary's triangles should be as many as the surface's
/// \param tolerance of volume and areas [-]
[[nodiscard]] std::string mesh_loss(const VolumeMesh& mesh, std::span<const MeshFace> faces,
                                    const Surface& surface, bool keeps_surface,
                                    double tolerance = 1e-6);

}  // namespace vesselbench
