#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "geometry/kernel/content_key.h"
#include "geometry/kernel/triangles.h"

namespace vesselbench {

struct OneRings;

/// Connectivity of a triangle surface: immutable, shared by all states that differ only in shape.
/// Neighbour arrays are computed once, on first use, from any thread; topologies of equal content
/// share them (derived_cache.h). Degenerate and non-manifold triangles are allowed here; functions
/// that need a manifold say so.
class Topology {
public:
    /// \throw InvalidInput if a triangle names a vertex >= vertex_count
    Topology(std::vector<Triangle> triangles, std::size_t vertex_count);
    ~Topology();

    [[nodiscard]] std::span<const Triangle> triangles() const { return triangles_; }

    [[nodiscard]] std::size_t triangle_count() const { return triangles_.size(); }

    [[nodiscard]] std::size_t vertex_count() const { return vertex_count_; }

    /// Key of the triangles and the number of vertices; computed on first use.
    [[nodiscard]] const ContentKey& key() const;

    /// One-ring neighbours of every vertex, each row ascending and without repetition.
    [[nodiscard]] const CompressedRows& rings() const;

    /// Triangles at every vertex, each row ascending.
    [[nodiscard]] const CompressedRows& triangles_at() const;

    /// 1 if a vertex is on an edge with exactly one triangle, #V.
    [[nodiscard]] const std::vector<std::uint8_t>& boundary_vertices() const;

    /// Closed loops of boundary vertices, each in the direction of its triangles' half-edges;
    /// several loops that meet at one vertex are separated there.
    [[nodiscard]] std::vector<std::vector<VertexId>> boundary_loops() const;

private:
    const OneRings& one_rings() const;

    std::vector<Triangle> triangles_;
    std::size_t vertex_count_ = 0;
    mutable std::once_flag key_once_, rings_once_, triangles_once_;
    mutable ContentKey key_;
    mutable std::shared_ptr<const OneRings> one_rings_;
    mutable std::shared_ptr<const CompressedRows> triangles_at_;
};

/// The key of a topology of these triangles.
[[nodiscard]] ContentKey topology_key(std::span<const Triangle> triangles,
                                      std::size_t vertex_count);

}  // namespace vesselbench
