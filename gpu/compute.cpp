#include "gpu/compute.h"

#include <algorithm>
#include <utility>

#include <epoxy/gl.h>

#include "geometry/kernel/errors.h"
#include "gpu/attach_shader.h"
#include "gpu/device_store.h"

namespace vesselbench {

namespace {

/// Errors that earlier commands have left.
void collect_errors(const Device& device) {
    constexpr int kMost = 8;  // a lost context reports its own error forever
    for (int i = 0; i < kMost; ++i) {
        const unsigned error = glGetError();
        if (error == GL_NO_ERROR) return;
        device.health->fail(error == GL_OUT_OF_MEMORY
                                ? "the device ran out of memory"
                                : "the driver refused a command (OpenGL error " +
                                      std::to_string(error) + ")");
    }
}

/// True if a test wants this command to fail.
bool fails_by_intent(const Device& device, DeviceCommand command) {
    return device.fails && device.fails(command);
}

/// A failure of a command that is noticed when something is read.
bool skipped(const Device& device, DeviceCommand command) {
    const bool skip = fails_by_intent(device, command);
    if (skip) device.health->fail("the driver did not run a command");
    return skip;
}

/// Later commands see what dispatches have written.
void wait_for_writes(const Device& device) {
    ++device.counts->barriers;
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

/// Drawing expects unit 0 to be active.
void bind_texture(unsigned unit, const Texture& texture) {
    glActiveTexture(GL_TEXTURE0 + unit);
    glBindTexture(GL_TEXTURE_BUFFER, texture.id());
    glActiveTexture(GL_TEXTURE0);
}

[[noreturn]] void report_out_of_memory(const std::string& label, std::size_t bytes) {
    throw GpuUnavailable("the device is out of memory for " + label + " (" + std::to_string(bytes) +
                         " bytes)");
}

/// Defines the content of the buffer that is bound to a target.
void allocate(const Device& device, unsigned target, std::size_t bytes, const void* content,
              const std::string& label) {
    collect_errors(device);
    ++device.counts->allocations;
    if (content != nullptr) device.counts->uploaded += bytes;
    glBufferData(target, static_cast<GLsizeiptr>(bytes), content, GL_STATIC_COPY);
    if (fails_by_intent(device, DeviceCommand::Allocate) || glGetError() != GL_NO_ERROR)
        report_out_of_memory(label, bytes);
}

void require_fits(const Device& device, std::size_t bytes, const std::string& label) {
    if (bytes <= device.limits.largest_storage_block) return;
    throw GpuUnavailable(label + " takes " + std::to_string(bytes) + " bytes; the device allows " +
                         std::to_string(device.limits.largest_storage_block) + " in a buffer");
}

Buffer allocated(const Device& device, std::size_t bytes, const void* content,
                 const std::string& label) {
    unsigned id = 0;
    glGenBuffers(1, &id);
    Buffer buffer(id);
    glBindBuffer(GL_SHADER_STORAGE_BUFFER, id);
    // an empty buffer cannot be bound
    allocate(device, GL_SHADER_STORAGE_BUFFER, std::max<std::size_t>(bytes, 16),
             bytes == 0 ? nullptr : content, label);
    glObjectLabel(GL_BUFFER, id, static_cast<GLsizei>(label.size()), label.c_str());
    return buffer;
}

std::string link_log(unsigned program) {
    char log[8192] = "";
    glGetProgramInfoLog(program, sizeof log, nullptr, log);
    return log;
}

}  // namespace

Program make_compute_program(const Device& device, const std::string& name, bool wide) {
    ++device.counts->compiles;
    Program program(glCreateProgram());
    const ShaderSource source = attach_shader(program.id(), GL_COMPUTE_SHADER, *device.shaders,
                                              name + ".comp", wide ? "#define WIDE\n" : "");
    int ok = 0;
    glLinkProgram(program.id());
    glGetProgramiv(program.id(), GL_LINK_STATUS, &ok);
    if (!ok)
        throw GpuUnavailable("the shader " + name + ".comp does not link:\n" +
                             explained_log(*device.shaders, source, link_log(program.id())));
    return program;
}

Buffer make_storage(const Device& device, std::size_t bytes, const std::string& label) {
    require_fits(device, bytes, label);
    return allocated(device, bytes, nullptr, label);
}

PooledBuffer::PooledBuffer(const Device& device, std::size_t bytes, const std::string& label)
    : store_(device.store), bytes_(bytes), buffer_(store_->take(bytes)) {
    if (buffer_.id() == 0) buffer_ = make_storage(device, bytes, label);
}

PooledBuffer::PooledBuffer(const Device& device, std::size_t bytes, Buffer buffer)
    : store_(device.store), bytes_(bytes), buffer_(std::move(buffer)) {}

PooledBuffer::~PooledBuffer() {
    if (buffer_.id() != 0) store_->keep(bytes_, std::move(buffer_));
}

PooledBuffer& PooledBuffer::operator=(PooledBuffer&& other) noexcept {
    std::swap(store_, other.store_);
    std::swap(bytes_, other.bytes_);
    std::swap(buffer_, other.buffer_);
    return *this;
}

void copy_storage(const Device& device, const Buffer& from, const Buffer& to, std::size_t bytes) {
    if (skipped(device, DeviceCommand::Copy)) return;
    device.counts->copied += bytes;
    glBindBuffer(GL_COPY_READ_BUFFER, from.id());
    glBindBuffer(GL_COPY_WRITE_BUFFER, to.id());
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glCopyBufferSubData(GL_COPY_READ_BUFFER, GL_COPY_WRITE_BUFFER, 0, 0,
                        static_cast<GLsizeiptr>(bytes));
}

void fill_storage(const Device& device, const Buffer& buffer, std::uint32_t word) {
    if (skipped(device, DeviceCommand::Fill)) return;
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glBindBuffer(GL_COPY_WRITE_BUFFER, buffer.id());
    glClearBufferData(GL_COPY_WRITE_BUFFER, GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, &word);
}

void bind_storage(std::initializer_list<Bound> all) {
    unsigned binding = 0;
    for (const Bound& bound : all) {
        if (bound.buffer != nullptr)
            glBindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, bound.buffer->id());
        if (bound.view != nullptr) bind_texture(binding, *bound.view);
        ++binding;
    }
}

void bind_view(unsigned unit, const DeviceTable& table) {
    bind_texture(unit, table.view);
}

std::size_t group_count(std::size_t elements) {
    return (elements + kGroupSize - 1) / kGroupSize;
}

void dispatch(const Device& device, const Program& program, std::size_t elements, Then then) {
    if (elements == 0 || skipped(device, DeviceCommand::Dispatch)) return;
    const std::size_t groups = group_count(elements);
    const std::size_t rows =
        (groups + device.limits.largest_group_count - 1) / device.limits.largest_group_count;
    const std::size_t in_row = (groups + rows - 1) / rows;
    glUseProgram(program.id());
    glUniform1ui(0, static_cast<unsigned>(elements));
    glDispatchCompute(static_cast<unsigned>(in_row), static_cast<unsigned>(rows), 1);
    ++device.counts->dispatches;
    if (then == Then::Wait) wait_for_writes(device);
}

void dispatch_group(const Device& device, const Program& program, std::size_t elements, Then then) {
    if (skipped(device, DeviceCommand::Dispatch)) return;
    glUseProgram(program.id());
    glUniform1ui(0, static_cast<unsigned>(elements));
    glDispatchCompute(1, 1, 1);
    ++device.counts->dispatches;
    if (then == Then::Wait) wait_for_writes(device);
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
    require_fits(device, bytes.size(), label);
    return allocated(device, bytes.size(), bytes.data(), label);
}

DeviceTable make_wide_table(const Device& device, std::span<const std::byte> bytes,
                            std::size_t value_bytes, const std::string& label) {
    const std::size_t values = bytes.size() / value_bytes;
    if (values > device.limits.largest_view)
        throw GpuUnavailable(label + " has " + std::to_string(values) +
                             " values; the device allows " +
                             std::to_string(device.limits.largest_view) + " in a texture");
    DeviceTable table{allocated(device, bytes.size(), bytes.data(), label)};
    unsigned id = 0;
    glGenTextures(1, &id);
    table.view = Texture(id);
    glBindTexture(GL_TEXTURE_BUFFER, id);
    const unsigned format = value_bytes == 4   ? GL_R32UI
                            : value_bytes == 8 ? GL_RG32UI
                                               : GL_RGBA32UI;
    glTexBuffer(GL_TEXTURE_BUFFER, format, table.buffer.id());
    glBindTexture(GL_TEXTURE_BUFFER, 0);
    return table;
}

void read_bytes(const Device& device, const Buffer& buffer, std::span<std::byte> bytes) {
    require_context(device);
    if (bytes.empty()) return;
    // Through a second buffer: drivers move a buffer to host memory when it is read.
    unsigned id = 0;
    glGenBuffers(1, &id);
    const Buffer staging(id);
    glBindBuffer(GL_COPY_WRITE_BUFFER, id);
    allocate(device, GL_COPY_WRITE_BUFFER, bytes.size(), nullptr, "reading");
    copy_storage(device, buffer, staging, bytes.size());
    ++device.counts->reads;
    device.counts->read_back += bytes.size();
    if (!skipped(device, DeviceCommand::Read))
        glGetBufferSubData(GL_COPY_WRITE_BUFFER, 0, static_cast<GLsizeiptr>(bytes.size()),
                           bytes.data());
    collect_errors(device);
    require_context(device);
}

}  // namespace detail

}  // namespace vesselbench
