#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "gpu/device.h"
#include "gpu/device_table.h"
#include "gpu/objects.h"

namespace vesselbench {

/// Work-group size of all compute shaders (gpu/shaders/elements.glsl).
constexpr std::size_t kGroupSize = 256;

/// A linked program from the text of gpu/shaders/<name>.comp and its includes.
/// \param wide defines WIDE: tables are read through their views (DeviceTable)
/// \throw GpuUnavailable with file, line and message if the shader does not compile or link
[[nodiscard]] Program make_compute_program(const Device& device, const std::string& name,
                                           bool wide = false);

/// A buffer for shaders with undefined content.
/// \throw GpuUnavailable if it is larger than a shader may use, or the device is out of memory
[[nodiscard]] Buffer make_storage(const Device& device, std::size_t bytes,
                                  const std::string& label);

/// A buffer for shaders with the bytes of an array of plain values.
/// \throw GpuUnavailable as above
template <class T>
[[nodiscard]] Buffer make_storage(const Device& device, std::span<const T> values,
                                  const std::string& label);

/// A read-only table of values of 4, 8 or 16 bytes.
/// \param wide gives it a view
/// \throw GpuUnavailable if it does not fit, as a buffer or a view
template <class T>
[[nodiscard]] DeviceTable make_table(const Device& device, std::span<const T> values, bool wide,
                                     const std::string& label);

/// A buffer that its device's next user gets when this one has ended, because allocating takes
/// longer than what is done with it. As a Buffer, it ends while its context is current.
class PooledBuffer {
public:
    PooledBuffer() = default;

    /// \throw GpuUnavailable as make_storage
    PooledBuffer(const Device& device, std::size_t bytes, const std::string& label);

    /// Takes a buffer of this size.
    PooledBuffer(const Device& device, std::size_t bytes, Buffer buffer);
    ~PooledBuffer();
    PooledBuffer(PooledBuffer&& other) noexcept = default;
    PooledBuffer& operator=(PooledBuffer&& other) noexcept;

    operator const Buffer&() const { return buffer_; }  // NOLINT: it is one

    [[nodiscard]] const Buffer* get() const { return &buffer_; }

    [[nodiscard]] bool has_value() const { return buffer_.id() != 0; }

private:
    std::shared_ptr<DeviceStore> store_;
    std::size_t bytes_ = 0;
    Buffer buffer_;
};

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

/// What a binding gets: a buffer, a table or its view, or null to keep what it has.
struct Bound {
    Bound(std::nullptr_t) {}

    Bound(const Buffer* storage) : buffer(storage) {}

    Bound(const PooledBuffer* storage) : buffer(storage != nullptr ? storage->get() : nullptr) {}

    Bound(const DeviceTable* table)
        : buffer(table->wide() ? nullptr : &table->buffer),
          view(table->wide() ? &table->view : nullptr) {}

    const Buffer* buffer = nullptr;
    const Texture* view = nullptr;
};

/// Binds to bindings 0, 1, 2 ... of the shaders; views are bound to the texture unit of that
/// number.
void bind_storage(std::initializer_list<Bound> all);

/// Binds a table's view to a texture unit.
void bind_view(unsigned unit, const DeviceTable& table);

/// What may run beside a dispatch.
enum class Then {
    Wait,  ///< nothing
    GoOn   ///< the next dispatch, which reads nothing that this one writes, and writes nothing it
           ///< uses
};

/// Number of work groups in a dispatch of this many elements.
[[nodiscard]] std::size_t group_count(std::size_t elements);

/// Runs a program on `elements` elements, after its uniforms and buffers are set; uniform 0
/// receives their number. A failure is found when something is read.
/// \param then whether its writes are visible to every later command, which then waits for it
void dispatch(const Device& device, const Program& program, std::size_t elements,
              Then then = Then::Wait);

/// The same with one work group for all elements.
void dispatch_group(const Device& device, const Program& program, std::size_t elements,
                    Then then = Then::Wait);

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
[[nodiscard]] DeviceTable make_wide_table(const Device& device, std::span<const std::byte> bytes,
                                          std::size_t value_bytes, const std::string& label);
void read_bytes(const Device& device, const Buffer& buffer, std::span<std::byte> bytes);
}  // namespace detail

template <class T>
Buffer make_storage(const Device& device, std::span<const T> values, const std::string& label) {
    return detail::make_filled_storage(device, std::as_bytes(values), label);
}

template <class T>
DeviceTable make_table(const Device& device, std::span<const T> values, bool wide,
                       const std::string& label) {
    static_assert(sizeof(T) == 4 || sizeof(T) == 8 || sizeof(T) == 16);
    if (wide) return detail::make_wide_table(device, std::as_bytes(values), sizeof(T), label);
    return {make_storage(device, values, label)};
}

template <class T>
std::vector<T> read_storage(const Device& device, const Buffer& buffer, std::size_t count) {
    std::vector<T> values(count);
    detail::read_bytes(device, buffer, std::as_writable_bytes(std::span(values)));
    return values;
}

}  // namespace vesselbench
