#pragma once

#include <map>
#include <string>
#include <vector>

namespace vesselbench {

/// A shader's text with everything it includes.
struct ShaderSource {
    std::string text;
    std::vector<std::string> files;  ///< by their number in the compiler's messages
};

/// Assembles the text of a shader: a line `#include "file"` is replaced by that file's text, once;
/// `#again "file"` by the text of a file that may be there already, as another macro makes it
/// differ. \throw GpuUnavailable if a file is missing
[[nodiscard]] ShaderSource assemble_shader(const std::map<std::string, std::string>& texts,
                                           const std::string& file);

/// A compiler's log with file numbers replaced by names, and the quoted source lines below:
/// "moves.glsl:12: ...". Lines in an unknown form are kept as they are.
[[nodiscard]] std::string explained_log(const std::map<std::string, std::string>& texts,
                                        const ShaderSource& source, const std::string& log);

}  // namespace vesselbench
