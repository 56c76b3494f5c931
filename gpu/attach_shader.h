#pragma once

#include <map>
#include <string>

#include "gpu/shader_source.h"

namespace vesselbench {

/// Compiles a shader and attaches it to a program that is not linked yet.
/// \param program its name in OpenGL
/// \param kind GL_COMPUTE_SHADER ...
/// \param texts of all shaders, by file
/// \param defines lines after the version, such as "#define WIDE\n"; empty: none
/// \return its text with its includes, for the log of linking
/// \throw GpuUnavailable with the compiler's log if it does not compile; as assemble_shader()
ShaderSource attach_shader(unsigned program, unsigned kind,
                           const std::map<std::string, std::string>& texts, const std::string& file,
                           const std::string& defines);

}  // namespace vesselbench
