#pragma once

#include <optional>
#include <span>

#include "geometry/kernel/surface.h"
#include "smoothing/context/caps.h"
#include "smoothing/context/voxel_grid.h"

namespace vesselbench {

/// Direction across the image's slices, estimated from a surface.
struct StackOrientation {
    Vec3 direction = Vec3::UnitZ();  ///< unit; the largest component is positive
    double confidence = 0.0;         ///< [-] in [0, 1]; how distinct the direction is
    bool certain = false;            ///< the direction may be used without confirmation
    double flat_share = 0.0;         ///< [-] share of the faces with theta < theta_limit (Eq. 5.3)
    std::optional<VoxelGrid> grid =
        std::nullopt;  ///< seen in the triangles, also in uncertain results
};

/// Parameters of the estimation (thesis 5.3.1).
struct StackOrientationParameters {
    double radius = 0.1;        ///< of the density and of the clusters on the unit sphere [-]
    double theta_limit = 0.05;  ///< faces below it count as flat [-]; 0.05 is 18 degrees
};

/// Estimates the stack axis from the face normals: staircases and plateaus make many of them
/// parallel to it. Thesis 5.3.1 finds clusters of the normals (density within the radius, threshold
/// midway between mean and maximum) and takes the one with the most flat faces around it. That
/// yields an axis on any surface, even on a sphere; it is the direction of an uncertain result. A
/// certain result needs further evidence:
/// - The voxels' edges, if the triangles show them (interpolated_grid, voxel_lattice): the stack
///   axis is that of the longest edge, if it is more than a fifth longer than the others. Masks of
///   cubic voxels have no stack axis.
/// - Else a sharp peak of the normals, beyond what the surrounding shape explains, with a minimum
///   share of the faces and no comparable second peak; along an axis of the voxels, if these are
///   seen. Any single plane makes such a peak (a flat end unrelated to slices): exclude such faces.
/// - Or parallel ends that the image cut off (axis_of_ends), along an axis of the voxels, if these
///   are seen.
/// Two kinds of evidence for different directions are none. Surfaces without staircases and ends
/// whose vertices were moved are uncertain. The direction of a peak is
/// the median of its normals, each face counting once. Faces without a normal
/// (degenerate, not finite) are ignored; without any faces the result is uncertain and along z.
/// Bit-identical for any number of threads.
/// \throw InvalidInput if radius is not in [0.02, 0.5] or theta_limit not in (0, 1]
[[nodiscard]] StackOrientation estimate_stack_orientation(
    const Topology& topology, const Positions& positions,
    const StackOrientationParameters& parameters = {});

/// The same for a surface's wall: the faces of its openings are no trace of slices. Patches of kind
/// Cut count as ends.
[[nodiscard]] StackOrientation estimate_stack_orientation(
    const Surface& surface, const StackOrientationParameters& parameters = {});

/// The same without the faces of caps, however they were found. Those that are no inlets and
/// outlets count as ends.
[[nodiscard]] StackOrientation estimate_stack_orientation(
    const Surface& surface, std::span<const Cap> caps,
    const StackOrientationParameters& parameters = {});

}  // namespace vesselbench
