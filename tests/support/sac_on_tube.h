#pragma once

#include "geometry/kernel/surface.h"

namespace vesselbench::test {

/// The sphere of the idealised aneurysm of ../shared/data (v4a) on a straight tube along x, around
/// the origin [mm].
inline constexpr double kSacRadius = 2.502, kSacTube = 1.75, kSacMiddle = 3.75;

/// A surface of it, closed, with the sac towards +z. \param cell of its sampling [mm]
[[nodiscard]] Surface sac_on_tube(double cell);

/// Its highest point [mm].
[[nodiscard]] Vec3 sac_dome();

/// The height of the sphere above a plane perpendicular to z, and its figures there [mm].
struct SphereAbove {
    double height = 0.0;
    double neck_radius = 0.0;
    double dome_area = 0.0;
    double volume = 0.0;
};

/// \param z of the plane, below the sphere's middle [mm]
[[nodiscard]] SphereAbove sphere_above(double z);

}  // namespace vesselbench::test
