#pragma once

#include <string>

#include "geometry/formats/image_file.h"

namespace vesselbench {

/// Reads an image of VTK: XML (.vti) or legacy structured points (.vtk), with its direction matrix.
/// The active point scalars are taken, else the first array with one value a voxel; vectors are
/// passed over. VTK names no patient axes: LPS is taken and said.
/// \throw as read_image_file
[[nodiscard]] ImageFile read_vtk_image(const std::string& path);

}  // namespace vesselbench
