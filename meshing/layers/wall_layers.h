#pragma once

#include <optional>
#include <vector>

#include "geometry/kernel/progress.h"
#include "meshing/layers/layered_wall.h"

namespace vesselbench {

struct LayerParameters {
    int layers = 0;                      ///< of prisms along the wall; 0: none
    double growth = 1.2;                 ///< of the heights of successive layers [-], >= 1
    double thickness = 0.2;              ///< of all layers, by the vessel's radius [-], > 0
    std::optional<double> thickness_mm;  ///< of all layers [mm], > 0; overrides `thickness`
    std::optional<double> first;         ///< height of the layer at the wall [mm]; overrides both
};

/// Layers on a wall: below each of its vertices a straight column.
struct WallLayers {
    LayeredWall wall;
    Positions directions;         ///< unit, into the lumen, #V of the wall
    std::vector<double> lengths;  ///< of the columns [mm], #V
    std::vector<double> wished;   ///< what they would be without limits [mm], #V
    std::vector<double> levels;   ///< of the layers' ends in a column [-], from 0 to 1, #layers + 1
    Surface inner;  ///< the surface below the layers: the given one with its vertices moved

    /// A column's point at a level [mm].
    [[nodiscard]] Vec3 at(VertexId v, double level) const {
        return wall.wall.points()[v] + level * lengths[v] * directions[v];
    }
};

/// Ends of the layers in a column [-], from 0 at the wall to 1. #layers + 1
[[nodiscard]] std::vector<double> layer_levels(int layers, double growth);

/// Lowers the lengths until they differ by at most 0.4 of the distance between neighbours.
[[nodiscard]] std::vector<double> graded_lengths(const Surface& wall, std::vector<double> lengths);

/// Grows layers on the wall of a closed surface. The wished thickness is limited to 0.45 of the
/// touching ball's radius, differs between neighbours by at most 0.4 of their distance, and is
/// lowered around prisms with a scaled Jacobian below 0.2 (where the wall's own triangle is
/// worse: below 0.8 of its), around openings whose triangles would turn over, and where the inner
/// surface would cross itself.
/// \throw DiagnosedFailure with the place where no valid layer is found
[[nodiscard]] WallLayers wall_layers(const Surface& surface, const LayerParameters& parameters,
                                     const Progress& progress = {});

}  // namespace vesselbench
