#pragma once

#include <string>

#include "geometry/kernel/progress.h"
#include "meshing/tetrahedra/volume_mesh.h"

namespace vesselbench {

/// Writes a CGNS file in HDF5 [m]: tetrahedra, prisms, and for each patch its faces, a family and a
/// boundary condition by its name: wall, inflow or outflow. Names are cut to CGNS's 32 characters.
/// \throw InvalidInput if there are no cells, IoError, Cancelled
void write_cgns(const VolumeMesh& mesh, const std::string& path, const Progress& progress = {},
                const std::string& provenance = {});

}  // namespace vesselbench
