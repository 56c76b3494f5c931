#include "gpu/render/vertex_buffers.h"

#include <epoxy/gl.h>

#include "gpu/drawing_errors.h"
#include "gpu/render/drawing_arrays.h"

namespace vesselbench {

namespace {

/// Unchanged elements between changed ones are uploaded with them: a call costs as much as some
/// 10 KB.
constexpr std::uint32_t kGap = 512;

}  // namespace

void float_attribute(unsigned place, const Buffer& buffer, int numbers, std::size_t stride,
                     std::size_t offset) {
    glBindBuffer(GL_ARRAY_BUFFER, buffer.id());
    glEnableVertexAttribArray(place);
    glVertexAttribPointer(place, numbers, GL_FLOAT, GL_FALSE, static_cast<GLsizei>(stride),
                          reinterpret_cast<const void*>(offset));
}

std::size_t DrawnEdges::bind(const Topology& topology, const DeviceOrder& order) {
    if (!buffer_) {
        auto edges = unique_edges(topology);
        for (auto& [a, b] : edges) {
            a = order.place_of(a);
            b = order.place_of(b);
        }
        buffer_ = make_buffer(bytes_of(edges), "drawn edges");
        count_ = edges.size();
    }
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffer_->id());
    return count_;
}

void upload_all(const Buffer& buffer, std::span<const std::byte> all) {
    forget_drawing_errors();
    glBindBuffer(GL_ARRAY_BUFFER, buffer.id());
    glBufferSubData(GL_ARRAY_BUFFER, 0, static_cast<GLsizeiptr>(all.size()), all.data());
    require_drawn("changes of a drawing");
}

void upload_parts(const Buffer& buffer, std::span<const std::byte> all, std::size_t size,
                  std::span<const std::uint32_t> changed) {
    forget_drawing_errors();
    glBindBuffer(GL_ARRAY_BUFFER, buffer.id());
    for (std::size_t first = 0; first < changed.size();) {
        std::size_t last = first;
        while (last + 1 < changed.size() && changed[last + 1] - changed[last] <= kGap) ++last;
        const auto part =
            all.subspan(changed[first] * size, (changed[last] - changed[first] + 1) * size);
        glBufferSubData(GL_ARRAY_BUFFER, static_cast<GLintptr>(changed[first] * size),
                        static_cast<GLsizeiptr>(part.size()), part.data());
        first = last + 1;
    }
    require_drawn("changes of a drawing");
}

}  // namespace vesselbench
