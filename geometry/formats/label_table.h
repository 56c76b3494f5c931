#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/image/segment.h"

namespace vesselbench {

// Names of a label map's labels, in a file beside it (kernel/label_table_places.h).

/// The labels of a table's text, ascending; none if it is no such table. It may be
///
///     ITK-SNAP                 1  255 0 0  1 1 1  "aorta"
///     3D Slicer, FreeSurfer    1  aorta  255 0 0 255
///     BIDS                     index, name and perhaps color as columns
///     JSON                     {"1": "aorta"}, {"aorta": 1}, either as "labels" of an object, or a
///                              list of {"label" | "value" | "id" | "index": 1, "name": "aorta"}
///
/// Label 0, the background, is left out. Source: ITK-SNAP's header of such files; BIDS 1.8,
/// "Common image-derived labels"; nnU-Net, dataset.json.
[[nodiscard]] std::vector<Segment> label_table_in(std::string_view text);

/// True if there is a file at one of the places for it.
[[nodiscard]] bool has_label_table(const std::filesystem::path& image);

/// The first table beside a label map; a note names it. Empty if there is none.
[[nodiscard]] std::vector<Segment> label_table_beside(const std::string& image,
                                                      std::vector<std::string>& notes);

}  // namespace vesselbench
