#pragma once

#include <optional>
#include <span>
#include <vector>

#include "geometry/editing/local_part.h"
#include "geometry/kernel/progress.h"
#include "geometry/kernel/surface.h"
#include "geometry/kernel/surface_distance.h"

namespace vesselbench {

/// The surroundings of a place, along the surface: an opposite wall is not part of them.
struct NearPlace {
    Vec3 at = Vec3::Zero();  ///< [mm]; the nearest point of the surface is taken
    double within = 0.0;     ///< distance from it, straight and along the surface [mm], > 0
};

/// A brush moves the wall evenly if its radius has so many edges.
inline constexpr double kEdgesPerRadius = 4.0;

struct LocalRemeshReport {
    double edge = 0.0;            ///< target [mm]
    double edge_before = 0.0;     ///< mean near the place [mm]
    double reach = 0.0;           ///< distance up to which triangles were changed, about [mm]
    std::size_t replaced = 0;     ///< triangles before
    std::size_t replacement = 0;  ///< triangles after
};

struct LocalRemeshed {
    Surface surface;
    LocalRemeshReport report;
};

/// The vertices at most `within` [mm] away from a place, straight and, about, along the surface;
/// ascending.
[[nodiscard]] std::vector<VertexId> vertices_within(const Surface& surface,
                                                    const SurfacePoint& centre, double within);

/// Mean edge of the triangles near a place [mm].
[[nodiscard]] double mean_edge_near(const Surface& surface, const SurfaceDistance& places,
                                    const NearPlace& near);

/// Remeshes the surroundings of a place to one edge length. Beyond them, edges grow or shrink
/// towards those that are there; no vertex beyond them moves or goes, only edges between them may
/// be split or flipped, up to the report's reach. Patches and their rims are kept; the rest of the
/// surface keeps its bits. Sources as remesh().
/// \param places of the surface
/// \param edge target edge length [mm], > 0, at most `within`; default within / kEdgesPerRadius
/// \throw InvalidInput if a length is out of its range or the surface is no manifold there;
///        AlgorithmFailure if the result would cross itself, or have more than 10 million
///        triangles; Cancelled
[[nodiscard]] LocalRemeshed remesh_near(const Surface& surface, const SurfaceDistance& places,
                                        const NearPlace& near, std::optional<double> edge = {},
                                        const Progress& progress = {});

/// Remeshes a part of a surface.
/// \param part a manifold
/// \param sizes target edge lengths [mm], by its vertex
/// \param anchored 1 at vertices that stay, by its vertex; those of its rim must
/// \return former: of the anchored vertices
[[nodiscard]] EditedPart remesh_part(const Surface& part, std::vector<double> sizes,
                                     std::span<const std::uint8_t> anchored,
                                     const Progress& progress = {});

/// 1 at the triangles that one of the vertices has, #T.
/// \param vertices ascending or not
[[nodiscard]] std::vector<std::uint8_t> triangles_at(const Surface& surface,
                                                     std::span<const VertexId> vertices);

/// Mean length of the edges at every vertex [mm], #V.
[[nodiscard]] std::vector<double> mean_edges(const Surface& surface);

/// The first place where a triangle marked in `changed` crosses another one [mm].
/// \param changed 1 at triangles that are new, #T
[[nodiscard]] std::optional<Vec3> crossing_of(const Surface& surface,
                                              std::span<const std::uint8_t> changed,
                                              const Progress& progress = {});

}  // namespace vesselbench
