// Faults of the triangles: what they enclose is not one body.

#include <algorithm>
#include <map>

#include "geometry/editing/triangle_soup.h"
#include "geometry/kernel/disjoint_sets.h"
#include "geometry/kernel/measure.h"
#include "geometry/kernel/piece_shape.h"
#include "geometry/kernel/self_intersections.h"
#include "geometry/kernel/wording.h"
#include "geometry/vessel/repair/stray_holes.h"
#include "workbench/findings/detectors.h"

namespace vesselbench {

namespace {

/// What is exact: the triangles show it, and no measure decides.
constexpr double kExact = 0.98;

/// At most this many findings of one kind: more are one problem, and nobody looks at each.
constexpr std::size_t kMostPlaces = 20;

/// A triangle's neighbours at its vertices belong to its place.
std::map<std::uint32_t, std::vector<TriangleId>> connected(const Surface& surface,
                                                           const std::vector<TrianglePair>& pairs) {
    DisjointSets sets(surface.vertex_count());
    const auto join = [&](TriangleId t) {
        for (const VertexId v : surface.triangles()[t]) sets.join(surface.triangles()[t][0], v);
    };
    for (const auto& [a, b] : pairs) {
        join(a);
        join(b);
        sets.join(surface.triangles()[a][0], surface.triangles()[b][0]);
    }
    std::map<std::uint32_t, std::vector<TriangleId>> places;
    for (const auto& [a, b] : pairs) {
        auto& place = places[sets.root(surface.triangles()[a][0])];
        place.insert(place.end(), {a, b});
    }
    return places;
}

Bounds bounds_of(const Surface& surface, const std::vector<TriangleId>& triangles) {
    Positions corners;
    for (const TriangleId t : triangles)
        for (const VertexId v : surface.triangles()[t]) corners.push_back(surface.points()[v]);
    return bounds(corners);
}

/// Components of the triangles over shared vertices.
struct Pieces {
    std::vector<std::uint32_t> of_triangle;
    std::size_t count = 0;
};

Pieces pieces_of(const Surface& surface) {
    DisjointSets sets(surface.vertex_count());
    for (const Triangle& triangle : surface.triangles()) {
        sets.join(triangle[0], triangle[1]);
        sets.join(triangle[0], triangle[2]);
    }
    Pieces pieces;
    std::map<std::uint32_t, std::uint32_t> numbers;
    for (const Triangle& triangle : surface.triangles())
        pieces.of_triangle.push_back(
            numbers.try_emplace(sets.root(triangle[0]), static_cast<std::uint32_t>(numbers.size()))
                .first->second);
    pieces.count = numbers.size();
    return pieces;
}

/// What is longer than it is wide, and no speck, may be the continuation of a vessel that the image
/// interrupts. \param area_share of the whole surface's [-]
std::vector<Reading> piece_readings(const PieceShape& shape, double area_share) {
    constexpr double kVessel = 2.0;   // length over diameter
    constexpr double kSpeck = 0.001;  // of the area
    const double ratio = shape.length / std::max(shape.diameter, 1e-9);
    if (ratio < kVessel || area_share < kSpeck) return {};
    return {{.key = "vessel",
             .name = "part of a vessel",
             .anatomy = true,
             .evidence = {{.code = "reading-long", .figures = {{"ratio", ratio}}}}},
            {.key = "debris", .name = "debris"}};
}

void sort_by_size(std::vector<Finding>& findings) {
    std::ranges::stable_sort(findings, std::greater{}, &Finding::size);
    if (findings.size() > kMostPlaces) findings.resize(kMostPlaces);
}

}  // namespace

std::vector<Finding> find_self_intersections(FindingSubject& subject, const Progress& progress) {
    const Surface& surface = subject.surface();
    std::vector<Finding> findings;
    for (const auto& [root, triangles] :
         connected(surface, self_intersections(surface, progress))) {
        const Bounds box = bounds_of(surface, triangles);
        const std::size_t pairs = triangles.size() / 2;
        findings.push_back({.kind = "self-intersection",
                            .place = box.centre(),
                            .size = 0.5 * box.diagonal(),
                            .certainty = kExact,
                            .evidence = {.code = "found-self-intersection",
                                         .figures = {{"pairs", static_cast<double>(pairs)},
                                                     {"size_mm", box.diagonal()}},
                                         .remedies = {{.operation = "repair"}}}});
    }
    sort_by_size(findings);
    return findings;
}

std::vector<Finding> find_detached_pieces(FindingSubject& subject, const Progress& progress) {
    const Surface& surface = subject.surface();
    const Pieces pieces = pieces_of(surface);
    if (pieces.count < 2) return {};
    progress.check_cancelled();
    std::vector<double> areas(pieces.count, 0.0), triangles(pieces.count, 0.0);
    for (TriangleId t = 0; t < surface.triangle_count(); ++t) {
        areas[pieces.of_triangle[t]] += triangle_area(surface.points(), surface.triangles()[t]);
        ++triangles[pieces.of_triangle[t]];
    }
    const auto largest = static_cast<std::size_t>(std::ranges::max_element(areas) - areas.begin());
    const double whole = area(surface);
    std::vector<Finding> findings;
    for (const PieceShape& shape :
         piece_shapes(surface.points(), surface.triangles(), pieces.of_triangle, pieces.count)) {
        if (shape.piece == largest) continue;
        findings.push_back(
            {.kind = "detached",
             .place = shape.centre,
             .size = 0.5 * std::max(shape.length, shape.diameter),
             .certainty = kExact,
             .evidence = {.code = "found-detached",
                          .figures = {{"triangles", triangles[shape.piece]},
                                      {"length_mm", shape.length},
                                      {"diameter_mm", shape.diameter},
                                      {"area_percent", 100.0 * areas[shape.piece] / whole}},
                          .remedies = {{.operation = "repair"}}},
             .readings = piece_readings(shape, areas[shape.piece] / whole)});
    }
    sort_by_size(findings);
    return findings;
}

std::vector<Finding> find_holes(FindingSubject& subject, const Progress& progress) {
    // Where the hole is half as wide as the lumen, a branch may have been cut off at the wall.
    constexpr double kEven = 0.75, kSure = 0.5;
    constexpr double kInWall = 0.7;  // OpenLoop::facing of a border that lies in the wall
    const Surface& surface = subject.surface();
    if (surface.topology->boundary_loops().empty()) return {};
    std::vector<Finding> findings;
    for (const OpenLoop& loop : open_loops(soup_from(surface))) {
        progress.check_cancelled();
        if (loop.facing < kInWall && (is_vessel_end(loop) || is_wide_as_lumen(loop))) continue;
        const double share = loop.lumen_radius > 0.0 ? loop.radius / loop.lumen_radius : 1.0;
        findings.push_back(
            {.kind = "hole",
             .place = loop.centre,
             .size = loop.radius,
             .certainty = certainty_of(share, kEven, kSure),
             .evidence = {
                 .code = "found-hole",
                 .figures = {{"width_mm", 2.0 * loop.radius},
                             {"edges", static_cast<double>(loop.vertices.size())},
                             {"lumen_mm", 2.0 * loop.lumen_radius}},
                 .remedies = {{.operation = "fill-hole",
                               .arguments = {{"near", coordinates_argument(loop.centre)}}}}}});
    }
    sort_by_size(findings);
    return findings;
}

}  // namespace vesselbench
