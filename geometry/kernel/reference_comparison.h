#pragma once

#include <optional>
#include <span>

#include "geometry/kernel/surface.h"

namespace vesselbench {

/// How far vertices are from the reference's triangles around where they came from (local_error.h).
struct LocalErrorFigures {
    double mean = 0.0;     ///< over the vertices [mm]
    double largest = 0.0;  ///< [mm]
};

/// How two surfaces differ.
struct ReferenceComparison {
    double hausdorff = 0.0;               ///< largest distance, both ways [mm]
    double mean_distance = 0.0;           ///< area-weighted mean of both ways [mm]
    double hausdorff_to_reference = 0.0;  ///< from the surface to the reference only [mm]
    double mean_to_reference = 0.0;       ///< from the surface to the reference only [mm]
    double volume_change_percent = 0.0;   ///< of the surface against the reference [%]
    /// Of surfaces of the same triangles only: one is the other with its vertices moved.
    std::optional<LocalErrorFigures> local_error;
};

/// Point-to-surface distances from all vertices and from regular samples inside the triangles, no
/// wider apart than half the mean edge of the finer surface.
/// \throw InvalidInput if one of them has no triangle, or none with an area
[[nodiscard]] ReferenceComparison compare_with_reference(const Surface& surface,
                                                         const Surface& reference);

/// How far two surfaces are apart in a part of them.
struct PartDistance {
    double mean = 0.0;     ///< area-weighted, both ways [mm]; 0 if no sample lies in the part
    double largest = 0.0;  ///< both ways [mm]
};

struct WeighedComparison {
    PartDistance inside;   ///< where the weight is above one half
    PartDistance outside;  ///< elsewhere
};

/// The same samples and distances, told apart by a weight of the reference's vertices; a sample of
/// the surface counts where its closest point on the reference lies.
/// \param weights #V of the reference
/// \throw InvalidInput as compare_with_reference, or unless weights is #V long
[[nodiscard]] WeighedComparison compare_by_weight(const Surface& surface, const Surface& reference,
                                                  std::span<const double> weights);

}  // namespace vesselbench
