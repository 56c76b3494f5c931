#include "geometry/vessel/openings/hole_filling.h"

#include <algorithm>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/fair.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>
#include <CGAL/Surface_mesh.h>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/wording.h"
#include "geometry/vessel/openings/flat_cap.h"
#include "geometry/vessel/openings/surface_parts.h"

namespace vesselbench {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
namespace PMP = CGAL::Polygon_mesh_processing;

/// Fairing looks at two rings around the hole; the others are for safety.
constexpr int kRings = 5;

/// The surface around a loop as a mesh of CGAL's.
struct Surroundings {
    Mesh mesh;
    std::map<VertexId, Mesh::Vertex_index> local;
    std::vector<VertexId> global;  ///< of each local vertex
    bool complete = true;          ///< every triangle could be added: the place is manifold
};

std::vector<TriangleId> triangles_around(const Surface& surface, std::span<const VertexId> loop) {
    const auto& at = surface.topology->triangles_at();
    std::vector<std::uint8_t> seen(surface.triangle_count(), 0);
    std::vector<VertexId> front(loop.begin(), loop.end());
    std::vector<TriangleId> found;
    for (int ring = 0; ring < kRings; ++ring) {
        std::vector<VertexId> next;
        for (const VertexId v : front)
            for (const TriangleId t : at.row(v))
                if (std::exchange(seen[t], 1) == 0) {
                    found.push_back(t);
                    next.insert(next.end(), surface.triangles()[t].begin(),
                                surface.triangles()[t].end());
                }
        front = std::move(next);
    }
    std::sort(found.begin(), found.end());
    return found;
}

Surroundings surroundings(const Surface& surface, std::span<const VertexId> loop,
                          const HoleChart* chart) {
    Surroundings result;
    for (const TriangleId t : triangles_around(surface, loop)) {
        std::array<Mesh::Vertex_index, 3> corners;
        for (int k = 0; k < 3; ++k) {
            const VertexId v = surface.triangles()[t][k];
            const auto [it, fresh] = result.local.try_emplace(v);
            if (fresh) {
                const Vec3& x = surface.points()[v];
                const Vec3 p = chart != nullptr ? chart->to_chart(x) : x;
                it->second = result.mesh.add_vertex({p.x(), p.y(), p.z()});
                result.global.push_back(v);
            }
            corners[k] = it->second;
        }
        if (result.mesh.add_face(corners[0], corners[1], corners[2]) == Mesh::null_face())
            result.complete = false;
    }
    return result;
}

std::uint16_t label_at(const Surface& surface, VertexId a, VertexId b) {
    for (const TriangleId t : surface.topology->triangles_at().row(a)) {
        const Triangle& c = surface.triangles()[t];
        if (std::find(c.begin(), c.end(), b) != c.end()) return (*surface.patch_labels)[t];
    }
    return 0;
}

VertexId nearest(const Surface& surface, std::span<const VertexId> loop, const Vec3& x) {
    return *std::min_element(loop.begin(), loop.end(), [&](VertexId a, VertexId b) {
        return (surface.points()[a] - x).squaredNorm() < (surface.points()[b] - x).squaredNorm();
    });
}

[[noreturn]] void fail(const Surface& surface, std::span<const VertexId> loop,
                       const std::string& why) {
    throw AlgorithmFailure("the hole at " + place_text(loop_centre(surface, loop)) + " " + why);
}

/// What was added to the surroundings.
struct NewWall {
    std::vector<Mesh::Face_index> faces;
    std::vector<Mesh::Vertex_index> vertices;
};

std::optional<NewWall> fill_in_space(Surroundings& around, Mesh::Halfedge_index border,
                                     int continuity) {
    NewWall patch;
    PMP::triangulate_refine_and_fair_hole(
        around.mesh, border, std::back_inserter(patch.faces), std::back_inserter(patch.vertices),
        PMP::parameters::fairing_continuity(static_cast<unsigned>(continuity)));
    if (patch.faces.empty()) return std::nullopt;
    std::sort(patch.faces.begin(), patch.faces.end());
    std::sort(patch.vertices.begin(), patch.vertices.end());
    return patch;
}

/// In a chart the hole is seen from outside: a flat triangulation, then faired out of the plane.
std::optional<NewWall> fill_in_chart(Surroundings& around, std::span<const VertexId> loop,
                                     int continuity) {
    const Plane plane{Vec3::Zero(), Vec3::UnitX()};
    Positions rim;
    std::vector<Mesh::Vertex_index> corners;
    for (auto v = loop.rbegin(); v != loop.rend(); ++v) {
        corners.push_back(around.local.at(*v));
        const auto& p = around.mesh.point(corners.back());
        rim.emplace_back(0.0, p.y(), p.z());
    }
    double length = 0.0;
    for (std::size_t i = 0; i < rim.size(); ++i)
        length += (rim[(i + 1) % rim.size()] - rim[i]).norm();
    const FlatCap flat = fill_flat(rim, plane, length / static_cast<double>(rim.size()));
    NewWall patch;
    for (const Vec3& p : flat.inner) {
        corners.push_back(around.mesh.add_vertex({p.x(), p.y(), p.z()}));
        patch.vertices.push_back(corners.back());
    }
    for (const auto& [a, b, c] : flat.triangles) {
        const auto face = around.mesh.add_face(corners[a], corners[b], corners[c]);
        if (face == Mesh::null_face()) return std::nullopt;
        patch.faces.push_back(face);
    }
    if (!patch.vertices.empty() &&
        !PMP::fair(around.mesh, patch.vertices,
                   PMP::parameters::fairing_continuity(static_cast<unsigned>(continuity))))
        return std::nullopt;
    return patch;
}

FilledHole joined(const Surface& surface, std::span<const VertexId> loop,
                  const Surroundings& around, const NewWall& patch, const HoleChart* chart) {
    SurfaceParts parts = take_apart(surface);
    std::map<Mesh::Vertex_index, VertexId> added;
    for (const auto v : patch.vertices) {
        const auto& p = around.mesh.point(v);
        const Vec3 found(p.x(), p.y(), p.z());
        const Vec3 x = chart != nullptr ? chart->from_chart(found) : found;
        const VertexId source[] = {nearest(surface, loop, x)};
        const double weight[] = {1.0};
        added[v] = parts.add_vertex(x, source, weight);
    }
    const std::uint16_t label = label_at(surface, loop[0], loop[1]);
    for (const auto f : patch.faces) {
        Triangle corners{};
        int k = 0;
        for (const auto v : around.mesh.vertices_around_face(around.mesh.halfedge(f)))
            corners[k++] = added.contains(v) ? added[v] : around.global[v];
        parts.add_triangle(corners, label);
    }
    FilledHole filled{.first_new_triangle = surface.triangle_count()};
    filled.surface = put_together(parts);
    filled.first_new_vertex = filled.surface.vertex_count() - patch.vertices.size();
    return filled;
}

}  // namespace

FilledHole fill_hole(const Surface& surface, std::span<const VertexId> loop, int continuity,
                     const HoleChart* chart) {
    if (loop.size() < 3) throw InvalidInput("a border loop has at least 3 vertices");
    Surroundings around = surroundings(surface, loop, chart);
    const auto inner = around.mesh.halfedge(around.local.at(loop[0]), around.local.at(loop[1]));
    if (!around.complete || inner == Mesh::null_halfedge() ||
        !around.mesh.is_border(around.mesh.opposite(inner)))
        fail(surface, loop, "cannot be closed: the surface is not manifold there; repair it");
    const auto patch = chart != nullptr
                           ? fill_in_chart(around, loop, continuity)
                           : fill_in_space(around, around.mesh.opposite(inner), continuity);
    if (!patch) fail(surface, loop, "cannot be closed without crossing itself");
    return joined(surface, loop, around, *patch, chart);
}

Vec3 loop_centre(const Surface& surface, std::span<const VertexId> loop) {
    Vec3 sum = Vec3::Zero();
    double length = 0.0;
    for (std::size_t i = 0; i < loop.size(); ++i) {
        const Vec3& p = surface.points()[loop[i]];
        const Vec3& q = surface.points()[loop[(i + 1) % loop.size()]];
        sum += 0.5 * (p + q) * (q - p).norm();
        length += (q - p).norm();
    }
    return length > 0.0 ? Vec3(sum / length) : surface.points()[loop[0]];
}

}  // namespace vesselbench
