#pragma once

#include "gpu/objects.h"
#include "gpu/picture.h"

namespace vesselbench {

/// Transformations from positions [mm] relative to a centre to the picture.
struct Camera {
    Eigen::Matrix4f to_clip = Eigen::Matrix4f::Identity();
    Eigen::Matrix3f to_eye = Eigen::Matrix3f::Identity();  ///< for directions
};

/// \throw InvalidInput unless the picture is 1 to 8192 pixels wide and high
void require_size(const PictureOptions& options);

/// Orthographic: the eye looks along -z of a right-handed frame; everything within the model's
/// bounding sphere is within the depth range.
/// \throw InvalidInput if the options' directions are parallel
[[nodiscard]] Camera camera_for(const Positions& points, const Vec3& centre,
                                const PictureOptions& options);

/// Uses a program and sets its `to_clip` and `to_eye`.
void set_matrices(const Program& program, const Camera& camera);

/// A white canvas with 4 samples per pixel in the current context: subsequent drawing goes to it.
class Canvas {
public:
    /// \throw GpuUnavailable if the device offers no framebuffer of this size
    Canvas(int width, int height);

    [[nodiscard]] Picture picture() const;

private:
    /// A framebuffer with colour and depth attachments of one size.
    struct Target {
        Target(int width, int height, int samples);
        Framebuffer frame;
        Renderbuffer colour, depth;
    };

    int width_, height_;
    Target multisampled_;
};

}  // namespace vesselbench
