#pragma once

#include <string>

#include "geometry/kernel/progress.h"
#include "meshing/tetrahedra/volume_mesh.h"

namespace vesselbench {

/// Whether the library that writes CGNS files is there.
[[nodiscard]] bool cgns_installed();

/// Writes a CGNS file in HDF5 [m] (CGNS Standard Interface Data Structures, SIDS): tetrahedra,
/// prisms, and for each patch its faces, a family and a boundary condition by its name: wall,
/// inflow or outflow. Names are cut to CGNS's 32 characters; one that the file has already gets a
/// number.
/// \throw InvalidInput if there are no cells, or a patch has no plain name; IoError if the file
/// cannot be written, or the library or a function of it is missing; Cancelled
void write_cgns(const VolumeMesh& mesh, const std::string& path, const Progress& progress = {},
                const std::string& provenance = {});

}  // namespace vesselbench
