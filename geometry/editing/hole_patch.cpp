#include "geometry/editing/hole_patch.h"

#include <algorithm>
#include <map>
#include <optional>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/fair.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>
#include <CGAL/Surface_mesh.h>

#include "geometry/editing/flat_cap.h"

namespace vesselbench {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
namespace PMP = CGAL::Polygon_mesh_processing;

Kernel::Point_3 to_cgal(const Vec3& p) {
    return {p.x(), p.y(), p.z()};
}

Vec3 from_cgal(const Kernel::Point_3& p) {
    return {p.x(), p.y(), p.z()};
}

/// The surroundings of a hole as a CGAL mesh, instead of the whole surface: CGAL's functions
/// process the whole mesh they are given.
struct LocalMesh {
    Mesh mesh;
    std::map<VertexId, Mesh::Vertex_index> local;
    std::vector<VertexId> number;  ///< of each vertex
    std::vector<Mesh::Vertex_index> new_vertices;
    std::vector<Mesh::Face_index> new_faces;

    Mesh::Vertex_index add(const Hole& hole, VertexId v) {
        const auto [at, fresh] = local.try_emplace(v);
        if (fresh) {
            at->second = mesh.add_vertex(to_cgal(hole.point(v)));
            number.push_back(v);
        }
        return at->second;
    }
};

/// None if the triangles do not form a manifold.
std::optional<LocalMesh> local_mesh(const Hole& hole) {
    LocalMesh local;
    for (const Triangle& t : hole.around) {
        const auto a = local.add(hole, t[0]), b = local.add(hole, t[1]), c = local.add(hole, t[2]);
        if (local.mesh.add_face(a, b, c) == Mesh::null_face()) return std::nullopt;
    }
    return local;
}

/// The border half-edge of the loop's first edge; it runs against the triangles' half-edges.
std::optional<Mesh::Halfedge_index> rim_half_edge(const LocalMesh& local, const Hole& hole) {
    for (const VertexId v : hole.loop)
        if (!local.local.contains(v)) return std::nullopt;
    const Mesh& mesh = local.mesh;
    const auto h = mesh.halfedge(local.local.at(hole.loop[1]), local.local.at(hole.loop[0]));
    if (h == Mesh::null_halfedge() || !mesh.is_border(h)) return std::nullopt;
    if (hole.fills_touching_rims) return h;
    std::size_t length = 0;
    for (auto at = h; length <= hole.loop.size(); at = mesh.next(at)) {
        ++length;
        if (mesh.next(at) == h) break;
    }
    return length == hole.loop.size() ? std::optional(h) : std::nullopt;
}

Triangle corners_of(const LocalMesh& local, Mesh::Face_index face) {
    Triangle corners{};
    std::size_t k = 0;
    for (const auto v : local.mesh.vertices_around_face(local.mesh.halfedge(face)))
        corners[k++] = local.number[v];
    return corners;
}

/// Numbers the new vertices in the order of their first new triangle.
void order_by_faces(LocalMesh& local, std::size_t old_vertices) {
    std::vector<std::uint8_t> seen(local.mesh.number_of_vertices(), 0);
    std::vector<Mesh::Vertex_index> order;
    for (const auto face : local.new_faces)
        for (const auto v : local.mesh.vertices_around_face(local.mesh.halfedge(face)))
            if (static_cast<std::size_t>(v) >= old_vertices && seen[v]++ == 0) order.push_back(v);
    local.new_vertices = std::move(order);
}

HolePatch patch_from(LocalMesh& local, const Hole& hole) {
    local.number.resize(local.mesh.number_of_vertices());
    HolePatch patch;
    for (const auto v : local.new_vertices) {
        local.number[v] = hole.first_new + static_cast<VertexId>(patch.points.size());
        patch.points.push_back(from_cgal(local.mesh.point(v)));
    }
    for (const auto face : local.new_faces) patch.triangles.push_back(corners_of(local, face));
    return patch;
}

/// Adds the flat triangulation of the loop. False if a triangle does not fit.
bool add_flat(LocalMesh& local, const Hole& hole) {
    Positions rim;
    std::vector<Mesh::Vertex_index> corners;
    for (auto v = hole.loop.rbegin(); v != hole.loop.rend(); ++v) {
        corners.push_back(local.local.at(*v));
        const auto& p = local.mesh.point(corners.back());
        rim.emplace_back(0.0, p.y(), p.z());
    }
    double length = 0.0;
    for (std::size_t i = 0; i < rim.size(); ++i)
        length += (rim[(i + 1) % rim.size()] - rim[i]).norm();
    const FlatCap flat =
        fill_flat(rim, {Vec3::Zero(), Vec3::UnitX()}, length / static_cast<double>(rim.size()));
    for (const Vec3& p : flat.inner) {
        corners.push_back(local.mesh.add_vertex(to_cgal(p)));
        local.new_vertices.push_back(corners.back());
    }
    for (const auto& [a, b, c] : flat.triangles) {
        const auto face = local.mesh.add_face(corners[a], corners[b], corners[c]);
        if (face == Mesh::null_face()) return false;
        local.new_faces.push_back(face);
    }
    return true;
}

auto fairing(int continuity) {
    return PMP::parameters::fairing_continuity(static_cast<unsigned>(continuity));
}

HolePatch fan(const Hole& hole) {
    HolePatch patch;
    Vec3 centre = Vec3::Zero();
    for (const VertexId v : hole.loop) centre += hole.point(v);
    patch.points.emplace_back(centre / static_cast<double>(hole.loop.size()));
    for (std::size_t i = 0; i < hole.loop.size(); ++i)
        patch.triangles.push_back(
            {hole.loop[(i + 1) % hole.loop.size()], hole.loop[i], hole.first_new});
    return patch;
}

}  // namespace

HolePatch fill_smoothly(const Hole& hole, int continuity, PatchOrder order) {
    auto local = local_mesh(hole);
    const auto rim = local ? rim_half_edge(*local, hole) : std::nullopt;
    if (!rim) return {HolePatch::Result::NotManifold, {}, {}};
    const std::size_t old_vertices = local->mesh.number_of_vertices();
    PMP::triangulate_refine_and_fair_hole(local->mesh, *rim, std::back_inserter(local->new_faces),
                                          std::back_inserter(local->new_vertices),
                                          fairing(continuity));
    if (local->new_faces.empty()) return {HolePatch::Result::NotTriangulated, {}, {}};
    if (order == PatchOrder::AsReported) {
        order_by_faces(*local, old_vertices);
    } else {
        std::sort(local->new_faces.begin(), local->new_faces.end());
        std::sort(local->new_vertices.begin(), local->new_vertices.end());
    }
    return patch_from(*local, hole);
}

HolePatch fill_seen_along_x(const Hole& hole, int continuity) {
    auto local = local_mesh(hole);
    if (!local || !rim_half_edge(*local, hole)) return {HolePatch::Result::NotManifold, {}, {}};
    if (!add_flat(*local, hole) ||
        (!local->new_vertices.empty() &&
         !PMP::fair(local->mesh, local->new_vertices, fairing(continuity))))
        return {HolePatch::Result::NotTriangulated, {}, {}};
    return patch_from(*local, hole);
}

HolePatch fill_plainly(const Hole& hole) {
    const auto& loop = hole.loop;
    if (loop.size() == 3) return {.triangles = {{loop[0], loop[2], loop[1]}}};
    std::vector<Kernel::Point_3> polyline;
    for (std::size_t i = loop.size(); i-- > 0;) polyline.push_back(to_cgal(hole.point(loop[i])));

    struct Corners {
        int a, b, c;

        Corners(int i, int j, int k) : a(i), b(j), c(k) {}
    };

    std::vector<Corners> found;
    PMP::triangulate_hole_polyline(polyline, std::back_inserter(found));
    if (found.empty()) return fan(hole);
    HolePatch patch;
    const std::size_t last = loop.size() - 1;
    for (const Corners& t : found)
        patch.triangles.push_back({loop[last - static_cast<std::size_t>(t.a)],
                                   loop[last - static_cast<std::size_t>(t.b)],
                                   loop[last - static_cast<std::size_t>(t.c)]});
    return patch;
}

std::vector<TriangleId> triangles_around(
    std::span<const VertexId> loop, int rings,
    const std::function<std::vector<TriangleId>(VertexId)>& triangles_at,
    const std::function<Triangle(TriangleId)>& corners) {
    std::vector<VertexId> front(loop.begin(), loop.end());
    std::vector<TriangleId> found;
    for (int ring = 0; ring < rings; ++ring) {
        for (const VertexId v : front)
            for (const TriangleId t : triangles_at(v)) found.push_back(t);
        std::sort(found.begin(), found.end());
        found.erase(std::unique(found.begin(), found.end()), found.end());
        front.clear();
        for (const TriangleId t : found)
            for (const VertexId v : corners(t)) front.push_back(v);
        std::sort(front.begin(), front.end());
        front.erase(std::unique(front.begin(), front.end()), front.end());
    }
    return found;
}

}  // namespace vesselbench
