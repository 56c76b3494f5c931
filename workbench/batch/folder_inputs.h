#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace vesselbench {

/// What `prepare` can read in a folder, by name: surfaces, images, case folders, and folders of
/// DICOM slices. Hidden files are left out.
/// \param skipped receives the name of each other file
/// \throw IoError if the folder cannot be read
[[nodiscard]] std::vector<std::filesystem::path> inputs_in(
    const std::filesystem::path& folder, const std::function<void(const std::string&)>& skipped);

}  // namespace vesselbench
