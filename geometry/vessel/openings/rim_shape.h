#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "geometry/kernel/cross_section.h"
#include "geometry/vessel/openings/opening_axis.h"

namespace vesselbench {

/// A rim or cap counts as flat if its vertices, seen from its centre, are within this angle of its
/// plane [deg].
inline constexpr double kFlatRimDeg = 3.0;

/// At a vessel's end the wall rises from the opening's plane by more than this [deg], on average; a
/// hole in a vessel's side has its wall in the plane.
inline constexpr double kLeastRiseDeg = 45.0;

/// Shape of an open border.
struct RimShape {
    Plane plane;             ///< best fit; normal out of the vessel
    double area = 0.0;       ///< of the projected polygon [mm^2]
    double perimeter = 0.0;  ///< [mm]
    double flatness = 0.0;   ///< largest distance of a vertex from the plane [mm]
    double rise_deg = 0.0;   ///< mean angle between the wall beside the rim and the plane
    double aspect = 1.0;     ///< length over width of the projected polygon, by second moments [-]
    std::size_t edges = 0;

    [[nodiscard]] double diameter() const;   ///< of the circle of this area [mm]
    [[nodiscard]] double roundness() const;  ///< 4 pi area / perimeter^2 [-], 1: a circle

    /// True for a vessel's end that needs no cut: flat (kFlatRimDeg), with the wall rising from its
    /// plane, and neither a slit nor the hole of a few missing triangles.
    [[nodiscard]] bool is_good() const;

    /// True for what a plane cuts out of a vessel that passes it, such as a bend at an image's
    /// border: long, with the wall leaning towards it. An oblique end looks alike.
    [[nodiscard]] bool is_graze() const;
};

/// \param loop as from Topology::boundary_loops
[[nodiscard]] RimShape rim_shape(const Surface& surface, std::span<const VertexId> loop);

/// The shape of the border that a cap would leave; empty if the cap is not one disc.
[[nodiscard]] std::optional<RimShape> rim_shape_of_cap(const Surface& surface, std::size_t patch);

/// True if the patch is flat (kFlatRimDeg).
[[nodiscard]] bool is_flat(const PatchShape& shape);

/// Mean angle between the wall along a section and the section's plane [deg]: 90 for a cut
/// perpendicular to a tube.
[[nodiscard]] double rise_deg(const Surface& surface, const SectionCurve& curve,
                              const Plane& plane);

}  // namespace vesselbench
