#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "geometry/kernel/progress.h"
#include "geometry/kernel/surface.h"

namespace vesselbench {

/// A measure of a surface's vertices in colours, with what a viewer needs for its legend.
struct GlbColours {
    std::string name;                              ///< of the measure, "local-radius"
    std::string label;                             ///< "Local radius"
    std::string unit;                              ///< "mm"; empty: a plain number
    double least = 0.0, most = 1.0;                ///< values of the first and the last colour
    std::vector<std::array<std::uint8_t, 3>> map;  ///< sRGB from `least` to `most`, equal steps
    std::vector<std::array<float, 3>> vertices;    ///< linear RGB in [0, 1], #V
};

/// What a GLB file shows.
struct GlbModel {
    Surface surface;
    std::map<std::string, Surface> neighbours;  ///< other structures by name
    std::optional<GlbColours> colours;          ///< of the surface's wall; none: by patch
    std::string provenance = {};                ///< `extras` of the asset; empty: none
};

/// Writes binary glTF 2.0 for viewers. The node "model" has the children "vessel", with a node for
/// each patch by its name, and "neighbours", with a node for each neighbour by its name; materials
/// have the same names, those of neighbours are translucent. Normals are smooth. A measure colours
/// the wall (COLOR_0); its name, label, unit, range and map are the `extras` of the wall's node.
/// Positions are floats relative to the centre of all in mm; the node "model" scales to glTF's
/// metres and turns the patient's head (+z) up (+y), its `extras` hold the centre.
/// \throw InvalidInput if the surface has no triangle, or a colour is missing; IoError, Cancelled
void write_glb(const GlbModel& model, const std::string& path, const Progress& progress = {});

}  // namespace vesselbench
