#pragma once

#include <cstdint>
#include <memory>

#include "geometry/kernel/surface.h"
#include "geometry/phantoms/description.h"
#include "geometry/phantoms/field.h"

namespace vesselbench::bench {

/// Two vessels that pass each other at less than a voxel and are one in the image: the blur joins
/// them, and the contrast between them leaks. Radii of 3 to 6 voxels; half of the contacts are
/// short (the vessels cross at 25 to 90 degrees), half are two to five diameters long (they run
/// side by side, bent and twisted). In a third, another vessel joins them far away: a ring.
class TouchingPhantom {
public:
    explicit TouchingPhantom(std::uint64_t number);

    std::uint64_t seed = 0;
    double voxel = 0.5;             ///< [mm]
    double thinner = 1.0;           ///< radius of the thinner vessel [mm]
    double length = 0.0;            ///< of the stretch side by side [mm]
    bool ring = false;              ///< the vessels are joined elsewhere
    Vec3 middle = Vec3::Zero();     ///< of the contact [mm]
    Vec3 sideways = Vec3::UnitY();  ///< unit; across the axes and the line between them

    /// The surface of the noisy image at one threshold.
    [[nodiscard]] Surface surface() const;

    /// The widest part of the contact, over the thinner vessel's diameter [-]; 0: they are apart.
    [[nodiscard]] double waist(const Surface& surface) const;

    /// Distance from the true walls, about [mm].
    [[nodiscard]] double error(const Vec3& p) const;

    /// A place on the wall of the contact [mm].
    [[nodiscard]] Vec3 place(const Surface& surface) const;

private:
    PhantomDescription imaged_;
    std::vector<PhantomPart> vessels_;
    Positions middles_, sides_;  ///< along the contact
    std::unique_ptr<PhantomField> truth_;
};

}  // namespace vesselbench::bench
