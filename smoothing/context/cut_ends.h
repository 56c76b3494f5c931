#pragma once

#include <optional>
#include <span>
#include <vector>

#include "geometry/kernel/surface.h"
#include "smoothing/context/caps.h"

namespace vesselbench {

/// A flat end that the image or its segmentation cut off.
struct CutEnd {
    Vec3 normal = Vec3::Zero();  ///< unit
    Vec3 centre = Vec3::Zero();  ///< area-weighted [mm]
    double area = 0.0;           ///< [mm^2]
};

/// The patches of kind Cut, but those below a hundredth of the largest one's area. Inlets and
/// outlets were clipped by a user, across the vessel.
[[nodiscard]] std::vector<CutEnd> cut_ends(const Surface& surface);

/// The same, or without such patches the caps that were found, down to a tenth of the largest one's
/// area: some of these are flat sides of a mask.
[[nodiscard]] std::vector<CutEnd> cut_ends(const Surface& surface, std::span<const Cap> caps);

/// The direction across parallel ends.
struct EndsAxis {
    Vec3 direction = Vec3::UnitZ();  ///< unit
    double confidence = 0.0;         ///< [-] in [0, 1]
};

/// The direction across the ends that are parallel within half a degree: those of one image lie in
/// its slices. n of them give n / (n + 1), less if other ends have more than a fraction of their
/// area: 2/3 at two ends, and at a third of the area. Ends straight behind each other do not count,
/// because a straight vessel that was clipped across has them, too. Vessels clipped across
/// elsewhere have parallel ends by chance, one pair in some thousand. \return none without two
/// parallel ends
[[nodiscard]] std::optional<EndsAxis> axis_of_ends(std::span<const CutEnd> ends);

}  // namespace vesselbench
