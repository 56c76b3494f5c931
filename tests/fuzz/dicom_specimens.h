#pragma once

#include <filesystem>
#include <string>

#include "geometry/image/image.h"

namespace vesselbench::fuzz {

/// <folder>/dcm: slices in several transfer syntaxes and one file with several frames;
/// <folder>/dicom-folder: a slice, with the others of its series beside it.
void write_dicom_specimens(const std::filesystem::path& folder);

/// VTK XML images as text, appended and compressed. \param folder ends in a slash
void write_vti_specimens(const Image& image, const std::string& folder);

}  // namespace vesselbench::fuzz
