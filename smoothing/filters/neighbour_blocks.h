#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/kernel/large_array.h"
#include "geometry/kernel/topology.h"
#include "geometry/kernel/vec3.h"

namespace vesselbench {

/// Vertices of one block that have the same number of neighbours.
struct BlockGroup {
    std::uint32_t valence = 0;
    std::uint32_t count = 0;
};

/// The neighbours of every vertex, laid out for filters that sum them repeatedly: blocks of
/// consecutive places; within a block the vertices are grouped by valence, so that the inner loop
/// has a fixed length and no branch to mispredict. A place is a vertex's rank in an order that
/// follows the mesh (mesh_order.h), so that neighbours are close to each other in memory.
class NeighbourBlocks {
public:
    static constexpr std::size_t kBlock = 512;  ///< places in a block

    explicit NeighbourBlocks(const CompressedRows& neighbours);

    [[nodiscard]] std::size_t vertex_count() const { return vertex_count_; }

    [[nodiscard]] std::size_t block_count() const { return group_offsets_.size() - 1; }

    /// Largest distance of a neighbour, in blocks.
    [[nodiscard]] std::size_t reach() const { return reach_; }

    /// Vertex at every place; empty where places are vertices.
    [[nodiscard]] std::span<const VertexId> order() const { return order_; }

    [[nodiscard]] std::size_t vertex_at(std::size_t place) const {
        return order_.empty() ? place : order_[place];
    }

    [[nodiscard]] std::span<const BlockGroup> groups(std::size_t block) const {
        return {groups_.data() + group_offsets_[block], groups_.data() + group_offsets_[block + 1]};
    }

    /// Members of the block's groups, one group after the other: places, relative to the block.
    [[nodiscard]] const std::uint16_t* members(std::size_t block) const {
        return members_.data() + block * kBlock;
    }

    /// Neighbours of the members, one member after the other, in the ascending order of the
    /// vertices: each as four times its place, which is where its four doubles begin.
    [[nodiscard]] const std::uint32_t* neighbours(std::size_t block) const {
        return neighbours_.data() + neighbour_offsets_[block];
    }

private:
    std::size_t fill(const CompressedRows& rows, std::span<const std::uint32_t> places);
    std::vector<BlockGroup> fill_groups(const CompressedRows& rows, std::size_t block);
    std::size_t fill_neighbours(const CompressedRows& rows, std::size_t block);
    std::size_t fill_neighbours(const CompressedRows& rows, std::span<const std::uint32_t> places,
                                std::size_t block);

    std::size_t vertex_count_ = 0;
    std::size_t reach_ = 0;
    std::vector<VertexId> order_;
    std::vector<BlockGroup> groups_;
    std::vector<std::uint32_t> group_offsets_;  ///< #blocks + 1
    LargeArray<std::uint16_t> members_;         ///< #blocks * kBlock
    LargeArray<std::uint32_t> neighbours_;
    std::vector<std::uint32_t> neighbour_offsets_;  ///< #blocks + 1
};

}  // namespace vesselbench
