#pragma once

#include "geometry/kernel/progress.h"
#include "geometry/kernel/surface.h"
#include "meshing/products/cfd_parameters.h"

namespace vesselbench {

/// The flow with the shares of the outlets, where these follow from the bifurcations of the model's
/// centerlines; else as it is. Several inlets add up, each with its flow.
/// \param surface closed, with the openings as patches
/// \throw DiagnosedFailure if no line leads to an outlet, and as flow_summary(), centerlines_of()
[[nodiscard]] CfdParameters with_outlet_shares(CfdParameters flow, const Surface& surface,
                                               const Progress& progress = {});

}  // namespace vesselbench
