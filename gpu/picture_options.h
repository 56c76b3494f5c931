#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "geometry/kernel/surface.h"
#include "gpu/colours.h"

namespace vesselbench {

/// An image of 8-bit RGB pixels, rows from the top.
struct Picture {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> rgb;
};

/// How a surface is drawn.
struct PictureOptions {
    int width = 900;             ///< [pixels]
    int height = 900;            ///< [pixels]
    Vec3 view = Vec3(0, -1, 0);  ///< view direction, from the eye to the model
    Vec3 up = Vec3(0, 0, 1);
    double zoom = 1.0;  ///< 1: the whole model fits; 2: twice as large
    Vec3 shift =
        Vec3::Zero();    ///< centre of the picture, relative to the bounding box's centre [mm]
    bool edges = false;  ///< draw the triangles' edges
    std::vector<Colour> vertex_colours;   ///< #V; empty: by patch (wall, inlet, outlets)
    Colour back = {0.75F, 0.12F, 0.10F};  ///< for triangles seen from inside
    bool sharp = false;                   ///< one normal per triangle instead of smooth shading
    /// Bounds for the camera instead of the surface's: pictures side by side then share one view.
    std::shared_ptr<const Surface> frame = nullptr;
    double half_height = 0.0;  ///< half the height of the view [mm]; 0: from zoom
    Colour background = Colour::Ones();
    /// Another surface whose edges are drawn over this one unless they are far behind it.
    std::shared_ptr<const Surface> wires = nullptr;
};

}  // namespace vesselbench
