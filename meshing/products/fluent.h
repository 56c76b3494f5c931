#pragma once

#include <string>

#include "geometry/kernel/progress.h"
#include "meshing/tetrahedra/volume_mesh.h"

namespace vesselbench {

/// Writes a mesh in Fluent's text format [m]: all faces with their cells, a fluid zone `lumen`, its
/// inner faces, and a zone by name for each patch: walls, velocity inlets and pressure outlets.
/// \throw InvalidInput if there are no cells, IoError, Cancelled
void write_fluent(const VolumeMesh& mesh, const std::string& path, const Progress& progress = {},
                  const std::string& provenance = {});

}  // namespace vesselbench
