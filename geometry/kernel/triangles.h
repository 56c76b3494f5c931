#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace vesselbench {

using VertexId = std::uint32_t;
using TriangleId = std::uint32_t;

/// Vertex indices in counter-clockwise order seen from outside.
using Triangle = std::array<VertexId, 3>;

/// Rows of indices of different length in one flat array (compressed row storage).
struct CompressedRows {
    std::vector<std::uint32_t> offsets;  ///< #rows + 1
    std::vector<std::uint32_t> values;

    [[nodiscard]] std::span<const std::uint32_t> row(std::size_t i) const {
        return {values.data() + offsets[i], values.data() + offsets[i + 1]};
    }

    [[nodiscard]] std::size_t bytes() const {
        return (offsets.size() + values.size()) * sizeof(std::uint32_t);
    }
};

}  // namespace vesselbench
