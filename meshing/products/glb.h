#pragma once

#include <string>

#include "geometry/kernel/progress.h"
#include "geometry/kernel/surface.h"

namespace vesselbench {

/// Writes binary glTF 2.0 for viewers: one mesh part and material per patch, smooth normals.
/// Positions are floats relative to the bounding box's centre in mm; the node scales to glTF's
/// metres and turns the patient's head (+z) up (+y).
/// \throw InvalidInput if the surface has no triangle, IoError, Cancelled
void write_glb(const Surface& surface, const std::string& path, const Progress& progress = {});

}  // namespace vesselbench
