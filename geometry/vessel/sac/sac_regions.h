#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "geometry/kernel/progress.h"
#include "geometry/kernel/surface.h"
#include "geometry/vessel/sac/neck_plane.h"

namespace vesselbench {

/// The part of an aneurysm's vessel that a triangle belongs to.
enum class SacRegion : std::uint8_t { Elsewhere, Sac, Parent, Daughters };

[[nodiscard]] std::string to_string(SacRegion region);  ///< "elsewhere", "sac", "parent" ...

/// A vessel that leads away from a sac's neck.
struct NeckVessel {
    SacRegion region = SacRegion::Parent;  ///< Parent or Daughters
    double diameter = 0.0;                 ///< where it leaves the neck's surroundings [mm]
};

struct SacRegions {
    std::vector<SacRegion> triangles;  ///< #T
    std::vector<NeckVessel> vessels;
};

struct SacRegionOptions {
    double reach = 1.0;  ///< distance from the neck [diameters of the parent there], above 0
    std::optional<Vec3> inlet = std::nullopt;  ///< where the blood enters; none: at inlet patches
};

/// Labels a sac, and the vessels within reach of its neck: the parent on both sides of it; of three
/// or more vessels, the parent where the blood arrives, and its daughters. The parent is the one
/// that leads to the inlet; if that is not known, the widest, and of vessels as wide within a few
/// percent the one that the sac continues.
/// \throw what sac_beyond() throws; AlgorithmFailure if the sac has no parent vessel
[[nodiscard]] SacRegions sac_regions(const Surface& surface, const SacNeck& neck,
                                     const SacRegionOptions& options = {},
                                     const Progress& progress = {});

/// Middle of the inlet's patches; none: no patch is one.
[[nodiscard]] std::optional<Vec3> inlet_place(const Surface& surface);

}  // namespace vesselbench
