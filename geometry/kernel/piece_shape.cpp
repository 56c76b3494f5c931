#include "geometry/kernel/piece_shape.h"

#include <algorithm>
#include <numbers>

#include "geometry/kernel/measure.h"

namespace vesselbench {

namespace {

/// A shorter piece is a crumb [lengths of the longest piece kept].
constexpr double kCrumb = 0.05;

/// By piece, the vertex farthest from a point.
Positions farthest(const Positions& points, std::span<const Triangle> triangles,
                   std::span<const std::uint32_t> piece_of_triangle, const Positions& from) {
    Positions best = from;
    std::vector<double> most(from.size(), -1.0);
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        const std::uint32_t piece = piece_of_triangle[t];
        for (const VertexId v : triangles[t])
            if (const double d = (points[v] - from[piece]).squaredNorm(); d > most[piece]) {
                most[piece] = d;
                best[piece] = points[v];
            }
    }
    return best;
}

}  // namespace

std::vector<PieceShape> piece_shapes(const Positions& points, std::span<const Triangle> triangles,
                                     std::span<const std::uint32_t> piece_of_triangle,
                                     std::size_t pieces) {
    std::vector<double> areas(pieces, 0.0);
    Positions centres(pieces, Vec3::Zero());
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        const auto& [a, b, c] = triangles[t];
        const double area = 0.5 * area_normal(points, triangles[t]).norm();
        areas[piece_of_triangle[t]] += area;
        centres[piece_of_triangle[t]] += area / 3.0 * (points[a] + points[b] + points[c]);
    }
    for (std::size_t p = 0; p < pieces; ++p)
        if (areas[p] > 0.0) centres[p] /= areas[p];
    const Positions ends = farthest(points, triangles, piece_of_triangle, centres);
    const Positions others = farthest(points, triangles, piece_of_triangle, ends);
    std::vector<PieceShape> shapes(pieces);
    for (std::size_t p = 0; p < pieces; ++p) {
        const double length = (others[p] - ends[p]).norm();
        shapes[p] = {.piece = p,
                     .centre = centres[p],
                     .length = length,
                     .diameter = length > 0.0 ? areas[p] / (std::numbers::pi * length) : 0.0};
    }
    return shapes;
}

std::optional<PieceShape> longest_dropped_vessel(const std::vector<PieceShape>& shapes,
                                                 const std::vector<bool>& kept) {
    double longest_kept = 0.0;
    for (const PieceShape& shape : shapes)
        if (kept[shape.piece]) longest_kept = std::max(longest_kept, shape.length);
    std::optional<PieceShape> longest;
    for (const PieceShape& shape : shapes)
        if (!kept[shape.piece] && shape.is_vessel() && shape.length > kCrumb * longest_kept &&
            (!longest || shape.length > longest->length))
            longest = shape;
    return longest;
}

}  // namespace vesselbench
