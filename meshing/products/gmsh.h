#pragma once

#include <string>

#include "geometry/kernel/progress.h"
#include "meshing/tetrahedra/volume_mesh.h"

namespace vesselbench {

/// Writes Gmsh's MSH 2.2 (ascii) [mm]: boundary triangles with the physical surfaces 1 (wall), 2...
/// (openings) by name, tetrahedra with the physical volume "lumen".
/// \throw InvalidInput if there are no cells, IoError, Cancelled
void write_msh(const VolumeMesh& mesh, const std::string& path, const Progress& progress = {});

}  // namespace vesselbench
