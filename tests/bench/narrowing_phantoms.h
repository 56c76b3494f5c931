#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "geometry/image/image.h"
#include "geometry/kernel/surface.h"
#include "tests/forest/tree.h"

namespace vesselbench::bench {

/// What is planted into a phantom's vessels.
enum class PhantomFault {
    Dip,       ///< the contrast falls, the lumen does not: an artefact
    Stenosis,  ///< the lumen is narrow
    Clean
};

[[nodiscard]] std::string to_string(PhantomFault fault);
[[nodiscard]] PhantomFault fault_from(const std::string& name);

/// A place where the surface may come out too narrow.
struct PlantedNarrowing {
    std::size_t branch = 0;      ///< of the tree
    double middle = 0.0;         ///< along the branch's line [mm]
    double reach = 0.0;          ///< to each side [mm]
    Vec3 centre = Vec3::Zero();  ///< on the axis [mm]
    double radius = 0.0;         ///< of the healthy vessel there [mm]
    double share = 0.0;          ///< of the radius that a stenosis takes in the middle [-]
    Vec3 aside = Vec3::Zero();   ///< where its axis moves by as much as it takes; unit, or zero
};

/// An image of a random tree with vessels of at least 6 voxels: blur of 0.5 to 1.3 voxels, noise of
/// 1 to 6 % of the contrast, contrast that varies by up to 15 % over the image, slices 1 to 1.5
/// times as far apart as pixels, a sac in a quarter of the trees. Dips take 30 to 47 % of the
/// contrast in the core and up to 50 % more at the wall; stenoses 10 to 60 % of the radius, half of
/// them to one side. Up to two a tree, each within the middle of a branch.
class NarrowingPhantom {
public:
    NarrowingPhantom(PhantomFault fault, std::uint64_t seed);

    Image image;
    double voxel = 1.0;  ///< longest edge [mm]
    std::vector<PlantedNarrowing> planted;

    /// Of the image at one threshold, midway between vessel and tissue.
    [[nodiscard]] Surface surface() const;

    /// Of the image with local levels.
    [[nodiscard]] Surface local_surface() const;

    /// How much narrower a surface is at a place than the healthy vessel, by the same threshold's
    /// radius beside it: the largest share [-]; 1 where it is broken.
    [[nodiscard]] double share(const Surface& surface, const PlantedNarrowing& place) const;

    /// Root mean square of the healthy radius minus the surface's, over the place [mm].
    [[nodiscard]] double radius_error(const Surface& surface, const PlantedNarrowing& place) const;

    /// Vertices that differ farther than 3 reaches and diameters from the place.
    [[nodiscard]] std::size_t moved_outside(const Surface& before, const Surface& after,
                                            const PlantedNarrowing& place) const;

private:
    /// Radius over the healthy one, along the place's branch.
    struct Ratio {
        double along = 0.0, ratio = 0.0;
        double radius = 0.0;  ///< healthy [mm]
    };

    [[nodiscard]] std::vector<Ratio> ratios(const Surface& surface,
                                            const PlantedNarrowing& place) const;

    forest::Tree tree_;  ///< healthy
};

}  // namespace vesselbench::bench
