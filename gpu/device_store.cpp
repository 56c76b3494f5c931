#include "gpu/device_store.h"

#include <algorithm>
#include <array>
#include <utility>

#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include "gpu/compute.h"
#include "gpu/device_topology.h"

namespace vesselbench {

namespace {

constexpr std::size_t kMostFree = 8;  // buffers, as many as two runs have

}  // namespace

DeviceStore::DeviceStore() : of_egl_(eglGetCurrentContext() != EGL_NO_CONTEXT) {
    unsigned id = 0;
    glGenBuffers(1, &id);
    mark_ = Buffer(id);
    glBindBuffer(GL_COPY_WRITE_BUFFER, id);  // before that, it is no buffer
    const std::string label = mark();
    glObjectLabel(GL_BUFFER, id, static_cast<GLsizei>(label.size()), label.c_str());
}

DeviceStore::~DeviceStore() {
    if (is_current()) return;
    mark_.leave();
    for (auto& [key, program] : programs_) program.leave();
    for (FreeBuffer& free : free_) free.buffer.leave();
    if (topology_.use_count() == 1) topology_->leave();
}

/// Different for all stores there are.
std::string DeviceStore::mark() const {
    return "device " + std::to_string(reinterpret_cast<std::uintptr_t>(this));
}

bool DeviceStore::is_current() const {
    if (of_egl_ && eglGetCurrentContext() == EGL_NO_CONTEXT) return false;
    if (!glIsBuffer(mark_.id())) return false;
    std::array<char, 64> label{};
    glGetObjectLabel(GL_BUFFER, mark_.id(), label.size(), nullptr, label.data());
    return mark() == label.data();
}

const Program& DeviceStore::program(const Device& device, const std::string& name, bool wide) {
    const std::tuple key(static_cast<const void*>(device.shaders), name, wide);
    const auto made = programs_.find(key);
    if (made != programs_.end()) return made->second;
    return programs_.emplace(key, make_compute_program(device, name, wide)).first->second;
}

Buffer DeviceStore::take(std::size_t bytes) {
    const auto free = std::ranges::find(free_, bytes, &FreeBuffer::bytes);
    if (free == free_.end()) return {};
    Buffer buffer = std::move(free->buffer);
    free_.erase(free);
    return buffer;
}

void DeviceStore::keep(std::size_t bytes, Buffer buffer) {
    if (free_.size() >= kMostFree) free_.erase(free_.begin());
    free_.push_back({bytes, std::move(buffer)});
}

std::shared_ptr<const DeviceTopology> DeviceStore::topology(
    const Device& device, const std::shared_ptr<const Topology>& topology) {
    if (!topology_ || !topology_->is_of(device, topology)) {
        topology_.reset();  // its memory may be needed
        topology_ = std::make_shared<const DeviceTopology>(device, topology);
    }
    return topology_;
}

}  // namespace vesselbench
