#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>
#include <vector>

#include "gpu/device.h"
#include "gpu/objects.h"

namespace vesselbench {

/// Work-group size of all compute shaders (gpu/shaders/elements.glsl).
constexpr std::size_t kGroupSize = 256;

/// A linked program from the text of gpu/shaders/<name>.comp and its includes.
/// \throw GpuUnavailable with file, line and message if the shader does not compile or link
[[nodiscard]] Program make_compute_program(const Device& device, const std::string& name);

/// A buffer for shaders with undefined content.
/// \throw GpuUnavailable if it is larger than a shader may use, or the device is out of memory
[[nodiscard]] Buffer make_storage(const Device& device, std::size_t bytes,
                                  const std::string& label);

/// A buffer for shaders with the bytes of an array of plain values.
/// \throw GpuUnavailable as above
template <class T>
[[nodiscard]] Buffer make_storage(const Device& device, std::span<const T> values,
                                  const std::string& label);

/// Waits for the device and reads a buffer's first elements.
/// \throw GpuUnavailable if that fails, or if any command before has failed
template <class T>
[[nodiscard]] std::vector<T> read_storage(const Device& device, const Buffer& buffer,
                                          std::size_t count);

/// Copies the first bytes of one buffer to another on the device. A failure is found when something
/// is read.
void copy_storage(const Device& device, const Buffer& from, const Buffer& to, std::size_t bytes);

/// Sets all of a buffer's 32-bit words to a number. A failure is found when something is read.
void fill_storage(const Device& device, const Buffer& buffer, std::uint32_t word);

/// Binds buffers to bindings 0, 1, 2 ... of the shaders; a null pointer keeps its binding.
void bind_storage(std::initializer_list<const Buffer*> buffers);

/// Number of work groups in a dispatch of this many elements.
[[nodiscard]] std::size_t group_count(std::size_t elements);

/// Runs a program on `elements` elements, after its uniforms and buffers are set; uniform 0
/// receives their number. Its writes are visible to every later command. A failure is found when
/// something is read.
void dispatch(const Device& device, const Program& program, std::size_t elements);

/// The same with one work group for all elements.
void dispatch_group(const Device& device, const Program& program, std::size_t elements);

/// Waits until the device has completed all commands.
void finish_device();

/// Measures the device time of the commands between start() and stop() [ms].
class DeviceTimer {
public:
    DeviceTimer();
    void start() const;
    void stop() const;
    [[nodiscard]] double milliseconds() const;  ///< waits for the device

private:
    Query query_;
};

namespace detail {
[[nodiscard]] Buffer make_filled_storage(const Device& device, std::span<const std::byte> bytes,
                                         const std::string& label);
void read_bytes(const Device& device, const Buffer& buffer, std::span<std::byte> bytes);
}  // namespace detail

template <class T>
Buffer make_storage(const Device& device, std::span<const T> values, const std::string& label) {
    return detail::make_filled_storage(device, std::as_bytes(values), label);
}

template <class T>
std::vector<T> read_storage(const Device& device, const Buffer& buffer, std::size_t count) {
    std::vector<T> values(count);
    detail::read_bytes(device, buffer, std::as_writable_bytes(std::span(values)));
    return values;
}

}  // namespace vesselbench
