#include "gpu/compute.h"

#include <algorithm>

#include <epoxy/gl.h>

#include "geometry/kernel/errors.h"
#include "gpu/shader_source.h"

namespace vesselbench {

namespace {

/// Errors of earlier calls; a lost context reports its own error forever.
void forget_errors() {
    for (int i = 0; i < 8 && glGetError() != GL_NO_ERROR; ++i) {
    }
}

Buffer allocated(const Device& device, std::size_t bytes, const void* content,
                 const std::string& label) {
    if (bytes > device.limits.largest_storage_block)
        throw GpuUnavailable(label + " takes " + std::to_string(bytes) +
                             " bytes; the device allows " +
                             std::to_string(device.limits.largest_storage_block) + " in a buffer");
    forget_errors();
    unsigned id = 0;
    glGenBuffers(1, &id);
    Buffer buffer(id);
    glBindBuffer(GL_SHADER_STORAGE_BUFFER, id);
    // an empty buffer cannot be bound
    glBufferData(GL_SHADER_STORAGE_BUFFER,
                 static_cast<GLsizeiptr>(std::max<std::size_t>(bytes, 16)),
                 bytes == 0 ? nullptr : content, GL_STATIC_COPY);
    if (glGetError() != GL_NO_ERROR)
        throw GpuUnavailable("the device is out of memory for " + label + " (" +
                             std::to_string(bytes) + " bytes)");
    glObjectLabel(GL_BUFFER, id, static_cast<GLsizei>(label.size()), label.c_str());
    return buffer;
}

std::string info_log(unsigned id, bool linked) {
    char log[8192] = "";
    if (linked)
        glGetProgramInfoLog(id, sizeof log, nullptr, log);
    else
        glGetShaderInfoLog(id, sizeof log, nullptr, log);
    return log;
}

}  // namespace

Program make_compute_program(const Device& device, const std::string& name) {
    const ShaderSource source = assemble_shader(*device.shaders, name + ".comp");
    Program program(glCreateProgram());
    const unsigned shader = glCreateShader(GL_COMPUTE_SHADER);
    const char* text = source.text.c_str();
    glShaderSource(shader, 1, &text, nullptr);
    glCompileShader(shader);
    glAttachShader(program.id(), shader);
    glDeleteShader(shader);  // lives on while attached
    int ok = 0;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &ok);
    if (!ok)
        throw GpuUnavailable("the shader " + name + ".comp does not compile:\n" +
                             explained_log(*device.shaders, source, info_log(shader, false)));
    glLinkProgram(program.id());
    glGetProgramiv(program.id(), GL_LINK_STATUS, &ok);
    if (!ok)
        throw GpuUnavailable("the shader " + name + ".comp does not link:\n" +
                             explained_log(*device.shaders, source, info_log(program.id(), true)));
    return program;
}

Buffer make_storage(const Device& device, std::size_t bytes, const std::string& label) {
    return allocated(device, bytes, nullptr, label);
}

void copy_storage(const Buffer& from, const Buffer& to, std::size_t bytes) {
    glBindBuffer(GL_COPY_READ_BUFFER, from.id());
    glBindBuffer(GL_COPY_WRITE_BUFFER, to.id());
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glCopyBufferSubData(GL_COPY_READ_BUFFER, GL_COPY_WRITE_BUFFER, 0, 0,
                        static_cast<GLsizeiptr>(bytes));
}

void fill_storage(const Buffer& buffer, std::uint32_t word) {
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glBindBuffer(GL_COPY_WRITE_BUFFER, buffer.id());
    glClearBufferData(GL_COPY_WRITE_BUFFER, GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, &word);
}

void bind_storage(std::initializer_list<const Buffer*> buffers) {
    unsigned binding = 0;
    for (const Buffer* buffer : buffers) {
        if (buffer != nullptr) glBindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, buffer->id());
        ++binding;
    }
}

std::size_t group_count(std::size_t elements) {
    return (elements + kGroupSize - 1) / kGroupSize;
}

void dispatch(const Device& device, const Program& program, std::size_t elements) {
    if (elements == 0) return;
    const std::size_t groups = group_count(elements);
    const std::size_t rows =
        (groups + device.limits.largest_group_count - 1) / device.limits.largest_group_count;
    const std::size_t in_row = (groups + rows - 1) / rows;
    glUseProgram(program.id());
    glUniform1ui(0, static_cast<unsigned>(elements));
    glDispatchCompute(static_cast<unsigned>(in_row), static_cast<unsigned>(rows), 1);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

void dispatch_group(const Program& program, std::size_t elements) {
    glUseProgram(program.id());
    glUniform1ui(0, static_cast<unsigned>(elements));
    glDispatchCompute(1, 1, 1);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

void finish_device() {
    glFinish();
}

DeviceTimer::DeviceTimer() {
    unsigned id = 0;
    glGenQueries(1, &id);
    query_ = Query(id);
}

void DeviceTimer::start() const {
    glBeginQuery(GL_TIME_ELAPSED, query_.id());
}

void DeviceTimer::stop() const {
    glEndQuery(GL_TIME_ELAPSED);
}

double DeviceTimer::milliseconds() const {
    GLuint64 nanoseconds = 0;
    glGetQueryObjectui64v(query_.id(), GL_QUERY_RESULT, &nanoseconds);
    return 1e-6 * static_cast<double>(nanoseconds);
}

namespace detail {

Buffer make_filled_storage(const Device& device, std::span<const std::byte> bytes,
                           const std::string& label) {
    return allocated(device, bytes.size(), bytes.data(), label);
}

void read_bytes(const Buffer& buffer, std::span<std::byte> bytes) {
    if (bytes.empty()) return;
    // Through a second buffer: drivers move a buffer to host memory when it is read.
    unsigned id = 0;
    glGenBuffers(1, &id);
    const Buffer staging(id);
    const auto size = static_cast<GLsizeiptr>(bytes.size());
    glBindBuffer(GL_COPY_WRITE_BUFFER, id);
    glBufferData(GL_COPY_WRITE_BUFFER, size, nullptr, GL_STREAM_READ);
    copy_storage(buffer, staging, bytes.size());
    glGetBufferSubData(GL_COPY_WRITE_BUFFER, 0, size, bytes.data());
}

}  // namespace detail

}  // namespace vesselbench
