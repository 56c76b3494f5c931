#pragma once

#include <optional>
#include <string>
#include <vector>

#include "geometry/image/image.h"

namespace vesselbench {

/// An image as a file gave it.
struct ImageFile {
    Image image;                     ///< [mm], LPS, with the file's true orientation
    std::string format;              ///< "NIfTI", "NRRD", "MetaImage", "VTK" or "DICOM"
    std::optional<double> unit;      ///< [mm] that the file's stated unit has; none if none stated
    std::vector<std::string> notes;  ///< what was missing in the file and what was taken instead
};

/// Reads an image with its orientation, converted to [mm] and LPS: NIfTI-1 (.nii, .nii.gz), NRRD
/// (.nrrd, .nhdr), MetaImage (.mha, .mhd), VTK (.vti, legacy .vtk structured points), a DICOM file
/// with several frames, or a folder with the slices of one DICOM series. Intensities are scaled as
/// the file says (slope, intercept). Of a DICOM file only geometry and pixels are taken.
/// \throw IoError if the file cannot be read
/// \throw InvalidInput if it is truncated, damaged, of an unknown kind, has a voxel that is not a
/// finite number, more than one value a voxel, more than three dimensions, or more than 2^30 voxels
[[nodiscard]] ImageFile read_image_file(const std::string& path);

/// The image of read_image_file alone.
[[nodiscard]] Image read_image(const std::string& path);

/// True if the name (or, for a folder, the fact that it holds no case) says that it is an image.
[[nodiscard]] bool looks_like_image(const std::string& path);

/// Writes .nii, .nii.gz, .mha or .nrrd (by suffix; the last two compressed), whole numbers as
/// uint8 or int16 where they fit, else float32. NIfTI stores its matrix in single precision.
/// \throw UsageError for another suffix, IoError if it cannot be written, InvalidInput if empty
void write_image(const std::string& path, const Image& image);

}  // namespace vesselbench
