#pragma once

#include "geometry/kernel/progress.h"
#include "geometry/kernel/surface.h"
#include "geometry/vessel/centerlines/centerline_graph.h"
#include "meshing/products/cfd_parameters.h"
#include "meshing/tetrahedra/volume_mesh.h"

namespace vesselbench {

/// The flow with the shares of the outlets, where these follow from the bifurcations of the model's
/// centerlines; else as it is. Several inlets add up, each with its flow. An opening's line ends
/// within the opening's radius of its centre, and in no other opening.
/// \param surface closed, with the openings as patches
/// \throw DiagnosedFailure `outlet-without-line`, with the opening's place, if no line ends in an
/// opening or none leads from an inlet to an outlet; as flow_summary(), centerlines_of()
[[nodiscard]] CfdParameters with_outlet_shares(CfdParameters flow, const Surface& surface,
                                               const Progress& progress = {});

/// The same with the centerlines given, whatever `flow.outlet_shares` has.
[[nodiscard]] CfdParameters shared_along(const CenterlineGraph& lines, CfdParameters flow,
                                         const Surface& surface);

/// The same of a mesh: those of its boundary, which every case of the mesh has.
[[nodiscard]] CfdParameters with_outlet_shares(CfdParameters flow, const VolumeMesh& mesh,
                                               const Progress& progress = {});

}  // namespace vesselbench
