#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "geometry/kernel/progress.h"

namespace vesselbench {

struct FolderEntry {
    std::string name;
    bool folder = false;
    bool openable_folder = false;  ///< a case folder (it has a case.json)
    std::uintmax_t bytes = 0;
};

/// The content of a folder for a file dialog: folders first, then files, each by name without
/// regard to case; hidden ones are left out.
struct FolderListing {
    std::filesystem::path folder;
    std::vector<FolderEntry> entries;
    bool has_dicom = false;  ///< among its first files is a slice of a DICOM series
    std::string error;       ///< why the folder cannot be read; empty if it was
};

/// \param suffixes of the files to list, lower case, with the dot; empty: all files
/// \throw Cancelled
[[nodiscard]] FolderListing list_folder(const std::filesystem::path& folder,
                                        const std::vector<std::string>& suffixes,
                                        const Progress& progress = {});

/// Suffixes of what the window opens: projects, surfaces and images.
[[nodiscard]] std::vector<std::string> openable_suffixes();

}  // namespace vesselbench
