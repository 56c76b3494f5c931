#pragma once

#include "geometry/kernel/progress.h"
#include "geometry/vessel/sac/sac_part.h"

namespace vesselbench {

/// An aneurysm's sac as far as its neck, and the vessel that carries it.
struct SacAtNeck {
    SacPart sac;
    double parent_diameter = 0.0;  ///< of the parent's tube at the neck [mm]; 0: it has no parent
};

/// Where a sac begins: finds it on every surface of its vessel, whatever the triangles.
struct SacNeck {
    Vec3 dome = Vec3::Zero();  ///< point in the sac's dome, on the wall or inside [mm]
    Plane plane;               ///< its normal points into the sac
};

/// Proposes the plane of a sac's neck.
///
/// The parent vessel's tube is continued through the sac as if that had never been there
/// (branch_root.h); where the wall around the dome stands out of it is the first guess. From there,
/// the plane is moved and tilted until the square of its outline's length is least in comparison
/// with the area of the wall that it cuts off, among all planes that separate the dome from the
/// vessel's ends by one closed curve. A plane nearer to the dome loses more wall than outline;
/// nearer to the parent, its section widens into the parent.
/// docs/science/sacs.md compares it with experts' necks. At a sharp crease between sac and parent
/// it depends on the size of the triangles there.
/// \param dome point in the sac's dome [mm]
/// \throw AlgorithmFailure if no branch has its tip there, it has no parent vessel, or no plane
///        separates it from the vessel's ends
[[nodiscard]] SacAtNeck propose_neck(const Surface& surface, const Vec3& dome,
                                     const Progress& progress = {});

/// The sac beyond a plane that is known.
/// \throw AlgorithmFailure if no branch has its tip at the dome, or the plane does not separate it
///        from the vessel's ends by one closed curve
[[nodiscard]] SacAtNeck sac_beyond(const Surface& surface, const SacNeck& neck,
                                   const Progress& progress = {});

}  // namespace vesselbench
