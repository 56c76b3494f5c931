#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/kernel/topology.h"
#include "smoothing/filters/linear_step.h"

namespace vesselbench {

/// The neighbours of every vertex in cyclic order: n triangles (v, u[k], u[k + 1]) have n + 1
/// entries; in a closed ring the last entry repeats the first.
struct Fans {
    std::vector<std::uint32_t> offsets;   ///< #V + 1
    std::vector<std::uint32_t> members;   ///< place of each neighbour
    std::vector<std::uint8_t> irregular;  ///< 1: no single fan (its only entry is itself), #V
    bool any_irregular = false;
};

[[nodiscard]] Fans make_fans(const Topology& topology);

/// Outcome of the search in a vertex's ring.
enum class RingState : std::uint8_t {
    Known,   ///< its distance is known
    Drifts,  ///< a neighbour of the reference is closer: continue with another reference
    Outer,   ///< the closest point is on the ring's outer edge: continue beyond it
    Unknown  ///< the reference has no fan
};

/// Vertices and the references whose rings are searched.
struct RingQuery {
    const PackRow* original = nullptr;          ///< positions, #V
    const PackRow* moved = nullptr;             ///< positions, #V
    const std::uint32_t* vertices = nullptr;    ///< count of them
    const std::uint32_t* references = nullptr;  ///< count
    std::size_t count = 0;
};

struct RingAnswer {
    double* distances = nullptr;  ///< to the closest point of the ring [mm], count
    double* planes = nullptr;     ///< largest distance to the triangles' planes; null: not required
    RingState* states = nullptr;  ///< count
};

/// Distances of moved vertices from the original triangles around their references. Four vertices
/// at a time, each in its own lane; the bits do not depend on the width of the registers. With d
/// measured from the reference, squared distances are |d|^2 minus the gain of projecting onto a
/// triangle or an edge; gains are compared as fractions, so that one division serves all of them.
void find_ring_distances(const Fans& fans, const RingQuery& query, const RingAnswer& answer);

/// Sums over some vertices of a surface.
struct CurvatureSums {
    double curvature = 0.0;      ///< of H A [mm]
    double curvature_abs = 0.0;  ///< of |H| A [mm]
    double volume = 0.0;         ///< 18 times the vertices' contributions to the volume [mm^3]
};

/// \param interior 1 where the curvature counts, else 0; #V
/// \param origin of the volumes, as a pack
[[nodiscard]] CurvatureSums curvature_sums(const Fans& fans, const PackRow* positions,
                                           const std::uint32_t* vertices, std::size_t count,
                                           const double* interior, const PackRow& origin);

/// A sum of unit normals times angles below this is the rounding remainder of normals that cancel
/// each other: none, as in vertex_normals [rad].
constexpr double kLeastNormal = 1e-9;

/// Normal curvature of some vertices: the largest angle between a vertex's normal, its triangles'
/// normals weighted by their angles there, and these [rad]. Angles are good to 1e-9. 0 without a
/// normal or a fan.
void find_normal_angles(const Fans& fans, const PackRow* positions, const std::uint32_t* vertices,
                        std::size_t count, double* angles);

/// Six times the volume between triangles and the origin [mm^3].
[[nodiscard]] double six_volumes(const PackRow* positions, std::span<const Triangle> triangles,
                                 const PackRow& origin);

}  // namespace vesselbench
