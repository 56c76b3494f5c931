#pragma once

#include "geometry/kernel/progress.h"
#include "meshing/layers/layer_report.h"
#include "meshing/layers/wall_layers.h"
#include "meshing/tetrahedra/tetrahedralize.h"

namespace vesselbench {

struct LayeredMesh {
    VolumeMesh mesh;
    TetrahedralizeReport report;  ///< `raw` is of the tetrahedra alone
    LayerReport layers;
};

/// Fills a closed surface with layers of prisms on its wall and tetrahedra inside. The surface's
/// triangles on the wall become those of the mesh; openings become a ring of quadrilaterals around
/// a disc of as many triangles as before. Prisms count as cells.
/// \throw InvalidInput as `tetrahedralized`; AlgorithmFailure if the prisms alone exceed `cells`,
/// the layers have no room in the lumen, no valid ones are found, with the place, or the lumen
/// inside cannot be filled with its boundary kept
[[nodiscard]] LayeredMesh layered_mesh(const Surface& surface,
                                       const TetrahedralizeParameters& parameters,
                                       const LayerParameters& layers,
                                       const Progress& progress = {});

}  // namespace vesselbench
