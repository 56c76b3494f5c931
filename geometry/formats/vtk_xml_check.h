#pragma once

#include <string>
#include <string_view>

namespace vesselbench {

// VTK's parser prints messages about damaged files, and allocates what they announce: what can be
// checked without it is checked first. `name` is the file's name without its folder.

/// \throw InvalidInput if the bytes are no VTK XML file or end before it does, if numbers of points
/// or cells are larger than the file can hold, if data of an array is missing or announces an
/// impossible size, or if a list of texts is longer than announced: VTK would crash, write beyond
/// its memory, or allocate any amount of it
void require_vtk_xml(std::string_view bytes, const std::string& name);

}  // namespace vesselbench
