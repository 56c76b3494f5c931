#include "gpu/attach_shader.h"

#include <epoxy/gl.h>

#include "geometry/kernel/errors.h"

namespace vesselbench {

namespace {

std::string compile_log(unsigned shader) {
    char log[8192] = "";
    glGetShaderInfoLog(shader, sizeof log, nullptr, log);
    return log;
}

}  // namespace

ShaderSource attach_shader(unsigned program, unsigned kind,
                           const std::map<std::string, std::string>& texts, const std::string& file,
                           const std::string& defines) {
    ShaderSource source = assemble_shader(texts, file);
    if (!defines.empty()) source.text.insert(source.text.find('\n') + 1, defines + "#line 2 0\n");
    const unsigned shader = glCreateShader(kind);
    const char* text = source.text.c_str();
    glShaderSource(shader, 1, &text, nullptr);
    glCompileShader(shader);
    glAttachShader(program, shader);
    glDeleteShader(shader);  // lives on while attached
    int ok = 0;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &ok);
    if (!ok)
        throw GpuUnavailable("the shader " + file + " does not compile:\n" +
                             explained_log(texts, source, compile_log(shader)));
    return source;
}

}  // namespace vesselbench
