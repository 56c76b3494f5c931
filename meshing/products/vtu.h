#pragma once

#include <string>

#include "geometry/kernel/progress.h"
#include "meshing/tetrahedra/volume_mesh.h"

namespace vesselbench {

/// Writes a VTK XML unstructured grid [mm]: the tetrahedra, the wedges of wall layers, then the
/// boundary's triangles and quadrangles. Cell array `CellEntityIds`: 0 for volume cells, 1 the
/// wall, 2... the openings; names of 1, 2... in the field array `PatchNames`, the model's
/// provenance in `Provenance`. \throw InvalidInput if there are no cells, IoError, Cancelled
void write_vtu(const VolumeMesh& mesh, const std::string& path, const Progress& progress = {},
               const std::string& provenance = {});

}  // namespace vesselbench
