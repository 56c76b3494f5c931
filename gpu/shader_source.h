#pragma once

#include <map>
#include <string>
#include <vector>

namespace vesselbench {

/// A shader's text with everything it includes.
struct ShaderSource {
    std::string text;
    std::vector<std::string> files;  ///< by the number that the compiler's messages give them
};

/// Puts the text of a shader together: a line `#include "file"` stands for that file's text, once.
/// \throw GpuUnavailable if a file is missing
[[nodiscard]] ShaderSource assemble_shader(const std::map<std::string, std::string>& texts,
                                           const std::string& file);

/// A compiler's log with the numbers of files replaced by their names and the lines it complains of
/// beneath: "moves.glsl:12: ...". Lines in a form that no known driver prints stay as they are.
[[nodiscard]] std::string explained_log(const std::map<std::string, std::string>& texts,
                                        const ShaderSource& source, const std::string& log);

}  // namespace vesselbench
