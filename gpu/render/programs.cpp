#include "gpu/render/programs.h"

#include <epoxy/gl.h>

namespace vesselbench {

Uniforms::Uniforms(const Program& program) : program_(program.id()) {
    glUseProgram(program_);
}

int Uniforms::place(const char* name) const {
    return glGetUniformLocation(program_, name);
}

void Uniforms::set(const char* name, int value) const {
    glUniform1i(place(name), value);
}

void Uniforms::set(const char* name, unsigned value) const {
    glUniform1ui(place(name), value);
}

void Uniforms::set(const char* name, double value) const {
    glUniform1f(place(name), static_cast<float>(value));
}

void Uniforms::set(const char* name, const Eigen::Vector2d& value) const {
    glUniform2fv(place(name), 1, value.cast<float>().eval().data());
}

void Uniforms::set(const char* name, const Eigen::Vector3f& value) const {
    glUniform3fv(place(name), 1, value.data());
}

void Uniforms::set(const char* name, const Eigen::Vector4d& value) const {
    glUniform4fv(place(name), 1, value.cast<float>().eval().data());
}

void Uniforms::set(const char* name, std::span<const Eigen::Vector3f> values) const {
    glUniform3fv(place(name), static_cast<GLsizei>(values.size()), values.front().data());
}

void Uniforms::set(const char* name, const Eigen::Matrix4d& value) const {
    glUniformMatrix4fv(place(name), 1, GL_FALSE, value.cast<float>().eval().data());
}

Uniforms ProgramSet::use(const std::string& vertex, const std::string& fragment,
                         const std::string& defines) {
    const std::string key = vertex + "|" + fragment + "|" + defines;
    auto known = programs_.find(key);
    if (known == programs_.end())
        known = programs_.emplace(key, make_program(vertex, fragment, defines)).first;
    return Uniforms(known->second);
}

}  // namespace vesselbench
