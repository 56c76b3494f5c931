#pragma once

#include <string>

namespace vesselbench::test {

/// Folder of the source tree.
[[nodiscard]] std::string source_folder();

/// Path of the program under test.
[[nodiscard]] std::string program_path();

}  // namespace vesselbench::test
