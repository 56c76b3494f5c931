#pragma once

#include <string>
#include <string_view>

#include "geometry/formats/loaded_image.h"

namespace vesselbench {

/// Reads an image of VTK's XML format, with its direction matrix. The active point scalars are
/// used, else the first array with one value per voxel; vectors are ignored. VTK defines no patient
/// axes: LPS is assumed, with a note.
/// \throw as read_image_file
[[nodiscard]] ImageFile read_vti(const std::string& path);

/// The same for legacy structured points.
[[nodiscard]] ImageFile read_legacy_vtk_image(const std::string& path);

/// True if a legacy VTK file that begins with these bytes holds structured points.
[[nodiscard]] bool is_legacy_structured_points(std::string_view head);

}  // namespace vesselbench
