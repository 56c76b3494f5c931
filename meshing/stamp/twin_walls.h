#pragma once

#include "geometry/editing/local_part.h"
#include "geometry/kernel/progress.h"
#include "meshing/stamp/contact_arms.h"
#include "meshing/stamp/contact_bridge.h"
#include "meshing/stamp/twin_tubes.h"

namespace vesselbench {

/// The wall around a contact as two walls.
struct TwinWalls {
    EditedPart part;
    double gap = 0.0;       ///< smallest distance between the two [mm]
    double farthest = 0.0;  ///< of the new wall from the wall before [mm]
};

/// Cuts the bridge out, closes each hole in the coordinates of its tube, and moves both walls back
/// from the surface midway between the tubes until they are as far apart as the gap. The vertices
/// of the arms' rims stay. \param gap [mm], > 0
/// \throw DiagnosedFailure "separate-gap" with the gap that can be had, if the walls would recede by
///        half of a radius, or the arms themselves are nearer; "contact-not-parted" if a hole
///        cannot be closed; Cancelled
[[nodiscard]] TwinWalls twin_walls(const ContactZone& zone, const TwinTubes& twins,
                                   ContactBridge bridge, double gap, const Progress& progress = {});

}  // namespace vesselbench
