#pragma once

#include <string>

#include "geometry/formats/loaded_image.h"
#include "geometry/kernel/progress.h"

namespace vesselbench {

/// Reads an image with its orientation, converted to [mm] and LPS, in a format of image_formats():
/// by its suffix, or by its content if the format recognises it; a folder holds the slices of one
/// DICOM series. Intensities are scaled according to the file (slope, intercept). Of a DICOM file
/// only geometry and pixels are used.
/// \throw IoError if the file cannot be read; InvalidInput if it is truncated, damaged, of an
/// unknown kind, has a voxel that is not a finite number, more than one value per voxel, more than
/// three dimensions, or more than 2^30 voxels
[[nodiscard]] ImageFile read_image_file(const std::string& path);

/// The same, also of a segmentation in which segments overlap (ImageFile::layers); of a label map
/// that names no segments, those of a label table beside it (label_table.h).
[[nodiscard]] ImageFile read_segmentation_file(const std::string& path);

/// The image of read_image_file alone.
[[nodiscard]] Image read_image(const std::string& path);

/// Writes an image in the format of the suffix, integers as uint8 or int16 if they fit, else
/// float32. NIfTI stores its matrix in single precision. \throw UsageError for another suffix,
/// IoError if it cannot be written, InvalidInput if empty, Cancelled
void write_image(const std::string& path, const Image& image, const Progress& progress = {});

/// The formats that images are read from, with their suffixes, for help texts.
[[nodiscard]] std::string image_formats_text();

}  // namespace vesselbench
