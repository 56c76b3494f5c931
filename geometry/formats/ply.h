#pragma once

#include <string>

#include "geometry/formats/raw_surface.h"
#include "geometry/kernel/progress.h"

namespace vesselbench {

/// Reads a PLY file, text or binary of either byte order: element `vertex` with x, y, z, element
/// `face` with a list of corners (vertex_indices or vertex_index); other scalar vertex properties,
/// except normals, colours and texture, become attributes, other elements are skipped.
/// \throw InvalidInput for a damaged or truncated file, IoError if it cannot be read
[[nodiscard]] RawSurface read_ply(const std::string& path);

/// Binary, double precision, with attributes; patches are stored in the face property CellEntityIds
/// and in comments, the unit and the model's provenance in others.
void write_ply(const Surface& surface, const std::string& path, const Progress& progress = {},
               const std::string& provenance = {});

}  // namespace vesselbench
