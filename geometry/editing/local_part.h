#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/kernel/surface.h"

namespace vesselbench {

/// A part of a surface that is edited for itself and sewn back: what lies outside keeps its bits.
struct LocalPart {
    Surface surface;                 ///< without attributes; the patch table is the whole's
    std::vector<VertexId> vertices;  ///< of the whole, by vertex of the part
    std::vector<std::uint8_t> rim;   ///< 1 where the part meets the rest or ends, by its vertex
};

/// \param marked 1 at the triangles of the part, #T
[[nodiscard]] LocalPart part_of(const Surface& whole, std::span<const std::uint8_t> marked);

/// Adds to a part the other triangles at vertices where its triangles touch in more than one fan,
/// until there is no such vertex: the part of a manifold is then a manifold.
void close_fans(const Surface& whole, std::vector<std::uint8_t>& marked);

/// A part after it was edited.
struct EditedPart {
    Surface surface;  ///< with the whole's patch table
    /// Vertices of the part as it was before, by vertex: they keep their number in the order of the
    /// whole's vertices, their position and their attributes. kNewVertex: it is new or has moved.
    std::vector<VertexId> former;
};

inline constexpr VertexId kNewVertex = static_cast<VertexId>(-1);

/// The whole with the part replaced. Kept vertices and triangles come first, in their order; new
/// vertices follow, with attributes interpolated at the closest point of the part before. Unused
/// vertices and patches are dropped.
/// \param marked, part as given to and made by part_of
/// \throw InvalidInput if a rim vertex of the part is missing in the edited one
[[nodiscard]] Surface sewn(const Surface& whole, std::span<const std::uint8_t> marked,
                           const LocalPart& part, const EditedPart& edited);

}  // namespace vesselbench
