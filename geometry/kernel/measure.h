#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "geometry/kernel/derived_cache.h"
#include "geometry/kernel/spread.h"
#include "geometry/kernel/surface.h"
#include "geometry/kernel/vertex_normals.h"

namespace vesselbench {

struct Bounds {
    Vec3 min = Vec3::Zero();  ///< [mm]
    Vec3 max = Vec3::Zero();  ///< [mm]

    [[nodiscard]] double diagonal() const { return (max - min).norm(); }

    [[nodiscard]] Vec3 centre() const { return 0.5 * (min + max); }
};

/// Zeros if there is no point.
[[nodiscard]] Bounds bounds(const Positions& positions);
[[nodiscard]] Bounds bounds(const Surface& surface);

[[nodiscard]] double triangle_area(const Positions& positions,
                                   const Triangle& triangle);  ///< [mm^2]

[[nodiscard]] double longest_edge(const Vec3& a, const Vec3& b, const Vec3& c);           ///< [mm]
[[nodiscard]] double longest_edge(const Positions& positions, const Triangle& triangle);  ///< [mm]

/// [mm^2]
[[nodiscard]] double area(const Surface& surface);

/// Enclosed volume [mm^3], negative if the triangles face inward. Openings are closed virtually by
/// a fan to the mean of their rim, so that the figure does not depend on the position in space.
[[nodiscard]] double volume(const Surface& surface);

/// Edge lengths [mm] over all edges, each counted once.
[[nodiscard]] Spread edge_lengths(const Surface& surface);
[[nodiscard]] double mean_edge_length(const Surface& surface);

struct PatchMeasures {
    std::size_t row = 0;  ///< of the patch table
    std::string name;
    PatchKind kind = PatchKind::Wall;
    std::size_t triangles = 0;
    double area = 0.0;             ///< [mm^2]
    Vec3 centroid = Vec3::Zero();  ///< area-weighted [mm]
    Vec3 normal = Vec3::Zero();    ///< mean outward unit normal
    double flatness = 0.0;         ///< largest distance of a vertex from the best-fit plane [mm]
};

/// One entry per row of the patch table that has triangles.
[[nodiscard]] std::vector<PatchMeasures> measure_patches(const Surface& surface);

/// Genus and counts of one closed or open surface.
struct Connectivity {
    std::size_t components = 0;
    std::size_t boundary_loops = 0;
    std::size_t non_manifold_edges = 0;
    std::size_t non_manifold_vertices = 0;
    std::size_t inconsistent_edges = 0;  ///< both triangles run the same way
    bool closed = false;                 ///< no edge with one triangle
    bool manifold = false;               ///< 2-manifold, with or without boundary
    bool oriented = false;               ///< consistently (inward or outward)
    std::optional<int> genus;            ///< sum over components; none unless manifold and oriented
};

[[nodiscard]] Connectivity connectivity(const Topology& topology);

/// Everything `vesselbench measure` prints about one surface.
struct SurfaceMeasures {
    std::size_t vertices = 0;
    std::size_t triangles = 0;
    Connectivity connectivity;
    std::size_t self_intersections = 0;  ///< pairs of triangles
    double area = 0.0;                   ///< [mm^2]
    double volume = 0.0;                 ///< [mm^3]
    Bounds bounds;
    Spread edge_length;                        ///< [mm]
    Spread equiangle_skewness;                 ///< [-]
    Spread radius_ratio;                       ///< [-]
    double normal_curvature_deg = 0.0;         ///< mean over the vertices [deg]
    double mean_curvature_integral = 0.0;      ///< of H dA [mm]
    double mean_curvature_integral_abs = 0.0;  ///< of |H| dA [mm]
    std::vector<PatchMeasures> patches;
};

/// \throw InvalidInput if the surface has no triangle
[[nodiscard]] SurfaceMeasures measure(const Surface& surface,
                                      DerivedCache& cache = derived_cache());

}  // namespace vesselbench
