#pragma once

#include <map>
#include <string>

#include "geometry/formats/loaded_image.h"

namespace vesselbench {

/// Pairs "key:=value" of an NRRD header.
using NrrdPairs = std::map<std::string, std::string>;

/// Reads the segments that 3D Slicer describes in the header of a .seg.nrrd (Segment0_Name,
/// Segment0_LabelValue, Segment0_Layer, Segment0_Color ...) into file.segments, and for a file with
/// layers file.stored. Segments that are not described whole are left out, with a note.
/// Source: Slicer documentation, "Segmentations: Segmentation file (.seg.nrrd)".
void read_slicer_segments(const NrrdPairs& pairs, ImageFile& file);

}  // namespace vesselbench
