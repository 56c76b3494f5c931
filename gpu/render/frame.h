#pragma once

#include <array>

#include "gpu/render/layers.h"
#include "gpu/render/programs.h"

namespace vesselbench {

/// What all layers of one drawing of a view share.
struct Frame {
    SceneView view;
    PixelRectangle region;  ///< the part of the view's rectangle that is drawn
    Sphere scene;
    Eigen::Matrix4d clip =
        Eigen::Matrix4d::Identity();  ///< from points [mm] to the region's clip coordinates
};

/// \param region part of the view's rectangle, in pixels of its framebuffer
[[nodiscard]] Frame make_frame(const SceneView& view, const Layers& layers,
                               const PixelRectangle& region);

/// How far marks are pulled towards the eye [mm]: their discs would sink into the surface they
/// mark.
[[nodiscard]] double mark_pull(const SceneView& view, const Vec3& place);

/// How something is placed in a frame.
struct Placing {
    Vec3 centre = Vec3::Zero();  ///< origin of its positions [mm]
    double pull = 0.0;           ///< how much nearer to the eye it is for hiding others [mm]
    bool clipped = false;        ///< by the view's clip plane
};

/// Sets what gpu/shaders/camera.glsl and light.glsl need, and enables clipping.
void set_frame(const Uniforms& uniforms, const Frame& frame, const Placing& placing);

/// Corners of the clip plane's section through a sphere, relative to its centre: a strip.
[[nodiscard]] std::array<Eigen::Vector3f, 4> plane_corners(const ClipPlane& plane,
                                                           const Sphere& sphere);

}  // namespace vesselbench
