#pragma once

#include <string>

#include "geometry/kernel/progress.h"
#include "meshing/tetrahedra/volume_mesh.h"

namespace vesselbench {

/// Writes a mesh in Fluent's text format [m] (ANSYS Fluent User's Guide, "Mesh File Format"): all
/// faces with their cells, a fluid zone `lumen`, its inner faces, and a zone by name for each
/// patch: walls, velocity inlets and pressure outlets. A name that the file has already gets a
/// number.
/// \throw InvalidInput if there are no cells, or a patch has no plain name; IoError if the file
/// cannot be written; Cancelled
void write_fluent(const VolumeMesh& mesh, const std::string& path, const Progress& progress = {},
                  const std::string& provenance = {});

}  // namespace vesselbench
