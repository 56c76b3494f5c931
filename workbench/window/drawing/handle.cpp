#include "workbench/window/drawing/handle.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vesselbench {

namespace {

/// A line is dragged only if it makes at least this angle with the view's direction [sine].
constexpr double kLeastSine = 0.12;

Vec3 on_plane(const Handle& handle, const PixelView& view, const ViewPixel& pixel) {
    const auto seen = project(view.camera, view.aspect(), handle.point);
    if (!seen) return handle.point;
    const Eigen::Vector2d ndc = view.ndc(pixel);
    return unproject(view.camera, view.aspect(), {ndc.x(), ndc.y(), seen->z()});
}

/// The point of the line that is closest to the ray.
Vec3 on_line(const Handle& handle, const Ray& ray) {
    const double cosine = handle.direction.dot(ray.direction);
    const double sine_squared = 1.0 - cosine * cosine;
    if (sine_squared < kLeastSine * kLeastSine) return handle.point;
    const Vec3 to_ray = ray.from - handle.point;
    const double along =
        (handle.direction.dot(to_ray) - cosine * ray.direction.dot(to_ray)) / sine_squared;
    return handle.point + along * handle.direction;
}

/// The point of the polyline that is seen nearest to the pixel.
Vec3 on_track(const Handle& handle, const PixelView& view, const ViewPixel& pixel) {
    Vec3 best = handle.point;
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i + 1 < handle.track.size(); ++i) {
        const auto from = view.place(handle.track[i]), to = view.place(handle.track[i + 1]);
        if (!from || !to) continue;
        const ViewPixel edge = *to - *from;
        const double squared = edge.squaredNorm();
        const double share =
            squared > 0.0 ? std::clamp(edge.dot(pixel - *from) / squared, 0.0, 1.0) : 0.0;
        const double distance = (*from + share * edge - pixel).norm();
        if (distance >= nearest) continue;
        nearest = distance;
        best = handle.track[i] + share * (handle.track[i + 1] - handle.track[i]);
    }
    return best;
}

/// On the side of the ball, near or far, on which the handle is; beside the ball on its outline.
Vec3 on_ball(const Handle& handle, const Ray& ray) {
    const Vec3 arm = handle.point - handle.pivot;
    const Vec3 to_pivot = handle.pivot - ray.from;
    const Vec3 foot = ray.from + ray.direction.dot(to_pivot) * ray.direction;
    const Vec3 beside = foot - handle.pivot;
    const double depth_squared = arm.squaredNorm() - beside.squaredNorm();
    if (depth_squared <= 0.0) return handle.pivot + arm.norm() * beside.normalized();
    const double side = arm.dot(ray.direction) > 0.0 ? 1.0 : -1.0;
    return foot + side * std::sqrt(depth_squared) * ray.direction;
}

}  // namespace

bool can_be_dragged(const Handle& handle, const PixelView& view) {
    if (handle.path != HandlePath::Line) return true;
    const auto at = view.place(handle.point);
    if (!at) return false;
    const double cosine = handle.direction.dot(view.ray(*at).direction);
    return 1.0 - cosine * cosine >= kLeastSine * kLeastSine;
}

std::optional<std::size_t> nearest_handle(const std::vector<Handle>& handles, const PixelView& view,
                                          const ViewPixel& cursor, double reach) {
    std::vector<std::optional<ViewPixel>> places;
    for (const Handle& handle : handles)
        places.push_back(can_be_dragged(handle, view) ? view.place(handle.point) : std::nullopt);
    return nearest_to(cursor, places, reach);
}

Vec3 dragged_point(const Handle& handle, const PixelView& view, const ViewPixel& pixel) {
    switch (handle.path) {
        case HandlePath::Free:
            return on_plane(handle, view, pixel);
        case HandlePath::Line:
            return on_line(handle, view.ray(pixel));
        case HandlePath::Track:
            return on_track(handle, view, pixel);
        case HandlePath::Ball:
            return on_ball(handle, view.ray(pixel));
    }
    return handle.point;
}

}  // namespace vesselbench
