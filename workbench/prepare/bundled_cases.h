#pragma once

#include <filesystem>
#include <span>
#include <string>

namespace vesselbench {

/// A folder that belongs to the program, in its sources or in an installation; empty: none.
/// \param places seen from a folder above the program, which are looked into upward
/// \param content a file that proves the folder
[[nodiscard]] std::filesystem::path own_folder(std::span<const char* const> places,
                                               const std::filesystem::path& content);

/// The folder with the bundled cases: that of the sources, or what an installation has in share/;
/// empty: none.
[[nodiscard]] std::filesystem::path bundled_cases_folder();

/// The folder of the bundled case of this name, "aneurysm"; empty: there is none.
[[nodiscard]] std::filesystem::path bundled_case(const std::string& name);

}  // namespace vesselbench
