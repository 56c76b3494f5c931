#pragma once

#include <string>

#include "geometry/formats/loaded_image.h"
#include "geometry/kernel/progress.h"

namespace vesselbench {

/// Reads NIfTI-1 (.nii, .nii.gz; either byte order). The sform is used if it is set, else the
/// qform, else the voxel sizes alone. Its RAS becomes LPS; metres and micrometres become [mm].
/// Source: Cox et al., "A (sort of) new image data format standard: NIfTI-1", 2004; nifti1.h.
/// \throw as read_image_file
[[nodiscard]] ImageFile read_nifti(const std::string& path);

/// Bytes of a NIfTI-1 file (not compressed) with the image, its matrix as sform.
[[nodiscard]] std::string nifti_bytes(const Image& image);

/// Writes these bytes. \throw IoError, Cancelled
void write_nifti(const Image& image, const std::string& path, const Progress& progress = {});

/// The same, as a gzip stream.
void write_compressed_nifti(const Image& image, const std::string& path,
                            const Progress& progress = {});

}  // namespace vesselbench
