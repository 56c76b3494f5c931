#pragma once

#include "geometry/kernel/surface.h"

namespace vesselbench {

/// Direction in which the slices of the image lay on each other, as a surface tells it.
struct StackOrientation {
    Vec3 direction = Vec3::UnitZ();  ///< unit; the largest component is positive
    double confidence = 0.0;         ///< [-] in [0, 1]; how far the direction stands out
    bool certain = false;            ///< the direction may be used without asking
    double flat_share = 0.0;         ///< [-] share of the faces with theta < theta_limit (Eq. 5.3)
};

/// Parameters of the estimation (thesis 5.3.1).
struct StackOrientationParameters {
    double radius = 0.1;        ///< of the density and of the clusters on the unit sphere [-]
    double theta_limit = 0.05;  ///< faces below it count as flat [-]; 0.05 is 18 degrees
};

/// Estimates the stack axis from the normals of the faces: staircases and plateaus make many of
/// them parallel to it. Thesis 5.3.1 finds clusters of the normals (density within the radius,
/// threshold midway between mean and maximum) and takes the one with the most flat faces around it.
/// That names an axis on any surface, a sphere's too. It is what an uncertain result has for its
/// direction; a certain one needs evidence that it does not ask for:
/// - Surfaces with interpolated vertices: the axis is a sharp peak of the normals, beyond what the
///   shape around it gives, of some share of the faces, and no other peak comes near it. Any single
///   plane makes such a peak (a flat end that is no trace of slices): leave such faces out.
/// - Surfaces of labels or masks have a few normals only, and flat faces along all voxel axes.
///   These tell the ratios of the edges of a voxel; the stack axis is the one of the longest edge,
///   if it is a quarter longer than the others.
/// Uncertain, too, are surfaces without staircases, smoothed or noisy ones of masks, and those of
/// cubic voxels, which have no stack axis to be found. The direction is the median of the peak's
/// normals, each face counting once. Faces without a normal (degenerate, not finite) do not count;
/// without any faces the result is uncertain and along z. The same bits on any number of threads.
/// \throw InvalidInput if radius is not in [0.02, 0.5] or theta_limit not in (0, 1]
[[nodiscard]] StackOrientation estimate_stack_orientation(
    const Topology& topology, const Positions& positions,
    const StackOrientationParameters& parameters = {});

/// The same of a surface's wall only: what closes its openings is no trace of slices.
[[nodiscard]] StackOrientation estimate_stack_orientation(
    const Surface& surface, const StackOrientationParameters& parameters = {});

}  // namespace vesselbench
