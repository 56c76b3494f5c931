#include "geometry/editing/local_part.h"

#include <algorithm>
#include <array>
#include <utility>

#include "geometry/editing/triangle_soup.h"
#include "geometry/kernel/disjoint_sets.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/surface_distance.h"

namespace vesselbench {

namespace {

/// Whether the marked triangles at a vertex are connected across edges at it.
bool is_one_fan(std::span<const Triangle> triangles, const std::vector<TriangleId>& marked,
                VertexId v) {
    DisjointSets fans(marked.size());
    const auto shares_spoke = [&](const Triangle& s, const Triangle& t) {
        return std::ranges::any_of(
            s, [&](VertexId u) { return u != v && std::ranges::find(t, u) != t.end(); });
    };
    for (std::uint32_t i = 0; i < marked.size(); ++i)
        for (std::uint32_t k = 0; k < i; ++k)
            if (shares_spoke(triangles[marked[i]], triangles[marked[k]])) fans.join(i, k);
    for (std::uint32_t i = 1; i < marked.size(); ++i)
        if (fans.root(i) != fans.root(0)) return false;
    return true;
}

/// Weights of a triangle's corners at a point of it, from the areas across [-].
std::array<double, 3> corner_weights(const Positions& points, const Triangle& t, const Vec3& at) {
    std::array<double, 3> weights{};
    double sum = 0.0;
    for (int k = 0; k < 3; ++k) {
        const Vec3 &a = points[t[(k + 1) % 3]], &b = points[t[(k + 2) % 3]];
        weights[k] = (a - at).cross(b - at).norm();
        sum += weights[k];
    }
    for (double& weight : weights) weight = sum > 0.0 ? weight / sum : 1.0 / 3.0;
    return weights;
}

/// Adds the edited part's new vertices. \return the soup's number of each vertex of the edited part
std::vector<VertexId> add_vertices(TriangleSoup& soup, const LocalPart& part,
                                   const EditedPart& edited) {
    const SurfaceDistance before(part.surface);
    std::vector<VertexId> number;
    number.reserve(edited.former.size());
    for (VertexId v = 0; v < edited.former.size(); ++v) {
        if (edited.former[v] != kNewVertex) {
            number.push_back(part.vertices[edited.former[v]]);
            continue;
        }
        const Vec3& p = edited.surface.points()[v];
        std::array<VertexId, 3> corners{};
        std::array<double, 3> weights{};
        if (!soup.attributes.empty()) {
            const SurfacePoint at = before.closest_point(p);
            const Triangle& t = part.surface.triangles()[at.triangle];
            weights = corner_weights(part.surface.points(), t, at.point);
            for (int k = 0; k < 3; ++k) corners[k] = part.vertices[t[k]];
        }
        number.push_back(soup.add_vertex(p, corners, weights));
    }
    return number;
}

}  // namespace

LocalPart part_of(const Surface& whole, std::span<const std::uint8_t> marked) {
    LocalPart part;
    std::vector<VertexId> number(whole.vertex_count(), kNewVertex);
    std::vector<std::uint8_t> at_rest(whole.vertex_count(), 0);
    Positions points;
    std::vector<Triangle> triangles;
    PatchLabels labels;
    for (TriangleId t = 0; t < marked.size(); ++t) {
        if (!marked[t]) {
            for (const VertexId v : whole.triangles()[t]) at_rest[v] = 1;
            continue;
        }
        Triangle corners = whole.triangles()[t];
        for (VertexId& v : corners) {
            if (number[v] == kNewVertex) {
                number[v] = static_cast<VertexId>(points.size());
                part.vertices.push_back(v);
                points.push_back(whole.points()[v]);
            }
            v = number[v];
        }
        triangles.push_back(corners);
        labels.push_back((*whole.patch_labels)[t]);
    }
    part.surface =
        make_surface(std::move(points), std::move(triangles), std::move(labels), whole.patches);
    part.rim = part.surface.topology->boundary_vertices();
    for (VertexId v = 0; v < part.rim.size(); ++v)
        if (at_rest[part.vertices[v]]) part.rim[v] = 1;
    return part;
}

void close_fans(const Surface& whole, std::vector<std::uint8_t>& marked) {
    const CompressedRows& fans = whole.topology->triangles_at();
    std::vector<VertexId> open;
    for (TriangleId t = 0; t < marked.size(); ++t)
        if (marked[t])
            for (const VertexId v : whole.triangles()[t]) open.push_back(v);
    while (!open.empty()) {
        std::ranges::sort(open);
        open.erase(std::unique(open.begin(), open.end()), open.end());
        std::vector<VertexId> next;
        for (const VertexId v : open) {
            std::vector<TriangleId> inside;
            for (const TriangleId t : fans.row(v))
                if (marked[t]) inside.push_back(t);
            if (is_one_fan(whole.triangles(), inside, v)) continue;
            for (const TriangleId t : fans.row(v)) {
                if (marked[t]) continue;
                marked[t] = 1;
                for (const VertexId u : whole.triangles()[t]) next.push_back(u);
            }
        }
        open = std::move(next);
    }
}

Surface sewn(const Surface& whole, std::span<const std::uint8_t> marked, const LocalPart& part,
             const EditedPart& edited) {
    TriangleSoup soup = soup_from(whole);
    soup.remove_triangles({marked.begin(), marked.end()});
    std::vector<std::uint8_t> kept(part.vertices.size(), 0);
    for (const VertexId v : edited.former)
        if (v != kNewVertex) kept[v] = 1;
    for (VertexId v = 0; v < kept.size(); ++v)
        if (part.rim[v] && !kept[v])
            throw InvalidInput("the edited part of the surface has lost a vertex of its rim");
    const std::vector<VertexId> number = add_vertices(soup, part, edited);
    for (TriangleId t = 0; t < edited.surface.triangle_count(); ++t) {
        const auto& [a, b, c] = edited.surface.triangles()[t];
        soup.add_triangle({number[a], number[b], number[c]}, (*edited.surface.patch_labels)[t]);
    }
    soup.remove_unused_vertices();
    soup.remove_unused_patches();
    return surface_from(std::move(soup));
}

}  // namespace vesselbench
