#pragma once

#include <cstdint>
#include <vector>

#include "geometry/kernel/surface.h"
#include "smoothing/context/cap_parameters.h"

namespace vesselbench {

class AreaNormals;

/// A flat end of the surface: an opening, or a place where the segmentation cut the structure off.
struct Cap {
    std::vector<TriangleId> triangles;  ///< ascending
    std::vector<VertexId> vertices;     ///< of the triangles, including the rim, ascending
    std::vector<VertexId> rim;   ///< vertices with a triangle beyond, or on a boundary, ascending
    Vec3 normal = Vec3::Zero();  ///< unit mean normal, outward
    bool from_patch = false;     ///< a patch other than the wall, and therefore a cap by definition
};

/// Finds the caps of a surface in any orientation: flat areas, grown up to the edges around
/// them, beyond which the surface drops to one side all around (thesis Algorithm 1); where it
/// goes up in some places and down in others, the area is the tread of a staircase. Patches
/// other than the wall are caps by definition and are not searched. Three conditions are added
/// to the algorithm, which would otherwise take gentle bulges and the facets of a voxel mask for
/// caps: the area is planar; it is not much longer than wide; and nearly all around it the
/// surface drops by 45 degrees or more, seen from the rim, between a few rings and two inner
/// radii of the area farther out, so that a single voxel's step does not count. By this rule a
/// planar side of a box is a cap, and so is the topmost slice of a mask if slices are thick or
/// the part is round within a few voxels. Areas without a border, or with an entirely open one,
/// are no caps.
/// \return the same caps on any number of threads, in the order of their first triangles
/// \throw InvalidInput if a parameter is out of range
[[nodiscard]] std::vector<Cap> find_caps(const Surface& surface,
                                         const CapParameters& parameters = {});

/// The same from normals computed before.
[[nodiscard]] std::vector<Cap> find_caps(const AreaNormals& faces,
                                         const CapParameters& parameters = {});

/// Completes find_caps from planar parts, however they were found: the areas of those whose
/// surroundings make them caps, and the patches other than the wall.
[[nodiscard]] std::vector<Cap> caps_of_parts(const AreaNormals& faces, const CompressedRows& parts,
                                             const CapParameters& parameters);

/// \throw InvalidInput if a parameter is out of range
void require_cap_parameters(const CapParameters& parameters);

/// 1 at the vertices of the caps, #V.
[[nodiscard]] std::vector<std::uint8_t> cap_vertices(const std::vector<Cap>& caps,
                                                     std::size_t vertex_count);

}  // namespace vesselbench
