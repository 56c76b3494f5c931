#pragma once

#include <optional>
#include <vector>

#include "geometry/kernel/progress.h"
#include "geometry/kernel/surface.h"
#include "meshing/tetrahedra/surface_check.h"

namespace vesselbench {

/// Two opposite places of the surface.
struct FacingPlaces {
    double distance = 0.0;     ///< [mm]
    Vec3 from = Vec3::Zero();  ///< [mm]
    Vec3 to = Vec3::Zero();    ///< [mm]
};

/// The properties of a model that matter for printing.
struct PrintCheck {
    std::vector<SurfaceProblem> problems;  ///< none of them an obstacle: watertight
    Vec3 size = Vec3::Zero();              ///< extent along x, y, z [mm]
    double volume = 0.0;                   ///< [mm^3]
    double area = 0.0;                     ///< [mm^2]
    std::optional<FacingPlaces> lumen;     ///< smallest distance between walls across the inside
    std::optional<FacingPlaces> gap;       ///< smallest distance between walls across the outside

    /// A closed solid without obstacles. Whether a printer can make it depends on its thinnest
    /// place and gap, too (is_printable).
    [[nodiscard]] bool is_watertight() const;

    /// Watertight, no place thinner and no gap narrower than these limits [mm].
    [[nodiscard]] bool is_printable(double thinnest, double closest) const;
};

/// Checks a closed surface for printing. Distances are measured along the normals of the wall's
/// vertices to the wall that faces them within 60 degrees; rims and caps are excluded. Walls whose
/// shortest path along the surface is below three times their distance belong to one fold (the
/// crotch of a furcation), not to two branches.
/// \throw InvalidInput if the surface has no triangle
[[nodiscard]] PrintCheck print_check(const Surface& surface, const Progress& progress = {});

/// The gaps narrower than `width` [mm] between walls that face each other across the outside and
/// belong to two branches, as print_check() finds the smallest one; the narrowest first.
/// Neighbouring vertices and the walls they face are one gap.
/// \throw InvalidInput if the surface has no triangle or the width is not positive; Cancelled
[[nodiscard]] std::vector<FacingPlaces> narrow_gaps(const Surface& surface, double width,
                                                    const Progress& progress = {});

}  // namespace vesselbench
