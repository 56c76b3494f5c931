#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
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
    Vec3 view = Vec3(0, -1, 0);  ///< direction of sight, from the eye to the model
    Vec3 up = Vec3(0, 0, 1);
    double zoom = 1.0;  ///< 1: the whole model fits; 2: twice as large
    Vec3 shift =
        Vec3::Zero();    ///< what is in the middle, relative to the bounding box's centre [mm]
    bool edges = false;  ///< draw the triangles' edges
    std::vector<Colour> vertex_colours;   ///< #V; empty: by patch (wall, inlet, outlets)
    Colour back = {0.75F, 0.12F, 0.10F};  ///< of triangles seen from their inner side
    bool sharp = false;                   ///< one normal per triangle instead of smooth shading
    /// What the camera is set up for in place of the surface: pictures side by side show the same.
    std::shared_ptr<const Surface> frame = nullptr;
    double half_height = 0.0;  ///< what the picture shows above its middle [mm]; 0: as zoom says
    /// Another surface whose edges are drawn over this one, where they are not far behind it.
    std::shared_ptr<const Surface> wires = nullptr;
};

/// Draws a surface off the screen, 4 samples a pixel, orthographic, on white.
/// \throw GpuUnavailable if there is no usable OpenGL; InvalidInput for an empty surface or a size
/// that is not usable
[[nodiscard]] Picture draw(const Surface& surface, const PictureOptions& options = {});

/// One picture per view, in one context, whose shaders are compiled once.
[[nodiscard]] std::vector<Picture> draw_views(const Surface& surface,
                                              std::span<const PictureOptions> views);

/// What is up in a picture along a unit direction: the head, or, from above or below, the front.
[[nodiscard]] Vec3 upward_for(const Vec3& view);

}  // namespace vesselbench
