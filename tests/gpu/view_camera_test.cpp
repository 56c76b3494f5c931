#include "gpu/render/view_camera.h"

#include <cmath>

#include <Eigen/LU>
#include <catch2/catch.hpp>

#include "geometry/kernel/errors.h"

using namespace vesselbench;
using Eigen::Vector2d;

namespace {

constexpr double kAspect = 1.6;

ViewCamera skew_camera(bool perspective) {
    return {.centre = Vec3(120.0, -340.0, 56.0),
            .view = Vec3(0.3, 0.8, -0.4),
            .up = Vec3(0.1, 0.2, 0.9),
            .half_height = 35.0,
            .perspective = perspective,
            .field_of_view_deg = 40.0};
}

/// A point in clip coordinates after division.
Vec3 clipped(const ViewCamera& camera, const Vec3& point, const Sphere& scene) {
    const Eigen::Vector4d clip = to_clip(camera, kAspect, scene) * point.homogeneous();
    return clip.head<3>() / clip.w();
}

}  // namespace

SCENARIO("A point seen at a place lies on the ray through it", "[gpu][render][camera]") {
    const bool perspective = GENERATE(false, true);
    const ViewCamera camera = skew_camera(perspective);
    const Vec3 point = camera.centre + Vec3(11.0, -7.0, 5.0);
    const Vec3 seen = project(camera, kAspect, point).value();
    CHECK((unproject(camera, kAspect, seen) - point).norm() < 1e-10);
    const Ray ray = ray_through(camera, kAspect, seen.head<2>());
    CHECK(ray.direction.cross(point - ray.from).norm() < 1e-9);
    CHECK(ray.direction.dot(point - ray.from) > 0.0);
    CHECK(ray.direction.norm() == Approx(1.0));
    THEN("the matrix of the device maps it to the same place") {
        const Vec3 clip = clipped(camera, point, {camera.centre, 30.0});
        CHECK((clip.head<2>() - seen.head<2>()).norm() < 1e-12);
    }
    THEN("a point behind the eye is not seen") {
        const Vec3 behind = eye_of(camera) - 3.0 * camera.view;
        CHECK(project(camera, kAspect, behind).has_value() == !perspective);
    }
}

SCENARIO("The depth range encloses the scene, nearer things have smaller depths",
         "[gpu][render][camera]") {
    const ViewCamera camera = skew_camera(GENERATE(false, true));
    const Sphere scene{camera.centre + Vec3(3.0, 2.0, 1.0), 25.0};
    const Vec3 view = camera.view.normalized();
    const double near = clipped(camera, scene.centre - 25.0 * view, scene).z();
    const double far = clipped(camera, scene.centre + 25.0 * view, scene).z();
    CHECK(near > -1.0);
    CHECK(far < 1.0);
    CHECK(near < far);
}

SCENARIO("Perspective and parallel views agree at the centre", "[gpu][render][camera]") {
    const ViewCamera parallel = skew_camera(false), perspective = skew_camera(true);
    const Eigen::Matrix3d eye = to_eye(parallel);
    const Vec3 in_plane = parallel.centre + eye.transpose() * Vec3(9.0, -14.0, 0.0);
    const Vec3 a = project(parallel, kAspect, in_plane).value();
    const Vec3 b = project(perspective, kAspect, in_plane).value();
    CHECK((a - b).norm() < 1e-12);
    CHECK(pixel_size(parallel, 700, in_plane) == Approx(0.1));
    CHECK(pixel_size(perspective, 700, in_plane) == Approx(0.1));
}

SCENARIO("Zooming keeps the point under the cursor", "[gpu][render][camera]") {
    const ViewCamera camera = skew_camera(GENERATE(false, true));
    const Vector2d cursor(0.6, -0.3);
    const Vec3 under = unproject(camera, kAspect, Vec3(cursor.x(), cursor.y(), 0.0));
    const ViewCamera nearer = zoomed(camera, kAspect, 3.0, cursor);
    CHECK((project(nearer, kAspect, under).value().head<2>() - cursor).norm() < 1e-12);
    CHECK(nearer.half_height == Approx(camera.half_height / 3.0));
    const ViewCamera back = zoomed(nearer, kAspect, 1.0 / 3.0, cursor);
    CHECK((back.centre - camera.centre).norm() < 1e-10);
}

SCENARIO("Panning moves the point under the cursor along", "[gpu][render][camera]") {
    const ViewCamera camera = skew_camera(GENERATE(false, true));
    const double depth = GENERATE(0.0, -12.0, 20.0);
    const Vec3 point = unproject(camera, kAspect, Vec3(-0.2, 0.1, depth));
    const ViewCamera moved = panned(camera, kAspect, {-0.2, 0.1}, {0.5, 0.4}, depth);
    CHECK((project(moved, kAspect, point).value() - Vec3(0.5, 0.4, depth)).norm() < 1e-10);
}

SCENARIO("Turning keeps distances and the centre", "[gpu][render][camera]") {
    const ViewCamera camera = skew_camera(true);
    const ViewCamera turned_one = turned(camera, 0.7, -0.4);
    CHECK(turned_one.centre == camera.centre);
    CHECK((eye_of(turned_one) - camera.centre).norm() == Approx(eye_distance(camera)));
    CHECK(to_eye(turned_one).determinant() == Approx(1.0));
    THEN("what is in front follows the cursor") {
        const Vec3 front = camera.centre - 10.0 * camera.view.normalized();
        const Vec3 right = project(turned(camera, 0.1, 0.0), kAspect, front).value();
        CHECK(right.x() > 0.01);
        CHECK(std::abs(right.y()) < 1e-9);
        CHECK(project(turned(camera, 0.0, 0.1), kAspect, front).value().y() > 0.01);
    }
    THEN("rolling turns the picture counter-clockwise") {
        const Vec3 right = unproject(camera, kAspect, Vec3(0.5, 0.0, 0.0));
        CHECK(project(rolled(camera, 0.2), kAspect, right).value().y() > 0.05);
    }
    THEN("looking round keeps the eye") {
        const ViewCamera looked = looked_round(camera, 0.3, 0.2);
        CHECK((eye_of(looked) - eye_of(camera)).norm() < 1e-9);
        CHECK(looked.view.dot(camera.view.normalized()) < 0.97);
    }
}

SCENARIO("A framed box fits, and no more than that", "[gpu][render][camera]") {
    const ViewCamera camera = framed(skew_camera(GENERATE(false, true)),
                                     Bounds{Vec3(10, 20, 30), Vec3(40, 90, 45)}, kAspect, 0.0);
    double reach = 0.0;
    for (int i = 0; i < 8; ++i) {
        const Vec3 corner(i & 1 ? 40 : 10, i & 2 ? 90 : 20, i & 4 ? 45 : 30);
        reach = std::max(
            reach, project(camera, kAspect, corner).value().head<2>().lpNorm<Eigen::Infinity>());
    }
    CHECK(reach == Approx(1.0));
    CHECK((camera.centre - Vec3(25, 55, 37.5)).norm() < 1e-12);
}

SCENARIO("Standard views show the patient's sides", "[gpu][render][camera]") {
    const auto right_of = [](StandardView side) {
        return Vec3(to_eye(facing(ViewCamera{}, side)).row(0));
    };
    // from the front, the patient's left (+x) is on the right
    CHECK(right_of(StandardView::Anterior).isApprox(Vec3(1, 0, 0)));
    CHECK(right_of(StandardView::Posterior).isApprox(Vec3(-1, 0, 0)));
    CHECK(right_of(StandardView::Left).isApprox(Vec3(0, 1, 0)));
    CHECK(right_of(StandardView::Right).isApprox(Vec3(0, -1, 0)));
    for (const StandardView side : {StandardView::Superior, StandardView::Inferior})
        CHECK_NOTHROW(to_eye(facing(ViewCamera{}, side)));
}

SCENARIO("A camera in a lumen looks from its place", "[gpu][render][camera]") {
    const Vec3 place(3, 4, 5);
    const ViewCamera camera = looking_from(place, Vec3(1, 1, 0), Vec3(0, 0, 1), 7.0);
    CHECK((eye_of(camera) - place).norm() < 1e-12);
    CHECK((camera.centre - place).norm() == Approx(7.0));
}

SCENARIO("Directions that do not span a view are rejected", "[gpu][render][camera]") {
    CHECK_THROWS_AS(to_eye({.view = Vec3(0, 0, 2), .up = Vec3(0, 0, 1)}), InvalidInput);
    CHECK_THROWS_AS(to_eye({.view = Vec3::Zero()}), InvalidInput);
}
