#pragma once

#include <string>

#include "meshing/tetrahedra/volume_mesh.h"

namespace vesselbench {

/// Writes Gmsh's MSH 2.2 (ascii) [mm]: boundary triangles with the physical surfaces 1 (wall), 2...
/// (openings) by name, tetrahedra with the physical volume "lumen".
/// \throw InvalidInput if there are no cells, IoError
void write_msh(const VolumeMesh& mesh, const std::string& path);

}  // namespace vesselbench
