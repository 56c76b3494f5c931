#pragma once

#include <filesystem>
#include <vector>

namespace vesselbench {

/// $XDG_CONFIG_HOME/vesselbench, or its default below the home folder. It may not exist.
[[nodiscard]] std::filesystem::path settings_folder();

/// $XDG_CACHE_HOME/vesselbench, or its default below the home folder. It may not exist.
[[nodiscard]] std::filesystem::path cache_folder();

/// $XDG_STATE_HOME/vesselbench, or its default below the home folder. It may not exist.
[[nodiscard]] std::filesystem::path state_folder();

/// $XDG_DOCUMENTS_DIR, else Documents in the home folder if it exists, else the home folder.
[[nodiscard]] std::filesystem::path documents_folder();

[[nodiscard]] std::filesystem::path home_folder();

/// A file in it can be created.
[[nodiscard]] bool is_writable_folder(const std::filesystem::path& folder);

/// The name itself if no file has it, else the first free one of "a-2.png", "a-3.png" ...
[[nodiscard]] std::filesystem::path free_file(const std::filesystem::path& wanted);

/// Where the project of an input goes: NAME.vbench beside the input if that folder can be written
/// (`beside`), else in `otherwise`; never an existing file (NAME-2.vbench ...).
[[nodiscard]] std::filesystem::path new_project_file(const std::filesystem::path& input,
                                                     bool beside,
                                                     const std::filesystem::path& otherwise);

/// The projects that new_project_file() may have named for this input, those with the highest
/// number first. They may be of another input of the same name.
[[nodiscard]] std::vector<std::filesystem::path> earlier_project_files(
    const std::filesystem::path& input, bool beside, const std::filesystem::path& otherwise);

}  // namespace vesselbench
