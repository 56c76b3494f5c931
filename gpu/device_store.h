#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include "geometry/kernel/surface.h"
#include "gpu/objects.h"

namespace vesselbench {

struct Device;
class DeviceTopology;

/// What all users of a device share: its compiled programs, buffers that are free for the next
/// user, and the last surface's topology. It belongs to the contexts that share objects with the
/// one that was current at construction. Not thread-safe.
class DeviceStore {
public:
    DeviceStore();

    /// Deletes what it has if one of these contexts is current; else that goes with the last of
    /// them.
    ~DeviceStore();

    DeviceStore(const DeviceStore&) = delete;
    DeviceStore& operator=(const DeviceStore&) = delete;

    /// True if one of these contexts is current on this thread: in any other one, the same names
    /// belong to other objects, or to none.
    [[nodiscard]] bool is_current() const;

    /// A compute program, compiled on first use. Uniforms keep their values from user to user: each
    /// sets all that its program has.
    /// \param wide reads tables through textures (DeviceTable)
    /// \throw GpuUnavailable as make_compute_program
    [[nodiscard]] const Program& program(const Device& device, const std::string& name, bool wide);

    /// A free buffer of exactly this size with undefined content; none: 0.
    [[nodiscard]] Buffer take(std::size_t bytes);

    /// Keeps a buffer for the next user. The oldest free ones are deleted.
    void keep(std::size_t bytes, Buffer buffer);

    /// A surface's topology on the device. The last one stays after its surface has gone, because
    /// the next one often has the same.
    [[nodiscard]] std::shared_ptr<const DeviceTopology> topology(
        const Device& device, const std::shared_ptr<const Topology>& topology);

private:
    struct FreeBuffer {
        std::size_t bytes = 0;
        Buffer buffer;
    };

    [[nodiscard]] std::string mark() const;

    bool of_egl_ = false;
    Buffer mark_;  ///< labelled, to recognise the contexts
    std::map<std::tuple<const void*, std::string, bool>, Program> programs_;  ///< by their texts
    std::vector<FreeBuffer> free_;                                            ///< oldest first
    std::shared_ptr<const DeviceTopology> topology_;
};

}  // namespace vesselbench
