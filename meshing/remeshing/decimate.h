#pragma once

#include <optional>
#include <span>

#include "geometry/kernel/progress.h"
#include "geometry/kernel/surface.h"

namespace vesselbench {

/// When decimation stops: at the first of the two that is reached.
struct DecimateParameters {
    std::optional<std::size_t> triangles = {};  ///< no more than so many are left, > 0
    /// No sample of the source is farther from the result, nor the other way, than this, times its
    /// weight [mm], > 0. Samples are about half of the source's mean edge apart, in triangles
    /// longer than 12 mean edges a 24th of the longest edge. If compare_with_reference finds more
    /// between them, decimation begins anew with a smaller limit.
    std::optional<double> max_error = {};
};

/// What decimation did.
struct DecimateReport {
    std::size_t triangles_before = 0, triangles_after = 0;
    std::size_t kept_vertices_lost = 0;  ///< of weight 0, gone or moved
    std::size_t vertices_locked = 0;     ///< kept as they were, or walls would cross near them
    bool target_reached = true;          ///< no more triangles are left than asked for
    std::size_t crossings_left = 0;      ///< pairs of triangles that cross and did not before
    Vec3 crossing = Vec3::Zero();        ///< where the first of them is [mm]
};

struct Decimated {
    Surface surface;
    DecimateReport report;
};

/// Covers the surface with fewer triangles by collapses of edges, the one that bends the surface
/// least first. A quadric holds the squared distances from the planes of all triangles that have
/// become one vertex, times their areas; inside a patch the vertex goes where that is least.
/// Borders of patches and open boundaries lose vertices, but do not move those that stay; flat
/// caps stay flat. The surface stays the manifold it was, with all its components, and gets no new
/// crossings where that can be had. Attributes are interpolated at the closest point.
/// Weights make the quadrics of what matters larger: what weighs w may get w times the error [mm]
/// of what weighs 1, down to a tenth. Vertices of weight 0 are not touched before the rest has
/// moved by about a third of an edge, nor at all under a max_error. The same input gives the same
/// bits. Sources: Garland & Heckbert, "Surface simplification using quadric error metrics",
/// SIGGRAPH 1997; where planes leave a choice: Trettner & Kobbelt, "Fast and robust QEF
/// minimization using probabilistic quadrics", Eurographics 2020; weights: thesis 5.6 and 7.2.
/// \param weights per vertex, in [0, 1]; empty: 1 everywhere
/// \throw InvalidInput if there is nothing to stop at, a parameter or a weight is out of its range,
///        a position is not finite, or the surface is not an oriented manifold
[[nodiscard]] Decimated decimate(const Surface& surface, const DecimateParameters& parameters,
                                 std::span<const double> weights = {},
                                 const Progress& progress = {});

}  // namespace vesselbench
