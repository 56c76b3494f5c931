#pragma once

#include <optional>

#include "geometry/kernel/progress.h"
#include "geometry/kernel/surface.h"
#include "geometry/kernel/triangle_shape.h"
#include "geometry/vessel/centerlines/centerline_graph.h"
#include "meshing/remeshing/held_resolution.h"

namespace vesselbench {

enum class RemeshMode { Graded, Uniform };

struct RemeshParameters {
    RemeshMode mode = RemeshMode::Graded;
    /// Edge length at the vessel's typical radius (the median over the wall's area), in uniform
    /// mode of all edges [mm]; default 0.28 of that radius: 22 triangles around.
    std::optional<double> edge = {};
    /// Graded: shortest edge [mm]; default edge / 5, or 0.28 of the radius of thinner vessels.
    std::optional<double> min_edge = {};
    std::optional<double> max_edge = {};  ///< graded: longest edge [mm]; default 2 edge
    double gradation = 1.5;               ///< graded: largest ratio of neighbouring edges, > 1
    /// Graded, unless `edge` is given: the edges are so long that about this many tetrahedra fill
    /// the lumen, but at least 12 go around the typical vessel [-]; default: not limited.
    std::optional<double> cells = {};
    /// Graded, for prints: longer edges where the surface stays this close [mm]; 0: no
    double resolution = 0.0;
    /// With `resolution`: edges become shorter where the surface would be off by more.
    bool hold_resolution = false;
};

/// Decisions and results of remeshing.
struct RemeshReport {
    double usual_radius = 0.0;              ///< [mm]
    double edge = 0.0;                      ///< [mm]
    double min_edge = 0.0, max_edge = 0.0;  ///< [mm]
    bool limited = false;  ///< edges are longer than usual: there would be too many triangles
    /// Edges are longer than usual because of `cells`, and how many cells are expected; else 0.
    double cells = 0.0;
    std::size_t triangles_before = 0, triangles_after = 0;
    double volume_change = 0.0;  ///< of the enclosed volume, relative to that before [-]
    TriangleShape wall, caps;
    /// Pairs of triangles that crossed where walls almost touch, before the walls were separated
    /// there, and the surface around remeshed again; and the place of the first [mm].
    std::size_t crossings_parted = 0;
    Vec3 crossing = Vec3::Zero();
    /// With `hold_resolution`, where the surface is off by more in spite of shorter edges.
    std::optional<LargestDeviation> beyond_resolution = {};
};

struct Remeshed {
    Surface surface;
    RemeshReport report;
};

/// The edge lengths that remesh() takes, without remeshing: usual_radius, edge, min_edge, max_edge,
/// limited and cells of its report.
/// \throw as remesh()
[[nodiscard]] RemeshReport decided_edges(const Surface& surface, const RemeshParameters& parameters,
                                         const CenterlineGraph* lines = nullptr,
                                         const Progress& progress = {});

/// Remeshes the surface with well-shaped triangles of a target size: graded (small where the
/// vessel is thin, curved, or close to another wall) or uniform. Vertices lie on the input, except
/// for the small lift that restores the volume lost to flat triangles. Patches are kept; rims of
/// caps and open boundaries remain features (on their circle if round, else on their polyline),
/// flat caps stay exactly flat; attributes are interpolated at the closest point.
/// Sources: Botsch & Kobbelt, "A remeshing approach to multiresolution modeling", SGP 2004;
/// Dunyach et al., "Adaptive remeshing for real-time mesh deformation", Eurographics short papers
/// 2013.
/// \param surface an oriented manifold, closed or open
/// \param lines centerlines for the vessel's radius; null: measured by rays
/// \throw InvalidInput if a parameter is out of its range or the surface is not a manifold;
///        AlgorithmFailure that names the place if the result would intersect itself and
///        its walls cannot be separated; or that names an edge length if the one asked for makes
///        more than 10 million triangles, is longer than the surface's bounding box or shorter than
///        a millionth of it, or is so coarse that a fifth of the volume is lost; Cancelled
[[nodiscard]] Remeshed remesh(const Surface& surface, const RemeshParameters& parameters = {},
                              const CenterlineGraph* lines = nullptr,
                              const Progress& progress = {});

}  // namespace vesselbench
