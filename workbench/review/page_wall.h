#pragma once

#include <optional>
#include <span>
#include <vector>

#include "geometry/kernel/surface_distance.h"

namespace vesselbench {

/// How an edit changed a vessel's wall, apart from its ends: there, cuts and extensions move much
/// that says nothing of the wall.
struct WallChange {
    double largest = 0.0;          ///< deviation [mm]
    bool inward = false;           ///< the vessel is narrower there
    double usual = 0.0;            ///< root of the mean square deviation all over the wall [mm]
    Vec3 place = Vec3::Zero();     ///< of the largest [mm]
    std::optional<double> radius;  ///< of the vessel there, before the edit [mm]
};

/// Half the way to the opposite wall [mm]: the median over the triangles around a place, as a
/// single ray may start in a crease. Empty: no wall is opposite.
/// \param surface that `distance` was made of
[[nodiscard]] std::optional<double> radius_near(const Surface& surface,
                                                const SurfaceDistance& distance, const Vec3& place);

/// Vertices of caps and of open borders, and their neighbours, #V.
[[nodiscard]] std::vector<bool> vertices_at_ends(const Surface& surface);

/// Distances of a surface's vertices from another one, #V [mm]; positive where they are outside of
/// it.
/// \param closest of the other surface, #V; a vertex that has not moved has the distance 0
[[nodiscard]] std::vector<double> signed_distances(const Surface& of, const SurfaceDistance& other,
                                                   std::span<const SurfacePoint> closest);

/// Distances of the wall's vertices alone: where one of the two surfaces is at an end, 0.
/// \param distances signed_distances() from `to`
/// \param closest of `to`, #V of `of`
[[nodiscard]] std::vector<double> wall_deviations(const Surface& of, const Surface& to,
                                                  std::span<const SurfacePoint> closest,
                                                  std::span<const double> distances);

/// The change of the wall by its deviations in both directions; empty: none is larger than `least`.
/// \param lost wall_deviations() of the surface before
/// \param gained those of the surface after
[[nodiscard]] std::optional<WallChange> wall_change(const Surface& before,
                                                    std::span<const double> lost,
                                                    const Surface& after,
                                                    std::span<const double> gained, double least);

}  // namespace vesselbench
