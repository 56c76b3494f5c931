#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "geometry/kernel/surface.h"
#include "gpu/device_order.h"
#include "gpu/objects.h"

namespace vesselbench {

/// Attributes of the bound vertex array, from a buffer of floats.
/// \param stride from one vertex to the next [bytes]; 0: close together
void float_attribute(unsigned place, const Buffer& buffer, int numbers, std::size_t stride = 0,
                     std::size_t offset = 0);

/// The bytes of values for make_buffer.
template <class T>
[[nodiscard]] std::span<const std::byte> bytes_of(const std::vector<T>& values) {
    return std::as_bytes(std::span(values));
}

/// Uploads an array that is as long as the buffer. \throw GpuUnavailable if the driver refuses
void upload_all(const Buffer& buffer, std::span<const std::byte> all);

/// Uploads elements of an array whose indices are ascending: a few contiguous parts instead of
/// single ones.
/// \param size of one element [bytes]
/// \throw GpuUnavailable as above
void upload_parts(const Buffer& buffer, std::span<const std::byte> all, std::size_t size,
                  std::span<const std::uint32_t> changed);

/// The edges of a surface as elements of a vertex array, uploaded on first use.
class DrawnEdges {
public:
    /// Binds them to the vertex array that is bound. \return their number
    std::size_t bind(const Topology& topology, const DeviceOrder& order = {});

private:
    std::optional<Buffer> buffer_;
    std::size_t count_ = 0;
};

}  // namespace vesselbench
