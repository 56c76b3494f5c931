#pragma once

#include <string>

namespace vesselbench {

/// A file that an edit read.
struct SourceFile {
    std::string parameter;  ///< of the operation
    std::string name;       ///< without its folder
    std::string hash;       ///< SHA-256 of its content
    std::string place;      ///< path relative to the project; kept only if the scene refers to it
};

}  // namespace vesselbench
