#include "geometry/vessel/openings/crop_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <utility>
#include <vector>

#include "geometry/editing/triangle_soup.h"
#include "geometry/kernel/edges.h"
#include "geometry/kernel/errors.h"

namespace vesselbench {

namespace {

/// One boundary of the region: the distance of a point outside (negative inside) [mm], and the
/// crossing with an edge from inside to outside, in (0, 1).
struct Limit {
    std::function<double(const Vec3&)> outside;
    std::function<double(const Vec3& from, const Vec3& to)> crossing;
};

/// Within this distance of the boundary [mm], a vertex counts as on it: no sliver is cut off.
constexpr double kOn = 1e-9;

Limit plane_limit(Eigen::Index axis, double sign, double at) {
    const auto outside = [=](const Vec3& p) { return sign * (p[axis] - at); };
    return {outside, [outside](const Vec3& from, const Vec3& to) {
                const double a = outside(from), b = outside(to);
                return a / (a - b);
            }};
}

Limit sphere_limit(const Vec3& centre, double radius) {
    const auto crossing = [=](const Vec3& from, const Vec3& to) {
        // |from + t d - centre| = radius, the root on the way out
        const Vec3 f = from - centre, d = to - from;
        const double a = d.squaredNorm(), b = f.dot(d), c = f.squaredNorm() - radius * radius;
        return std::clamp((-b + std::sqrt(std::max(0.0, b * b - a * c))) / a, 0.0, 1.0);
    };
    return {[=](const Vec3& p) { return (p - centre).norm() - radius; }, crossing};
}

/// Cuts all triangles at one boundary and keeps the part inside.
class Cutter {
public:
    Cutter(TriangleSoup& soup, const Limit& limit) : soup_(soup), limit_(limit) {
        for (const Vec3& p : soup.points) outside_.push_back(limit.outside(p));
    }

    void cut() {
        const auto triangles = std::move(soup_.triangles);
        const auto labels = std::move(soup_.labels);
        soup_.triangles.clear();
        soup_.labels.clear();
        for (std::size_t t = 0; t < triangles.size(); ++t) cut_triangle(triangles[t], labels[t]);
    }

private:
    [[nodiscard]] bool is_inside(VertexId v) const { return outside_[v] < -kOn; }

    [[nodiscard]] bool is_outside(VertexId v) const { return outside_[v] > kOn; }

    /// Walks around the triangle, keeps inner corners and adds the crossings.
    void cut_triangle(const Triangle& triangle, std::uint16_t label) {
        const auto some_inside =
            std::any_of(triangle.begin(), triangle.end(), [&](auto v) { return is_inside(v); });
        if (!some_inside) return;
        std::vector<VertexId> polygon;
        for (std::size_t c = 0; c < 3; ++c) {
            const VertexId a = triangle[c], b = triangle[(c + 1) % 3];
            if (!is_outside(a)) polygon.push_back(a);
            if ((is_inside(a) && is_outside(b)) || (is_outside(a) && is_inside(b)))
                polygon.push_back(crossing(a, b));
        }
        for (std::size_t c = 2; c < polygon.size(); ++c)
            soup_.add_triangle({polygon[0], polygon[c - 1], polygon[c]}, label);
    }

    VertexId crossing(VertexId a, VertexId b) {
        const auto known = crossings_.find(std::minmax(a, b));
        if (known != crossings_.end()) return known->second;
        const VertexId from = is_inside(a) ? a : b, to = is_inside(a) ? b : a;
        const double t = limit_.crossing(soup_.points[from], soup_.points[to]);
        const Vec3 p = soup_.points[from] + t * (soup_.points[to] - soup_.points[from]);
        const std::array<VertexId, 2> sources = {from, to};
        const std::array<double, 2> weights = {1.0 - t, t};
        const VertexId made = soup_.add_vertex(p, sources, weights);
        crossings_[std::minmax(a, b)] = made;
        return made;
    }

    TriangleSoup& soup_;
    const Limit& limit_;
    std::vector<double> outside_;
    std::map<std::pair<VertexId, VertexId>, VertexId> crossings_;
};

/// Without vertices and patches that have no triangle.
Surface without_unused(TriangleSoup soup) {
    soup.remove_unused_vertices();
    soup.remove_unused_patches();
    return surface_from(std::move(soup));
}

Surface cropped(const Surface& surface, const std::vector<Limit>& limits) {
    TriangleSoup soup = soup_from(surface);
    for (const Limit& limit : limits) Cutter(soup, limit).cut();
    if (soup.triangles.empty())
        throw AlgorithmFailure(
            "the crop region contains nothing of the surface; give it in mm in patient coordinates "
            "(LPS)");
    return without_unused(std::move(soup));
}

}  // namespace

Surface crop_to_box(const Surface& surface, const Vec3& low, const Vec3& high) {
    if (!((high - low).minCoeff() > 0.0))
        throw InvalidInput("the crop box is empty: its upper corner must be above its lower one");
    std::vector<Limit> limits;
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
        limits.push_back(plane_limit(axis, -1.0, low[axis]));
        limits.push_back(plane_limit(axis, 1.0, high[axis]));
    }
    return cropped(surface, limits);
}

Surface crop_to_sphere(const Surface& surface, const Vec3& centre, double radius) {
    if (!(radius > 0.0)) throw InvalidInput("the crop radius must be above 0 mm");
    return cropped(surface, {sphere_limit(centre, radius)});
}

LargestPiece largest_piece(const Surface& surface) {
    const Components components = connected_components(*surface.topology);
    std::vector<double> area(components.count(), 0.0);
    for (TriangleId t = 0; t < surface.triangle_count(); ++t)
        area[components.of_triangle[t]] +=
            area_normal(surface.points(), surface.triangles()[t]).norm();
    const auto largest = std::distance(area.begin(), std::max_element(area.begin(), area.end()));
    std::vector<std::uint8_t> removed;
    removed.reserve(surface.triangle_count());
    for (const std::uint32_t c : components.of_triangle) removed.push_back(c == largest ? 0 : 1);
    TriangleSoup soup = soup_from(surface);
    soup.remove_triangles(removed);
    return {without_unused(std::move(soup)), components.count()};
}

}  // namespace vesselbench
