#pragma once

#include <optional>
#include <span>

#include "geometry/kernel/progress.h"
#include "geometry/kernel/surface.h"

namespace vesselbench {

/// Distance of vertices from the reference's triangles around their original place (local_error.h).
struct LocalErrorFigures {
    double mean = 0.0;     ///< over the vertices [mm]
    double largest = 0.0;  ///< [mm]
};

/// The difference of two surfaces.
struct ReferenceComparison {
    double hausdorff = 0.0;               ///< largest distance, both ways [mm]
    double mean_distance = 0.0;           ///< area-weighted mean of both ways [mm]
    double hausdorff_to_reference = 0.0;  ///< from the surface to the reference only [mm]
    double mean_to_reference = 0.0;       ///< from the surface to the reference only [mm]
    double volume_change_percent = 0.0;   ///< of the surface relative to the reference [%]
    /// Only for surfaces with the same triangles: one is the other with its vertices moved.
    std::optional<LocalErrorFigures> local_error;
};

/// Point-to-surface distances from all vertices and from regular samples inside the triangles, at
/// most half the mean edge of the finer surface apart.
/// \throw InvalidInput if one of them has no triangle, or none with an area; Cancelled if the user
/// cancels
[[nodiscard]] ReferenceComparison compare_with_reference(const Surface& surface,
                                                         const Surface& reference,
                                                         const Progress& progress = {});

/// Distance of two surfaces in a part of them.
struct PartDistance {
    double mean = 0.0;     ///< area-weighted, both ways [mm]; 0 if no sample lies in the part
    double largest = 0.0;  ///< both ways [mm]
};

struct WeighedComparison {
    PartDistance inside;   ///< where the weight is above one half
    PartDistance outside;  ///< elsewhere
};

/// The same samples and distances, split by a weight of the reference's vertices; a sample of the
/// surface belongs to the part that contains its closest point on the reference.
/// \param weights #V of the reference
/// \throw InvalidInput as compare_with_reference, or unless weights is #V long
[[nodiscard]] WeighedComparison compare_by_weight(const Surface& surface, const Surface& reference,
                                                  std::span<const double> weights,
                                                  const Progress& progress = {});

}  // namespace vesselbench
