#pragma once

#include <filesystem>
#include <string>

namespace vesselbench {

/// The folder with the bundled cases, found from the program upward: that of the sources, or what
/// an installation has in share/; empty: none.
[[nodiscard]] std::filesystem::path bundled_cases_folder();

/// The folder of the bundled case of this name, "aneurysm"; empty: there is none.
[[nodiscard]] std::filesystem::path bundled_case(const std::string& name);

}  // namespace vesselbench
