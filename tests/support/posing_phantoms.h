#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "geometry/kernel/surface.h"
#include "geometry/phantoms/description.h"

namespace vesselbench::test {

/// A vessel for trials of posing, and what is to be done to it.
struct PosingPhantom {
    std::string kind;
    Surface surface;           ///< closed, flat caps as patches, the inlet at the trunk
    double radius = 1.0;       ///< of the branch [mm]
    Vec3 at = Vec3::Zero();    ///< on the branch's axis [mm]
    Vec3 move = Vec3::Zero();  ///< [mm]
    double straighten = 0.0;   ///< [-]
    double gap = 0.0;          ///< that is wanted [mm]; 0: a branch is deformed
    bool refused = false;      ///< it cannot be done
};

/// The surface of vessels that are joined, closed by flat caps, which are patches where a vessel's
/// end is free: the first point of the first vessel is the inlet.
[[nodiscard]] Surface vessel_surface(const std::vector<VesselShape>& vessels, double edge,
                                     double fillet = 0.0);

/// A vessel of one radius [mm] through points.
[[nodiscard]] VesselShape vessel_through(Positions points, double radius);

/// Random vessels with a branch to be moved or straightened: curved tubes ("tube"), trees ("tree"),
/// bows to be straightened ("bow"), loops that must be refused ("loop").
[[nodiscard]] PosingPhantom deform_phantom(std::uint64_t seed);

/// Random trees with branches that come too near each other: two that approach ("approach"), one
/// that winds around a straight one ("helix"), two that run side by side ("parallel"), and two that
/// join again ("loop"), which cannot be parted.
[[nodiscard]] PosingPhantom gap_phantom(std::uint64_t seed);

}  // namespace vesselbench::test
