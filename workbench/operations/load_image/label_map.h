#pragma once

#include <string>

#include "geometry/formats/loaded_image.h"

namespace vesselbench {

/// Makes one label map of the layers of segments that overlap: a segment's voxels get its label,
/// those of `choice` on top, which are whole. Other files stay as they are.
/// \param choice as labels_named() reads it; empty: none
/// \throw DiagnosedUsage (kLabelUnchosen) if there are layers and no choice; UsageError as
/// labels_named()
void join_layers(ImageFile& file, const std::string& choice);

/// The names of a label map and what is chosen of it.
/// \param segments of its file
/// \throw UsageError as labels_named()
[[nodiscard]] Segmentation segmentation_of(const Image& labels,
                                           const std::vector<Segment>& segments,
                                           const std::string& choice);

}  // namespace vesselbench
