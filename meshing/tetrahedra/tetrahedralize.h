#pragma once

#include <optional>
#include <string>
#include <vector>

#include "geometry/kernel/diagnostic.h"
#include "geometry/kernel/progress.h"
#include "geometry/kernel/surface.h"
#include "meshing/tetrahedra/quality.h"
#include "meshing/tetrahedra/volume_mesh.h"

namespace vesselbench {

struct TetrahedralizeParameters {
    std::optional<double> cells;  ///< target number of cells, met within 10 %; overrides `size`
    double size = 1.0;     ///< edge length in the lumen relative to that of the surface [-], > 0
    double growth = 0.15;  ///< growth of the edge length per distance from the wall [-], >= 0
    double quality = 1.2;  ///< largest ratio of circumradius to shortest edge in TetGen [-], >= 1.1
    int improve = 4;       ///< rounds of improvement after TetGen; 0: none
    bool may_divide = true;  ///< triangles of the surface may be divided if nothing else works
};

/// Settings tried and results.
struct TetrahedralizeReport {
    double size = 1.0;                  ///< the edge length factor used [-]
    std::string switches;               ///< TetGen's switches that led to the mesh
    std::vector<std::string> attempts;  ///< each call of TetGen: switches and outcome
    std::vector<Diagnostic> warnings;
    bool surface_kept = true;  ///< the boundary triangles are the surface's triangles
    VolumeQuality raw;         ///< as TetGen left it
    VolumeQuality quality;     ///< of the mesh returned
};

struct TetrahedralizeResult {
    VolumeMesh mesh;
    TetrahedralizeReport report;
};

/// Fills a closed surface with tetrahedra. The surface's triangles become the mesh's boundary
/// triangles, patches included; only the lumen receives new vertices. Edge lengths follow the
/// surface's. If TetGen fails, a ladder of other settings is tried; each is reported.
/// \throw InvalidInput if the surface is open, intersects itself, is not manifold, has non-finite
/// coordinates ...: the text names each cause and its places (surface_check.h)
/// \throw AlgorithmFailure if no setting yields a valid mesh; names the facets
[[nodiscard]] TetrahedralizeResult tetrahedralized(const Surface& surface,
                                                   const TetrahedralizeParameters& parameters,
                                                   const Progress& progress = {});

// Its parts, for meshes of which the lumen's core is only one.

/// The surface without unused vertices. \throw InvalidInput as `tetrahedralized`
/// \param warnings receives what does not prevent filling
[[nodiscard]] Surface fillable_surface(const Surface& surface, std::vector<Diagnostic>& warnings,
                                       const Progress& progress = {});

/// \param surface of `fillable_surface`
/// \throw AlgorithmFailure as `tetrahedralized`
[[nodiscard]] TetrahedralizeResult fill_lumen(const Surface& surface,
                                              const TetrahedralizeParameters& parameters,
                                              const Progress& progress = {});

/// Adds a warning if the cells of the report's quality are not as many as wanted, or the lumen is
/// much finer than the wall.
void warn_of_cell_count(double wanted, TetrahedralizeReport& report);

}  // namespace vesselbench
