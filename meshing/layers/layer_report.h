#pragma once

#include <cstddef>
#include <vector>

#include "geometry/kernel/surface.h"
#include "meshing/layers/wall_layers.h"

namespace vesselbench {

/// Where layers are much thinner than they should be.
struct ThinPlace {
    Vec3 place = Vec3::Zero();  ///< of the thinnest column nearby, on the wall [mm]
    double thickness = 0.0;     ///< [mm]
    double share = 1.0;         ///< of what it should be [-]
};

/// Thicknesses are measured along the wall's normals; shares of area are of the wall's.
struct LayerReport {
    int layers = 0;
    std::size_t prisms = 0;
    double covered = 1.0;    ///< share of the wall's area with all layers [-]
    double wished = 0.0;     ///< median of what all layers together would be without limits [mm]
    double thickness = 0.0;  ///< median of all layers together [mm]
    double thinnest = 0.0;   ///< [mm]
    double first = 0.0;      ///< median height of the layer at the wall [mm]
    double limited = 0.0;    ///< share of the area below 98 % of the thickness wished [-]
    double half = 0.0;       ///< share of the area below half of it [-]
    /// Share of the area below the layers at which one cell has over twice the other's volume [-].
    double steep = 0.0;
    std::vector<ThinPlace> places;  ///< below half of the thickness, the thinnest first, a few
};

/// All but `steep`, for which the cells inside are needed.
[[nodiscard]] LayerReport layer_report(const WallLayers& layers);

}  // namespace vesselbench
