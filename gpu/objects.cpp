#include "gpu/objects.h"

#include <epoxy/gl.h>

#include "geometry/kernel/errors.h"
#include "gpu/attach_shader.h"
#include "gpu/drawing_errors.h"
#include "gpu/shader_texts.h"

namespace vesselbench {

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

void delete_texture(unsigned id) {
    glDeleteTextures(1, &id);
}

VertexArray make_vertex_array() {
    unsigned id = 0;
    glGenVertexArrays(1, &id);
    return VertexArray(id);
}

Renderbuffer make_renderbuffer(unsigned format, int width, int height, int samples) {
    unsigned id = 0;
    glGenRenderbuffers(1, &id);
    Renderbuffer buffer(id);
    glBindRenderbuffer(GL_RENDERBUFFER, id);
    glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples, format, width, height);
    return buffer;
}

Buffer make_buffer(std::span<const std::byte> bytes, const std::string& label) {
    forget_drawing_errors();
    unsigned id = 0;
    glGenBuffers(1, &id);
    Buffer buffer(id);
    glBindBuffer(GL_ARRAY_BUFFER, id);
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(bytes.size()), bytes.data(),
                 GL_STATIC_DRAW);
    require_drawn(label + " (" + std::to_string(bytes.size()) + " bytes)");
    glObjectLabel(GL_BUFFER, id, static_cast<GLsizei>(label.size()), label.c_str());
    return buffer;
}

Program make_program(const std::string& vertex, const std::string& fragment,
                     const std::string& defines) {
    Program program(glCreateProgram());
    attach_shader(program.id(), GL_VERTEX_SHADER, shader_texts(), vertex + ".vert", defines);
    attach_shader(program.id(), GL_FRAGMENT_SHADER, shader_texts(), fragment + ".frag", defines);
    glLinkProgram(program.id());
    int ok = 0;
    glGetProgramiv(program.id(), GL_LINK_STATUS, &ok);
    if (ok) return program;
    char log[4096] = "";
    glGetProgramInfoLog(program.id(), sizeof log, nullptr, log);
    throw GpuUnavailable("the shaders " + vertex + ".vert and " + fragment +
                         ".frag do not link:\n" + log);
}

}  // namespace vesselbench
