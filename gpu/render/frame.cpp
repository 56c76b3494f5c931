#include "gpu/render/frame.h"

#include <algorithm>
#include <cmath>

#include <epoxy/gl.h>

namespace vesselbench {

namespace {

/// Magnifies the part of clip coordinates that a region of a rectangle shows.
Eigen::Matrix4d magnified(const PixelRectangle& all, const PixelRectangle& region) {
    Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
    const auto axis = [&](int i, int start, int size, int from, int length) {
        const double middle = 2.0 * (from - start + 0.5 * length) / size - 1.0;
        matrix(i, i) = static_cast<double>(size) / length;
        matrix(i, 3) = -middle * matrix(i, i);
    };
    axis(0, all.x, all.width, region.x, region.width);
    axis(1, all.y, all.height, region.y, region.height);
    return matrix;
}

/// Positions relative to a centre as patient coordinates.
Eigen::Matrix4d moved_by(const Vec3& centre) {
    Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
    matrix.topRightCorner<3, 1>() = centre;
    return matrix;
}

Eigen::Matrix4d eye_matrix(const ViewCamera& camera, const Vec3& centre) {
    Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
    matrix.topLeftCorner<3, 3>() = to_eye(camera);
    matrix.topRightCorner<3, 1>() = matrix.topLeftCorner<3, 3>() * (centre - camera.centre);
    return matrix;
}

/// The scene's sphere, larger by what layers are pulled towards the eye.
Sphere roomy_bounds(const SceneView& view, const Layers& layers) {
    Sphere scene = bounds_of(layers);
    double pull = 0.0;
    for (const SurfaceLayer& layer : layers.surfaces) pull = std::max(pull, layer.pull);
    for (const LinesLayer& layer : layers.lines) pull = std::max(pull, layer.pull);
    if (!layers.points.empty()) pull = std::max(pull, mark_pull(view, scene.centre));
    scene.radius = 1.002 * scene.radius + 1.5 * pull;
    return scene;
}

// What is not clipped has this plane too: llvmpipe was seen to clip by a distance that is disabled.
const Eigen::Vector4d kKeepsAll(0.0, 0.0, 0.0, 1.0);

Eigen::Vector4d plane_about(const ClipPlane& clip, const Vec3& centre) {
    const Vec3 normal = clip.normal.normalized();
    return {-normal.x(), -normal.y(), -normal.z(), normal.dot(clip.point - centre)};
}

Eigen::Vector4d eye_about(const ViewCamera& camera, const Vec3& centre) {
    const Vec3 place =
        camera.perspective ? Vec3(eye_of(camera) - centre) : Vec3(-camera.view.normalized());
    return {place.x(), place.y(), place.z(), camera.perspective ? 1.0 : 0.0};
}

}  // namespace

double mark_pull(const SceneView& view, const Vec3& place) {
    constexpr double kPixels = 6.0;
    return kPixels * pixel_size(view.camera, view.rectangle.height, place);
}

Frame make_frame(const SceneView& view, const Layers& layers, const PixelRectangle& region) {
    Frame frame{view, region, roomy_bounds(view, layers)};
    frame.clip = magnified(view.rectangle, region) *
                 to_clip(view.camera, view.rectangle.aspect(), frame.scene);
    return frame;
}

void set_frame(const Uniforms& uniforms, const Frame& frame, const Placing& placing) {
    const Vec3& centre = placing.centre;
    const bool clipped = placing.clipped && frame.view.clip.has_value();
    const ViewCamera& camera = frame.view.camera;
    uniforms.set("to_clip", Eigen::Matrix4d(frame.clip * moved_by(centre)));
    uniforms.set("to_eye", eye_matrix(camera, centre));
    uniforms.set("eye", eye_about(camera, centre));
    uniforms.set("clip_plane", clipped ? plane_about(*frame.view.clip, centre) : kKeepsAll);
    uniforms.set("pull", placing.pull);
    if (clipped)
        glEnable(GL_CLIP_DISTANCE0);
    else
        glDisable(GL_CLIP_DISTANCE0);
    uniforms.set("viewport", Eigen::Vector2d(frame.region.width, frame.region.height));
    uniforms.set("eye_distance", camera.perspective ? eye_distance(camera) : 0.0);
}

std::array<Eigen::Vector3f, 4> plane_corners(const ClipPlane& plane, const Sphere& sphere) {
    const Vec3 normal = plane.normal.normalized();
    const Vec3 across = sphere.radius * normal.unitOrthogonal(), down = normal.cross(across);
    const Vec3 middle = normal * normal.dot(plane.point - sphere.centre);
    return {(middle - across - down).cast<float>(), (middle + across - down).cast<float>(),
            (middle - across + down).cast<float>(), (middle + across + down).cast<float>()};
}

}  // namespace vesselbench
