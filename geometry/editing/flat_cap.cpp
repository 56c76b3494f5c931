#include "geometry/editing/flat_cap.h"

#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <utility>

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_2_algorithms.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/errors.h"

namespace vesselbench {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<VertexId, Kernel>;
using FaceBase =
    CGAL::Triangulation_face_base_with_info_2<int, Kernel,
                                              CGAL::Constrained_triangulation_face_base_2<Kernel>>;
using Delaunay = CGAL::Constrained_Delaunay_triangulation_2<
    Kernel, CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>,
    CGAL::No_constraint_intersection_tag>;
using Point2 = Eigen::Vector2d;
using Points2 = std::vector<Point2>;

/// Lattice points stay this fraction of the edge length away from the rim.
constexpr double kRimDistance = 0.65;
constexpr int kRelaxations = 12;
constexpr std::size_t kMostInnerPoints = 200000;

bool inside(const Points2& rim, const Point2& x) {
    bool in = false;
    for (std::size_t i = 0, j = rim.size() - 1; i < rim.size(); j = i++) {
        const Point2 p = rim[i] - x, q = rim[j] - x;
        if ((p.y() > 0.0) != (q.y() > 0.0) &&
            p.x() + (q.x() - p.x()) * p.y() / (p.y() - q.y()) > 0.0)
            in = !in;
    }
    return in;
}

bool is_simple(const Points2& rim) {
    std::vector<Kernel::Point_2> corners;
    for (const Point2& p : rim) corners.emplace_back(p.x(), p.y());
    return CGAL::is_simple_2(corners.begin(), corners.end());
}

double rim_distance(const Points2& rim, const Point2& x) {
    double best = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < rim.size(); ++i) {
        const Point2& p = rim[i];
        const Point2 e = rim[(i + 1) % rim.size()] - p;
        const double t = std::clamp(e.dot(x - p) / e.squaredNorm(), 0.0, 1.0);
        best = std::min(best, (p + t * e - x).norm());
    }
    return best;
}

/// Points of a triangular lattice inside the rim, centred on the origin.
Points2 lattice(const Points2& rim, double edge) {
    Point2 low = rim.front(), high = rim.front();
    for (const Point2& p : rim) {
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
    }
    const double row_height = edge * std::numbers::sqrt3 / 2.0;
    const auto first = [](double from, double step) {
        return static_cast<long>(std::floor(from / step));
    };
    Points2 found;
    for (long row = first(low.y(), row_height); row * row_height <= high.y(); ++row)
        for (long i = first(low.x(), edge) - 1; i * edge <= high.x(); ++i) {
            const Point2 x((i + (row & 1 ? 0.5 : 0.0)) * edge, row * row_height);
            if (inside(rim, x) && rim_distance(rim, x) > kRimDistance * edge) found.push_back(x);
        }
    return found;
}

/// Marks the faces inside the polygon: inside and outside alternate across constrained edges.
void mark_inside(Delaunay& delaunay) {
    for (auto face : delaunay.all_face_handles()) face->info() = -1;
    std::vector<std::pair<Delaunay::Face_handle, int>> open{{delaunay.infinite_face(), 0}};
    while (!open.empty()) {
        const auto [face, depth] = open.back();
        open.pop_back();
        if (face->info() >= 0) continue;
        face->info() = depth;
        for (int k = 0; k < 3; ++k)
            if (face->neighbor(k)->info() < 0)
                open.emplace_back(face->neighbor(k), depth ^ (face->is_constrained(k) ? 1 : 0));
    }
}

std::vector<Triangle> triangulate(const Points2& rim, const Points2& inner) {
    Delaunay delaunay;
    std::vector<Delaunay::Vertex_handle> corners;
    const auto insert = [&](const Point2& p, std::size_t id) {
        const auto handle = delaunay.insert({p.x(), p.y()});
        handle->info() = static_cast<VertexId>(id);
        return handle;
    };
    for (std::size_t i = 0; i < rim.size(); ++i) corners.push_back(insert(rim[i], i));
    for (std::size_t i = 0; i < rim.size(); ++i)
        delaunay.insert_constraint(corners[i], corners[(i + 1) % rim.size()]);
    for (std::size_t i = 0; i < inner.size(); ++i) insert(inner[i], rim.size() + i);
    mark_inside(delaunay);
    std::vector<Triangle> triangles;
    for (auto face : delaunay.finite_face_handles())
        if (face->info() == 1)
            triangles.push_back(
                {face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()});
    return triangles;
}

/// Moves every inner point half of the way to the mean of its neighbours.
void relax(const Points2& rim, Points2& inner, const std::vector<Triangle>& triangles) {
    const auto at = [&](VertexId v) { return v < rim.size() ? rim[v] : inner[v - rim.size()]; };
    for (int round = 0; round < kRelaxations; ++round) {
        Points2 sum(inner.size(), Point2::Zero());
        std::vector<int> count(inner.size(), 0);
        for (const Triangle& t : triangles)
            for (int k = 0; k < 3; ++k) {
                if (t[k] < rim.size()) continue;
                sum[t[k] - rim.size()] += at(t[(k + 1) % 3]) + at(t[(k + 2) % 3]);
                count[t[k] - rim.size()] += 2;
            }
        for (std::size_t i = 0; i < inner.size(); ++i)
            if (count[i] > 0) inner[i] = 0.5 * (inner[i] + sum[i] / count[i]);
    }
}

}  // namespace

FlatCap fill_flat(const Positions& rim, const Plane& plane, double edge) {
    if (rim.size() < 3) throw AlgorithmFailure("an opening's rim has fewer than 3 corners");
    const auto [u, v] = plane_axes(plane.normal);
    Points2 flat;
    Point2 low = Point2::Constant(std::numeric_limits<double>::infinity()), high = -low;
    for (const Vec3& p : rim) {
        flat.emplace_back(u.dot(p - plane.point), v.dot(p - plane.point));
        low = low.cwiseMin(flat.back());
        high = high.cwiseMax(flat.back());
    }
    if (!is_simple(flat))
        throw DiagnosedFailure(
            {.code = "rim-crosses-itself", .remedies = {{.operation = "repair"}}});
    const Point2 extent = high - low;
    edge = std::max(edge, std::sqrt(extent.prod() / static_cast<double>(kMostInnerPoints)));
    Points2 inner = lattice(flat, edge);
    relax(flat, inner, triangulate(flat, inner));
    FlatCap cap{.inner = {}, .triangles = triangulate(flat, inner)};
    for (const Point2& p : inner) cap.inner.push_back(plane.point + p.x() * u + p.y() * v);
    return cap;
}

}  // namespace vesselbench
