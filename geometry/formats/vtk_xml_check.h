#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "geometry/formats/vtk_xml_elements.h"

namespace vesselbench {

// VTK's parser prints messages about damaged files, and allocates what they announce: what can be
// checked without it is checked first. `name` is the file's name without its folder.

/// \return the file's elements
/// \throw InvalidInput if the bytes are no VTK XML file that vtk_xml_elements() reads, if numbers
/// of points, cells or components are larger than the file can hold, if data of an array is missing
/// or announces an impossible size, or if a list of texts is longer than announced: VTK would
/// crash, write beyond its memory, or allocate any amount of it
std::vector<VtkXmlElement> require_vtk_xml(std::string_view bytes, const std::string& name);

}  // namespace vesselbench
