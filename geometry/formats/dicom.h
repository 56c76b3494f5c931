#pragma once

#include <string>
#include <string_view>

#include "geometry/formats/format.h"
#include "geometry/formats/loaded_image.h"

namespace vesselbench {

/// Reads the one DICOM series in a folder. Slices are ordered by their positions along the slice
/// normal, and the distance between slices comes from these positions (SliceThickness means
/// something else). A gantry tilt becomes an oblique third axis. Only geometry, pixels, rescale
/// slope and intercept are taken; no texts of the files.
/// \throw IoError if the folder cannot be read
/// \throw InvalidInput if it contains no DICOM slices, several series, slices of different size or
/// orientation, two slices in one place, a missing slice or uneven distances, or pixels that cannot
/// be decoded
[[nodiscard]] ImageFile read_dicom_folder(const std::string& folder);

/// Reads a DICOM file with several frames.
/// \throw as read_image_file; also if the file contains a single slice
[[nodiscard]] ImageFile read_dicom_file(const std::string& path);

/// One of the two above, by whether the path is a folder.
[[nodiscard]] ImageFile read_dicom(const std::string& path);

/// True if a file that begins with these bytes has DICOM's preamble.
[[nodiscard]] bool is_dicom(std::string_view head);

/// What the table of image formats says about DICOM.
[[nodiscard]] const Format& dicom_format();

}  // namespace vesselbench
