#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "geometry/kernel/surface.h"

namespace vesselbench {

enum class StampMode : std::uint8_t { Subtract, Add };

/// A part of a wall and a tool's body as one surface: of the wall what is outside the tool, and of
/// the tool what is inside (subtracted, turned over) or outside (added) the vessel.
struct Corefined {
    Surface surface;               ///< the part's patch table; the tool's triangles are wall
    std::vector<VertexId> former;  ///< of the part, by vertex; kNewVertex: it is new
    std::vector<std::pair<VertexId, VertexId>> seam;  ///< edges where wall and tool meet
};

/// What makes both surfaces unfit for each other.
enum class CorefinementProblem : std::uint8_t {
    Apart,      ///< they do not meet
    Swallowed,  ///< they do not meet, and the part is inside the tool
    Beyond,     ///< the tool leaves the part through its rim
    Degenerate  ///< they meet in a way that cannot be resolved: touch, or cross themselves
};

/// Cuts a part of a wall and a tool along their intersection, and joins what a Boolean operation of
/// the whole vessel and the tool keeps of both. The part need not be closed.
/// Source: CGAL's Polygon_mesh_processing::corefine (exact decisions, coordinates rounded).
/// \param inside_vessel whether a point is inside the whole vessel
/// \param problem receives why there is no result
[[nodiscard]] std::optional<Corefined> corefined(
    const Surface& part, const Surface& tool, StampMode mode,
    const std::function<bool(const Vec3&)>& inside_vessel, CorefinementProblem& problem);

/// Positions after fairing the given vertices, so that they continue the surface around them.
/// Source: Botsch and Kobbelt, "An intuitive framework for real-time freeform modeling", SIGGRAPH
/// 2004; CGAL's fair.
/// \param vertices inner ones of the surface
/// \param continuity at their border: 0 position, 1 tangent, 2 curvature
/// \return none if the system cannot be solved
[[nodiscard]] std::optional<Positions> faired(const Surface& surface,
                                              std::span<const VertexId> vertices, int continuity);

}  // namespace vesselbench
