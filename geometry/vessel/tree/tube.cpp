#include "geometry/vessel/tree/tube.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace vesselbench {

namespace {

Vec3 least_along(const Vec3& direction) {
    int smallest = 0;
    direction.cwiseAbs().minCoeff(&smallest);
    return Vec3::Unit(smallest);
}

Vec3 perpendicular(const Vec3& first, const Vec3& tangent) {
    Vec3 result = first - first.dot(tangent) * tangent;
    if (result.norm() < 1e-9) result = tangent.cross(least_along(tangent));
    return result.normalized();
}

double share_of(const Vec3& edge, const Vec3& from_start) {
    return std::clamp(edge.dot(from_start) / std::max(edge.squaredNorm(), 1e-300), 0.0, 1.0);
}

template <class Value>
Value between(const std::vector<Value>& values, const AxisPlace& p) {
    return (1.0 - p.t) * values[p.segment] + p.t * values[p.segment + 1];
}

}  // namespace

Tube::Tube(Positions points, std::vector<double> radii, const std::optional<Vec3>& first)
    : points_(std::move(points)), radii_(std::move(radii)), along_(1, 0.0) {
    const std::size_t n = points_.size();
    for (std::size_t i = 1; i < n; ++i)
        along_.push_back(along_.back() + (points_[i] - points_[i - 1]).norm());
    for (std::size_t i = 0; i < n; ++i) {
        const Vec3 &before = points_[i == 0 ? 0 : i - 1], &after = points_[std::min(i + 1, n - 1)];
        tangents_.push_back((after - before).normalized());
    }
    firsts_.push_back(perpendicular(first.value_or(least_along(tangents_[0])), tangents_[0]));
    for (std::size_t i = 1; i < n; ++i)
        firsts_.push_back(perpendicular(firsts_.back(), tangents_[i]));
}

AxisPlace Tube::at(double along) const {
    const auto after = std::upper_bound(along_.begin() + 1, along_.end() - 1, along);
    const auto i = static_cast<std::size_t>(after - along_.begin()) - 1;
    return {i, (along - along_[i]) / (along_[i + 1] - along_[i])};
}

AxisPlace Tube::nearest(const Vec3& x, std::size_t first, std::size_t last) const {
    AxisPlace best;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = first; i <= last; ++i) {
        const Vec3 edge = points_[i + 1] - points_[i];
        const double t = share_of(edge, x - points_[i]);
        const double d = (points_[i] + t * edge - x).squaredNorm();
        if (d < least) {
            least = d;
            best = {i, t};
        }
    }
    return best;
}

AxisPlace Tube::nearest(const Vec3& x) const {
    return nearest(x, 0, points_.size() - 2);
}

Vec3 Tube::centre(const AxisPlace& place) const {
    return between(points_, place);
}

double Tube::radius(const AxisPlace& place) const {
    return between(radii_, place);
}

double Tube::along(const AxisPlace& place) const {
    return between(along_, place);
}

Vec3 Tube::tangent(const AxisPlace& place) const {
    return between(tangents_, place).normalized();
}

Vec3 Tube::first(const AxisPlace& place) const {
    return perpendicular(between(firsts_, place), tangent(place));
}

double Tube::radius(double along) const {
    return radius(at(std::clamp(along, 0.0, length())));
}

TubeCoordinates Tube::coordinates(const Vec3& x) const {
    const AxisPlace p = nearest(x);
    const Vec3 u = first(p), v = tangent(p).cross(u), out = x - centre(p);
    return {.along = along(p),
            .angle = std::atan2(out.dot(v), out.dot(u)),
            .height = out.norm() - radius(p),
            .radius = radius(p)};
}

Vec3 Tube::position(double along, double angle, double height) const {
    const AxisPlace p = at(along);
    const Vec3 u = first(p), v = tangent(p).cross(u);
    return centre(p) + (radius(along) + height) * (std::cos(angle) * u + std::sin(angle) * v);
}

std::pair<AxisPlace, double> Tube::nearest_wall(const Vec3& x) const {
    std::pair<AxisPlace, double> best = {{}, std::numeric_limits<double>::infinity()};
    for (std::size_t i = 0; i + 1 < points_.size(); ++i) {
        const Vec3 edge = points_[i + 1] - points_[i];
        const double t = share_of(edge, x - points_[i]);
        const double height = (x - points_[i] - t * edge).norm() - radius(AxisPlace{i, t});
        if (height < best.second) best = {{i, t}, height};
    }
    return best;
}

Tube Tube::turned_to(const Vec3& x) const {
    const double angle = coordinates(x).angle;
    const Vec3 second = tangents_[0].cross(firsts_[0]);
    return {points_, radii_, Vec3(std::cos(angle) * firsts_[0] + std::sin(angle) * second)};
}

}  // namespace vesselbench
