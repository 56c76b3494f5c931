#include "geometry/kernel/surface_distance.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <tbb/parallel_for.h>

#include "geometry/kernel/distance_tree.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/surface_key.h"

namespace vesselbench {

namespace {

/// Relative slack of the box tests [-]: rounding must never lose a touched triangle.
constexpr double kBoxSlack = 1e-12;

/// Signed solid angle of a triangle seen from p [sr].
/// Source: van Oosterom and Strackee, "The solid angle of a plane triangle", 1983.
double solid_angle(const Vec3& p, const TriangleCorners& t) {
    const Vec3 a = t.a - p, b = t.b - p, c = t.c - p;
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    const double above = a.dot(b.cross(c));
    const double below = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
    return 2.0 * std::atan2(above, below);
}

/// Distance along the unit direction, or none. Source: Moeller and Trumbore, "Fast, minimum storage
/// ray/triangle intersection", 1997. Edges count, so a ray through an edge is not lost.
std::optional<double> ray_meets(const Vec3& origin, const Vec3& direction,
                                const TriangleCorners& t) {
    const Vec3 ab = t.b - t.a, ac = t.c - t.a;
    const Vec3 h = direction.cross(ac);
    const double determinant = ab.dot(h);
    if (determinant == 0.0) return std::nullopt;
    const Vec3 s = origin - t.a;
    const Vec3 q = s.cross(ab);
    const double u = s.dot(h) / determinant, v = direction.dot(q) / determinant;
    constexpr double kEdge = 1e-12;
    if (!(u >= -kEdge && v >= -kEdge && u + v <= 1.0 + kEdge)) return std::nullopt;
    const double along = ac.dot(q) / determinant;
    return along >= 0.0 ? std::optional(along) : std::nullopt;
}

bool ray_meets_box(const Vec3& origin, const Vec3& inverse, double reach, const BoxTree::Box& box) {
    double from = 0.0, to = reach;
    for (int k = 0; k < 3; ++k) {
        double t0 = (box.min()[k] - origin[k]) * inverse[k];
        double t1 = (box.max()[k] - origin[k]) * inverse[k];
        if (std::isnan(t0) || std::isnan(t1)) continue;  // in the slab's plane, parallel to it
        if (t0 > t1) std::swap(t0, t1);
        from = std::max(from, t0 - kBoxSlack * std::abs(t0));
        to = std::min(to, t1 + kBoxSlack * std::abs(t1));
    }
    return from <= to;
}

}  // namespace

Vec3 closest_point_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 ab = b - a, ac = c - a, ap = p - a;
    const double d1 = ab.dot(ap), d2 = ac.dot(ap);
    if (d1 <= 0.0 && d2 <= 0.0) return a;
    const Vec3 bp = p - b;
    const double d3 = ab.dot(bp), d4 = ac.dot(bp);
    if (d3 >= 0.0 && d4 <= d3) return b;
    const double vc = d1 * d4 - d3 * d2;
    if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 && d1 > d3) return a + d1 / (d1 - d3) * ab;
    const Vec3 cp = p - c;
    const double d5 = ab.dot(cp), d6 = ac.dot(cp);
    if (d6 >= 0.0 && d5 <= d6) return c;
    const double vb = d5 * d2 - d1 * d6;
    if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 && d2 > d6) return a + d2 / (d2 - d6) * ac;
    const double va = d3 * d6 - d5 * d4;
    const double along_bc = (d4 - d3) + (d5 - d6);
    if (va <= 0.0 && d4 >= d3 && d5 >= d6 && along_bc > 0.0)
        return b + (d4 - d3) / along_bc * (c - b);
    const double sum = va + vb + vc;
    if (sum <= 0.0) return a;  // a triangle degenerate to a point
    return a + vb / sum * ab + vc / sum * ac;
}

struct SurfaceDistance::Data : DistanceTree {
    using DistanceTree::DistanceTree;

    std::optional<SurfacePoint> closest(const Vec3& p, double reach) const;
    double winding(const Vec3& p) const;
};

std::optional<SurfacePoint> SurfaceDistance::Data::closest(const Vec3& p, double reach) const {
    const auto nodes = tree.nodes();
    SurfacePoint best;
    double best_squared = reach * reach;
    bool found = false;

    struct Waiting {
        std::uint32_t node;
        double squared;
    };

    Waiting stack[64];
    int depth = 0;
    stack[depth++] = {0, nodes[0].box.squaredExteriorDistance(p)};
    while (depth > 0) {
        const Waiting next = stack[--depth];
        if (next.squared > best_squared * (1.0 + kBoxSlack)) continue;
        const BoxTree::Node& node = nodes[next.node];
        if (node.right == 0) {
            for (std::uint32_t i = node.begin; i < node.end; ++i) {
                const Vec3 q =
                    closest_point_on_triangle(p, corners[i].a, corners[i].b, corners[i].c);
                const double squared = (q - p).squaredNorm();
                const TriangleId t = tree.items()[i];
                if (squared > best_squared ||
                    (found && squared == best_squared && t > best.triangle))
                    continue;
                best = {q, t, 0.0};
                best_squared = squared;
                found = true;
            }
            continue;
        }
        Waiting near{next.node + 1, nodes[next.node + 1].box.squaredExteriorDistance(p)};
        Waiting far{node.right, nodes[node.right].box.squaredExteriorDistance(p)};
        if (far.squared < near.squared) std::swap(near, far);
        stack[depth++] = far;
        stack[depth++] = near;
    }
    if (!found) return std::nullopt;
    best.distance = std::sqrt(best_squared);
    return best;
}

double SurfaceDistance::Data::winding(const Vec3& p) const {
    const auto nodes = tree.nodes();
    double angle = 0.0;
    std::uint32_t stack[64];
    int depth = 0;
    stack[depth++] = 0;
    while (depth > 0) {
        const std::uint32_t at = stack[--depth];
        const Dipole& dipole = dipoles[at];
        const Vec3 away = dipole.centre - p;
        const double distance = away.norm();
        const BoxTree::Node& node = nodes[at];
        if (distance > kFarFactor * dipole.radius) {
            angle += dipole.area_normal.dot(away) / (distance * distance * distance);
        } else if (node.right == 0) {
            for (std::uint32_t i = node.begin; i < node.end; ++i)
                angle += solid_angle(p, corners[i]);
        } else {
            stack[depth++] = node.right;
            stack[depth++] = at + 1;
        }
    }
    return angle / (4.0 * std::numbers::pi);
}

SurfaceDistance::SurfaceDistance(const Surface& surface)
    : SurfaceDistance(surface.empty() ? Positions{} : surface.points(),
                      surface.empty() ? std::span<const Triangle>{} : surface.triangles()) {}

SurfaceDistance::SurfaceDistance(const Positions& positions, std::span<const Triangle> triangles) {
    if (triangles.empty())
        throw InvalidInput("distances need a surface with at least one triangle");
    data_ = std::make_shared<const Data>(positions, triangles);
}

SurfacePoint SurfaceDistance::closest_point(const Vec3& p) const {
    const auto found = data_->closest(p, std::numeric_limits<double>::infinity());
    if (!found) throw InvalidInput("the distance of a point with a NaN coordinate is undefined");
    return *found;
}

std::optional<SurfacePoint> SurfaceDistance::closest_point(const Vec3& p, double reach) const {
    return data_->closest(p, reach);
}

std::vector<SurfaceHit> SurfaceDistance::all_hits(const Vec3& origin, const Vec3& direction,
                                                  double reach) const {
    const Vec3 unit = direction.normalized();
    const Vec3 inverse = unit.cwiseInverse();
    std::vector<SurfaceHit> hits;
    data_->tree.traverse_places(
        [&](const auto& box) { return ray_meets_box(origin, inverse, reach, box); },
        [&](std::uint32_t i) {
            const TriangleCorners& t = data_->corners[i];
            const auto along = ray_meets(origin, unit, t);
            if (!along || *along > reach) return;
            const bool inner = (t.b - t.a).cross(t.c - t.a).dot(unit) > 0.0;
            hits.push_back({origin + *along * unit, data_->tree.items()[i], *along, inner});
        });
    std::sort(hits.begin(), hits.end(), [](const SurfaceHit& a, const SurfaceHit& b) {
        return a.distance < b.distance || (a.distance == b.distance && a.triangle < b.triangle);
    });
    return hits;
}

std::optional<SurfaceHit> SurfaceDistance::first_hit(const Vec3& origin, const Vec3& direction,
                                                     double reach) const {
    const Vec3 unit = direction.normalized();
    const Vec3 inverse = unit.cwiseInverse();
    const auto nodes = data_->tree.nodes();
    std::optional<SurfaceHit> best;
    double limit = reach;
    std::uint32_t stack[64];
    int depth = 0;
    stack[depth++] = 0;
    while (depth > 0) {
        const std::uint32_t at = stack[--depth];
        const BoxTree::Node& node = nodes[at];
        if (!ray_meets_box(origin, inverse, limit, node.box)) continue;
        if (node.right != 0) {
            // The child whose centre comes first along the ray is visited first.
            const double left = (nodes[at + 1].box.center() - origin).dot(unit);
            const double right = (nodes[node.right].box.center() - origin).dot(unit);
            stack[depth++] = left <= right ? node.right : at + 1;
            stack[depth++] = left <= right ? at + 1 : node.right;
            continue;
        }
        for (std::uint32_t i = node.begin; i < node.end; ++i) {
            const TriangleCorners& t = data_->corners[i];
            const auto along = ray_meets(origin, unit, t);
            const TriangleId id = data_->tree.items()[i];
            if (!along || *along > limit) continue;
            if (best && *along == best->distance && id > best->triangle) continue;
            const bool inner = (t.b - t.a).cross(t.c - t.a).dot(unit) > 0.0;
            best = SurfaceHit{origin + *along * unit, id, *along, inner};
            limit = *along;
        }
    }
    return best;
}

double SurfaceDistance::winding_number(const Vec3& p) const {
    return data_->winding(p);
}

double SurfaceDistance::signed_distance(const Vec3& p) const {
    const double distance = closest_point(p).distance;
    return inside(p) ? -distance : distance;
}

std::vector<TriangleId> SurfaceDistance::triangles_within(const Vec3& centre, double radius) const {
    std::vector<TriangleId> found;
    const double squared = radius * radius;
    data_->tree.traverse_places(
        [&](const auto& box) { return !(box.squaredExteriorDistance(centre) > squared); },
        [&](std::uint32_t i) {
            const TriangleCorners& t = data_->corners[i];
            const Vec3 q = closest_point_on_triangle(centre, t.a, t.b, t.c);
            if ((q - centre).squaredNorm() <= squared) found.push_back(data_->tree.items()[i]);
        });
    std::sort(found.begin(), found.end());
    return found;
}

std::vector<SurfacePoint> SurfaceDistance::closest_points(std::span<const Vec3> points) const {
    std::vector<SurfacePoint> found(points.size());
    tbb::parallel_for(std::size_t{0}, points.size(),
                      [&](std::size_t i) { found[i] = closest_point(points[i]); });
    return found;
}

std::vector<double> SurfaceDistance::signed_distances(std::span<const Vec3> points) const {
    std::vector<double> found(points.size());
    tbb::parallel_for(std::size_t{0}, points.size(),
                      [&](std::size_t i) { found[i] = signed_distance(points[i]); });
    return found;
}

const DistanceTree& SurfaceDistance::tree() const {
    return *data_;
}

std::size_t SurfaceDistance::bytes() const {
    return std::as_bytes(data_->tree.nodes()).size() + std::as_bytes(data_->tree.items()).size() +
           std::as_bytes(std::span(data_->corners)).size() +
           std::as_bytes(std::span(data_->dipoles)).size();
}

namespace {

template <class Make>
SurfaceDistance known_distance(const ContentKey& key, const Make& make, DerivedCache& cache) {
    return *cache.find_or_make<SurfaceDistance>(
        "distance", key, make, [](const SurfaceDistance& made) { return made.bytes(); });
}

}  // namespace

SurfaceDistance distance_to(const Surface& surface, DerivedCache& cache) {
    return known_distance(
        shape_key(surface, cache), [&] { return SurfaceDistance(surface); }, cache);
}

SurfaceDistance distance_to(const Positions& positions, std::span<const Triangle> triangles,
                            DerivedCache& cache) {
    return known_distance(
        shape_key(positions, triangles), [&] { return SurfaceDistance(positions, triangles); },
        cache);
}

}  // namespace vesselbench
