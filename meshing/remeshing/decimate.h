#pragma once

#include <optional>
#include <span>

#include "geometry/kernel/progress.h"
#include "geometry/kernel/surface.h"

namespace vesselbench {

/// When decimation stops: at whichever limit is reached first.
struct DecimateParameters {
    std::optional<std::size_t> triangles = {};  ///< at most this many are left, > 0
    /// Largest distance of the source's samples from the result, and vice versa, times the weight
    /// [mm], > 0. Samples are about half of the source's mean edge apart, in triangles longer than
    /// 12 mean edges a 24th of the longest edge. If compare_with_reference finds more between them,
    /// decimation restarts with a smaller limit.
    std::optional<double> max_error = {};
};

/// Figures of a decimation.
struct DecimateReport {
    std::size_t triangles_before = 0, triangles_after = 0;
    std::size_t kept_vertices_lost = 0;  ///< of weight 0, removed or moved
    std::size_t vertices_locked = 0;     ///< kept, because walls would cross near them
    bool target_reached = true;          ///< at most the requested number of triangles is left
    std::size_t crossings_left = 0;      ///< pairs of triangles that newly cross
    Vec3 crossing = Vec3::Zero();        ///< place of the first of them [mm]
};

struct Decimated {
    Surface surface;
    DecimateReport report;
};

/// Reduces the number of triangles by edge collapses, those that change the surface least first. A
/// quadric sums the squared distances from the planes of all triangles merged into a vertex, times
/// their areas; inside a patch the vertex moves to its minimum. Borders of patches and open
/// boundaries lose vertices, but the remaining ones do not move; flat caps stay flat. Manifold and
/// components are preserved, and new crossings are avoided if possible. Attributes are interpolated
/// at the closest point. Weights enlarge the quadrics of parts to preserve: weight w permits w
/// times the error [mm] of weight 1, down to a tenth. Vertices of weight 0 are not touched before
/// the rest has moved by about a third of an edge, and not at all with a max_error. The same input
/// gives the same bits. Sources: Garland & Heckbert, "Surface simplification using quadric error
/// metrics", SIGGRAPH 1997; if planes are ambiguous: Trettner & Kobbelt, "Fast and robust QEF
/// minimization using probabilistic quadrics", Eurographics 2020; weights: thesis 5.6 and 7.2.
/// \param weights per vertex, in [0, 1]; empty: 1 everywhere
/// \throw InvalidInput if there is no stopping criterion, a parameter or a weight is out of range,
/// a position is not finite, or the surface is not an oriented manifold
[[nodiscard]] Decimated decimate(const Surface& surface, const DecimateParameters& parameters,
                                 std::span<const double> weights = {},
                                 const Progress& progress = {});

}  // namespace vesselbench
