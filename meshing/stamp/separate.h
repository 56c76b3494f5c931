#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "geometry/kernel/progress.h"
#include "geometry/kernel/surface.h"
#include "geometry/kernel/surface_distance.h"

namespace vesselbench {

struct SeparateParameters {
    Vec3 at = Vec3::Zero();  ///< a place at the contact, on its wall or inside [mm]
    double gap = 0.5;        ///< between both walls afterwards, at least [mm], > 0
    /// Two places of one vessel, on both sides of the contact [mm]: the arms nearest to them are
    /// one vessel. Default: decided by the walls that face away from the contact.
    std::optional<std::array<Vec3, 2>> vessel = {};
};

struct SeparateReport {
    Vec3 centre = Vec3::Zero();        ///< of the ball in which vertices may move [mm]
    double influence = 0.0;            ///< radius of that ball [mm]
    double width = 0.0;                ///< of the contact, across the vessels [mm]
    double length = 0.0;               ///< of the contact, along the vessels [mm]
    double waist = 0.0;                ///< its width, of the thinner vessel's diameter [-]; above 1
                                       ///< it is no contact of two vessels alone
    double gap = 0.0;                  ///< between both walls [mm]
    double farthest = 0.0;             ///< of the new wall from the wall before [mm]
    double lost = 0.0;                 ///< height over both vessels of wall that is gone, most [mm]
    Vec3 lost_at = Vec3::Zero();       ///< where that was [mm]
    std::array<Vec3, 2> vessel;        ///< where one of the two leaves the ball [mm]
    std::array<double, 2> radii = {};  ///< of the vessels at the contact [mm]
    std::size_t replaced = 0;          ///< triangles before
    std::size_t replacement = 0;       ///< triangles after
    std::size_t components_before = 0, components_after = 0;
    int genus_before = 0, genus_after = 0;
};

struct Separated {
    Surface surface;
    SeparateReport report;
};

/// Two places of one vessel, where it leaves the surroundings of the contact on either side, as
/// separate() decides it. \throw as separate()
[[nodiscard]] std::array<Vec3, 2> vessel_through(const Surface& surface,
                                                 const SurfaceDistance& places,
                                                 const SeparateParameters& parameters,
                                                 const Progress& progress = {});

/// Makes two vessels of two that are blended at a contact. Both are tubes that continue the walls
/// which face away from the contact; the bridge between them is cut out, and each hole is closed in
/// the coordinates of its tube, then kept on its side of the surface midway between the tubes. Wall
/// beside the bridge that is nearer to the other vessel than the gap recedes as well. Everything
/// outside the report's ball keeps its bits.
/// \param places of the surface
/// \throw InvalidInput if the gap is not positive or the place not finite; DiagnosedFailure, with its place, if not four
///        arms leave the contact, if they cannot be paired, if the vessels join there, if the gap
///        would take half of a vessel's radius, or if the result would not be sound: closed as
///        before, manifold, and free of new crossings; Cancelled
[[nodiscard]] Separated separate(const Surface& surface, const SurfaceDistance& places,
                                 const SeparateParameters& parameters,
                                 const Progress& progress = {});

}  // namespace vesselbench
