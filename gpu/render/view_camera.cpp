#include "gpu/render/view_camera.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

#include "geometry/kernel/errors.h"

namespace vesselbench {

namespace {

constexpr double kFarBefore = 1e4;      // [mm] no vessel is larger: rays start before everything
constexpr double kNearestShare = 5e-4;  // of the far plane: keeps 24 bits of depth apart in a lumen

double slope(const ViewCamera& camera) {
    return std::tan(0.5 * camera.field_of_view_deg * std::numbers::pi / 180.0);
}

/// Half height of the view at a depth beyond the centre's plane [mm].
double half_height_at(const ViewCamera& camera, double depth) {
    return camera.half_height + (camera.perspective ? depth * slope(camera) : 0.0);
}

/// Of a point, relative to the centre: right, up and depth beyond the centre's plane [mm].
Vec3 placed(const ViewCamera& camera, const Vec3& point) {
    const Vec3 place = to_eye(camera) * (point - camera.centre);
    return {place.x(), place.y(), -place.z()};
}

ViewCamera rotated(const ViewCamera& camera, const Eigen::Matrix3d& rotation) {
    ViewCamera moved = camera;
    const Eigen::Matrix3d eye = to_eye(camera);
    moved.view = (rotation * -eye.row(2).transpose()).normalized();
    moved.up = (rotation * eye.row(1).transpose()).normalized();
    return moved;
}

Eigen::Matrix3d about(const Vec3& axis, double angle) {
    return Eigen::AngleAxisd(angle, axis).toRotationMatrix();
}

Eigen::Matrix3d turn(const ViewCamera& camera, double right, double up) {
    const Eigen::Matrix3d eye = to_eye(camera);
    return about(eye.row(1), -right) * about(eye.row(0), up);
}

/// Smallest and largest distance from the eye (perspective) or from the centre's plane (parallel).
std::array<double, 2> depth_range(const ViewCamera& camera, const Sphere& scene) {
    const double reach = std::max(1.01 * scene.radius, 1e-6 * camera.half_height + 1e-9);
    const double middle = placed(camera, scene.centre).z();
    if (!camera.perspective) return {middle - reach, middle + reach};
    const double distance = eye_distance(camera);
    const double furthest = std::max(distance + middle + reach, 1e-3 * distance);
    return {std::max(distance + middle - reach, kNearestShare * furthest), furthest};
}

Eigen::Matrix4d parallel_matrix(double width, double height, std::array<double, 2> range) {
    Eigen::Matrix4d clip = Eigen::Matrix4d::Identity();
    const double depth = range[1] - range[0];
    clip.diagonal() << 1.0 / width, 1.0 / height, -2.0 / depth, 1.0;
    clip(2, 3) = -(range[0] + range[1]) / depth;
    return clip;
}

/// Of points relative to the eye.
Eigen::Matrix4d perspective_matrix(double wide, double high, std::array<double, 2> range) {
    Eigen::Matrix4d clip = Eigen::Matrix4d::Zero();
    const double depth = range[1] - range[0];
    clip.diagonal() << 1.0 / wide, 1.0 / high, -(range[0] + range[1]) / depth, 0.0;
    clip(2, 3) = -2.0 * range[0] * range[1] / depth;
    clip(3, 2) = -1.0;
    return clip;
}

}  // namespace

Eigen::Matrix3d to_eye(const ViewCamera& camera) {
    const Vec3 back = -camera.view.normalized();
    const Vec3 right = camera.up.normalized().cross(back);
    if (!(right.norm() > 1e-9) || !(back.norm() > 0.5))
        throw InvalidInput("the view direction and the up direction must not be parallel");
    Eigen::Matrix3d eye;
    eye << right.normalized().transpose(), back.cross(right.normalized()).transpose(),
        back.transpose();
    return eye;
}

double eye_distance(const ViewCamera& camera) {
    return camera.half_height / slope(camera);
}

Vec3 eye_of(const ViewCamera& camera) {
    return camera.centre - camera.view.normalized() * eye_distance(camera);
}

Eigen::Matrix4d to_clip(const ViewCamera& camera, double aspect, const Sphere& scene) {
    const std::array<double, 2> range = depth_range(camera, scene);
    Eigen::Matrix4d eye = Eigen::Matrix4d::Identity();
    eye.topLeftCorner<3, 3>() = to_eye(camera);
    const Vec3 origin = camera.perspective ? eye_of(camera) : camera.centre;
    eye.topRightCorner<3, 1>() = -eye.topLeftCorner<3, 3>() * origin;
    if (camera.perspective)
        return perspective_matrix(slope(camera) * aspect, slope(camera), range) * eye;
    return parallel_matrix(camera.half_height * aspect, camera.half_height, range) * eye;
}

Ray ray_through(const ViewCamera& camera, double aspect, const Eigen::Vector2d& ndc) {
    const Vec3 seen = unproject(camera, aspect, Vec3(ndc.x(), ndc.y(), 0.0));
    const Vec3 view = camera.view.normalized();
    if (!camera.perspective) return {seen - kFarBefore * view, view};
    const Vec3 eye = eye_of(camera);
    return {eye, (seen - eye).normalized()};
}

std::optional<Vec3> project(const ViewCamera& camera, double aspect, const Vec3& point) {
    const Vec3 place = placed(camera, point);
    const double height = half_height_at(camera, place.z());
    if (!(height > 0.0)) return std::nullopt;
    return Vec3(place.x() / (height * aspect), place.y() / height, place.z());
}

Vec3 unproject(const ViewCamera& camera, double aspect, const Vec3& projected) {
    const double height = half_height_at(camera, projected.z());
    const Vec3 place(projected.x() * height * aspect, projected.y() * height, -projected.z());
    return camera.centre + to_eye(camera).transpose() * place;
}

double pixel_size(const ViewCamera& camera, int height, const Vec3& point) {
    return 2.0 * std::max(half_height_at(camera, placed(camera, point).z()), 0.0) /
           std::max(height, 1);
}

double fitting_half_height(const ViewCamera& camera, std::span<const Vec3> points, double aspect) {
    const Eigen::Matrix3d eye = to_eye(camera);
    const double nearer = camera.perspective ? slope(camera) : 0.0;
    double fitting = 1e-9;
    for (const Vec3& point : points) {
        const Vec3 place = eye * (point - camera.centre);
        const double side = std::max(std::abs(place.y()), std::abs(place.x()) / aspect);
        fitting = std::max(fitting, side + nearer * place.z());
    }
    return fitting;
}

ViewCamera framed(const ViewCamera& camera, std::span<const Vec3> points, double aspect,
                  double margin) {
    ViewCamera fitted = camera;
    Eigen::AlignedBox3d box;
    for (const Vec3& point : points) box.extend(point);
    if (points.empty()) return fitted;
    fitted.centre = box.center();
    fitted.half_height = (1.0 + margin) * fitting_half_height(fitted, points, aspect);
    return fitted;
}

ViewCamera framed(const ViewCamera& camera, const Bounds& box, double aspect, double margin) {
    Positions corners;
    for (int i = 0; i < 8; ++i)
        corners.emplace_back((i & 1 ? box.max : box.min).x(), (i & 2 ? box.max : box.min).y(),
                             (i & 4 ? box.max : box.min).z());
    return framed(camera, corners, aspect, margin);
}

ViewCamera turned(const ViewCamera& camera, double right, double up) {
    return rotated(camera, turn(camera, right, up));
}

ViewCamera rolled(const ViewCamera& camera, double angle) {
    return rotated(camera, about(camera.view.normalized(), angle));
}

ViewCamera panned(const ViewCamera& camera, double aspect, const Eigen::Vector2d& from,
                  const Eigen::Vector2d& to, double depth) {
    ViewCamera moved = camera;
    moved.centre += unproject(camera, aspect, Vec3(from.x(), from.y(), depth)) -
                    unproject(camera, aspect, Vec3(to.x(), to.y(), depth));
    return moved;
}

ViewCamera zoomed(const ViewCamera& camera, double aspect, double factor,
                  const Eigen::Vector2d& towards) {
    ViewCamera moved = camera;
    moved.half_height = camera.half_height / factor;
    const Vec3 stays = unproject(camera, aspect, Vec3(towards.x(), towards.y(), 0.0));
    moved.centre = stays + (camera.centre - stays) / factor;
    return moved;
}

ViewCamera facing(const ViewCamera& camera, StandardView side) {
    struct Directions {
        Vec3 view, up;
    };

    // +x is left, +y posterior, +z superior
    static const std::array<Directions, 6> kSides = {{{Vec3(0, 1, 0), Vec3(0, 0, 1)},
                                                      {Vec3(0, -1, 0), Vec3(0, 0, 1)},
                                                      {Vec3(-1, 0, 0), Vec3(0, 0, 1)},
                                                      {Vec3(1, 0, 0), Vec3(0, 0, 1)},
                                                      {Vec3(0, 0, -1), Vec3(0, -1, 0)},
                                                      {Vec3(0, 0, 1), Vec3(0, -1, 0)}}};
    ViewCamera moved = camera;
    moved.view = kSides[static_cast<std::size_t>(side)].view;
    moved.up = kSides[static_cast<std::size_t>(side)].up;
    return moved;
}

ViewCamera looking_from(const Vec3& eye, const Vec3& view, const Vec3& up, double distance,
                        double field_of_view_deg) {
    ViewCamera camera{.centre = eye + distance * view.normalized(),
                      .view = view.normalized(),
                      .up = up,
                      .perspective = true,
                      .field_of_view_deg = field_of_view_deg};
    camera.half_height = distance * slope(camera);
    return camera;
}

ViewCamera looked_round(const ViewCamera& camera, double right, double up) {
    ViewCamera moved = rotated(camera, turn(camera, -right, -up));
    moved.centre = eye_of(camera) + moved.view * eye_distance(camera);
    return moved;
}

}  // namespace vesselbench
