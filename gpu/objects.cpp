#include "gpu/objects.h"

#include <epoxy/gl.h>

#include "geometry/kernel/errors.h"
#include "gpu/shader_texts.h"

namespace vesselbench {

namespace {

void check_compiled(unsigned shader, const std::string& file) {
    int ok = 0;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &ok);
    if (ok) return;
    char log[2048] = "";
    glGetShaderInfoLog(shader, sizeof log, nullptr, log);
    throw GpuUnavailable("shader " + file + " does not compile: " + log);
}

void attach(const Program& program, unsigned kind, const std::string& file) {
    const auto& texts = shader_texts();
    const auto text = texts.find(file);
    if (text == texts.end()) throw GpuUnavailable("there is no shader " + file);
    const unsigned shader = glCreateShader(kind);
    const char* source = text->second.c_str();
    glShaderSource(shader, 1, &source, nullptr);
    glCompileShader(shader);
    glAttachShader(program.id(), shader);
    glDeleteShader(shader);  // lives on while attached
    check_compiled(shader, file);
}

}  // namespace

void delete_buffer(unsigned id) {
    glDeleteBuffers(1, &id);
}

void delete_program(unsigned id) {
    glDeleteProgram(id);
}

void delete_vertex_array(unsigned id) {
    glDeleteVertexArrays(1, &id);
}

void delete_framebuffer(unsigned id) {
    glDeleteFramebuffers(1, &id);
}

void delete_renderbuffer(unsigned id) {
    glDeleteRenderbuffers(1, &id);
}

void delete_query(unsigned id) {
    glDeleteQueries(1, &id);
}

Buffer make_buffer(std::span<const std::byte> bytes, const std::string& label) {
    unsigned id = 0;
    glGenBuffers(1, &id);
    Buffer buffer(id);
    glBindBuffer(GL_ARRAY_BUFFER, id);
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(bytes.size()), bytes.data(),
                 GL_STATIC_DRAW);
    if (glGetError() == GL_OUT_OF_MEMORY)
        throw GpuUnavailable("the device is out of memory for " + label + " (" +
                             std::to_string(bytes.size()) + " bytes)");
    glObjectLabel(GL_BUFFER, id, static_cast<GLsizei>(label.size()), label.c_str());
    return buffer;
}

Program make_program(const std::string& name) {
    return make_program(name, name);
}

Program make_program(const std::string& vertex, const std::string& fragment) {
    Program program(glCreateProgram());
    attach(program, GL_VERTEX_SHADER, vertex + ".vert");
    attach(program, GL_FRAGMENT_SHADER, fragment + ".frag");
    glLinkProgram(program.id());
    int ok = 0;
    glGetProgramiv(program.id(), GL_LINK_STATUS, &ok);
    if (!ok)
        throw GpuUnavailable("the shaders " + vertex + ".vert and " + fragment +
                             ".frag do not link");
    return program;
}

}  // namespace vesselbench
