#pragma once

#include <vector>

#include "geometry/phantoms/phantom.h"

namespace vesselbench::test {

// The phantoms of thesis Tables 5.6 and 5.7. Shapes, voxels and removed parts were chosen before
// the estimator was tuned, and must not be tuned to it.

constexpr double kSlices = 3.0;  ///< distance of the slices [mm], along z

/// Table 5.6: like a carotid artery, a sternocleidomastoid muscle and a liver.
[[nodiscard]] PhantomDescription vessel_in_slices();
[[nodiscard]] PhantomDescription muscle_in_slices();
[[nodiscard]] PhantomDescription organ_in_slices();

[[nodiscard]] Eigen::Matrix3d random_rotation(std::uint64_t seed);

/// Ball of a random radius at a random place among the voxels.
[[nodiscard]] PhantomDescription random_sphere(std::uint64_t seed, const Vec3& spacing);

/// Table 5.7: a sphere without a part of its topmost slice, 1/16 to all of it.
struct CutSphere {
    PhantomDescription description;
    double share = 0.0;  ///< fraction of the topmost slice removed
    Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();  ///< for the surface
};

[[nodiscard]] CutSphere cut_sphere(std::uint64_t seed);

/// The surface at half the contrast of a phantom's image.
[[nodiscard]] Surface imaged(const PhantomDescription& description);

/// The surface of the mask that an expert draws slice by slice.
[[nodiscard]] Surface of_mask(const PhantomDescription& description);

/// Intensities inside the dilated mask (thesis 5.4.2).
[[nodiscard]] Surface of_masked_intensities(const PhantomDescription& description);

/// The surface turned about the origin.
[[nodiscard]] Surface turned(const Surface& surface, const Eigen::Matrix3d& rotation);

/// Angle between two axes, whichever way they point [deg].
[[nodiscard]] double degrees_between(const Vec3& a, const Vec3& b);

/// Fraction of the faces within 1 degree of the z axis.
[[nodiscard]] double share_of_flat_faces(const Surface& surface);

}  // namespace vesselbench::test
