#include "geometry/kernel/label_table_places.h"

#include <string>

#include "geometry/kernel/wording.h"

namespace vesselbench {

namespace {

/// The name without the suffix of a label map; empty: it is none.
std::string stem_of(const std::string& name) {
    const std::string lower = lower_case(name);
    for (const std::string suffix :
         {".nii.gz", ".seg.nrrd", ".nii", ".nrrd", ".nhdr", ".mha", ".mhd", ".vti"})
        if (lower.size() > suffix.size() && lower.ends_with(suffix))
            return name.substr(0, name.size() - suffix.size());
    return "";
}

}  // namespace

std::vector<std::filesystem::path> label_table_places(const std::filesystem::path& image) {
    const std::string stem = stem_of(image.filename().string());
    std::vector<std::filesystem::path> places;
    if (stem.empty()) return places;
    for (const char* suffix : {".txt", ".label", ".ctbl", ".tsv", ".csv", ".json"})
        places.push_back(image.parent_path() / (stem + suffix));
    return places;
}

}  // namespace vesselbench
