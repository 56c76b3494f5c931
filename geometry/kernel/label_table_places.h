#pragma once

#include <filesystem>
#include <vector>

namespace vesselbench {

/// Where the table of a label map's names may lie: beside it, with its name up to the suffix, and
/// one of the suffixes .txt, .label (ITK-SNAP), .ctbl (3D Slicer, FreeSurfer), .tsv, .csv (BIDS)
/// and .json.
/// \return in this order, whether they are there or not; empty for other files than NIfTI, NRRD,
/// MetaImage and VTI
[[nodiscard]] std::vector<std::filesystem::path> label_table_places(
    const std::filesystem::path& image);

}  // namespace vesselbench
