#include "geometry/vessel/repair/hole_patch.h"

#include <map>
#include <optional>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>
#include <CGAL/Surface_mesh.h>

namespace vesselbench {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
namespace PMP = CGAL::Polygon_mesh_processing;

Kernel::Point_3 to_cgal(const Vec3& p) {
    return {p.x(), p.y(), p.z()};
}

struct LocalMesh {
    Mesh mesh;
    std::map<VertexId, Mesh::Vertex_index> vertex;

    Mesh::Vertex_index add(const Positions& points, VertexId v) {
        const auto [at, fresh] = vertex.try_emplace(v);
        if (fresh) at->second = mesh.add_vertex(to_cgal(points[v]));
        return at->second;
    }
};

/// The triangles as a half-edge mesh; none if they do not form a manifold.
std::optional<LocalMesh> local_mesh(const Positions& points, const std::vector<Triangle>& around) {
    LocalMesh local;
    for (const Triangle& t : around) {
        const auto a = local.add(points, t[0]), b = local.add(points, t[1]),
                   c = local.add(points, t[2]);
        if (local.mesh.add_face(a, b, c) == Mesh::null_face()) return std::nullopt;
    }
    return local;
}

/// Checks that the rim of the half-edge mesh runs along the loop, and gives its half-edge.
std::optional<Mesh::Halfedge_index> rim_half_edge(const LocalMesh& local,
                                                  const std::vector<VertexId>& loop) {
    for (const VertexId v : loop)
        if (!local.vertex.contains(v)) return std::nullopt;
    // The border runs against the triangles' half-edges.
    const auto h = local.mesh.halfedge(local.vertex.at(loop[1]), local.vertex.at(loop[0]));
    if (h == Mesh::null_halfedge() || !local.mesh.is_border(h)) return std::nullopt;
    std::size_t length = 0;
    for (auto at = h; length <= loop.size(); at = local.mesh.next(at)) {
        ++length;
        if (local.mesh.next(at) == h) break;
    }
    return length == loop.size() ? std::optional(h) : std::nullopt;
}

HolePatch patch_from(const LocalMesh& local, const std::vector<VertexId>& loop,
                     const std::vector<Mesh::Face_index>& faces) {
    std::map<Mesh::Vertex_index, VertexId> number;
    for (std::size_t i = 0; i < loop.size(); ++i)
        number[local.vertex.at(loop[i])] = static_cast<VertexId>(i);
    HolePatch patch;
    for (const auto face : faces) {
        Triangle triangle{};
        std::size_t k = 0;
        for (const auto v : vertices_around_face(local.mesh.halfedge(face), local.mesh)) {
            const auto next = static_cast<VertexId>(loop.size() + patch.points.size());
            const auto [at, fresh] = number.try_emplace(v, next);
            if (fresh) {
                const auto& p = local.mesh.point(v);
                patch.points.emplace_back(p.x(), p.y(), p.z());
            }
            triangle[k++] = at->second;
        }
        patch.triangles.push_back(triangle);
    }
    return patch;
}

HolePatch fan(const Positions& points, const std::vector<VertexId>& loop) {
    HolePatch patch;
    Vec3 centre = Vec3::Zero();
    for (const VertexId v : loop) centre += points[v];
    patch.points.emplace_back(centre / static_cast<double>(loop.size()));
    const auto n = static_cast<VertexId>(loop.size());
    for (VertexId i = 0; i < n; ++i) patch.triangles.push_back({(i + 1) % n, i, n});
    return patch;
}

}  // namespace

HolePatch fill_hole_smoothly(const Positions& points, const std::vector<Triangle>& around,
                             const std::vector<VertexId>& loop) {
    if (loop.size() <= 3) return fill_hole_plainly(points, loop);
    auto local = local_mesh(points, around);
    const auto rim = local ? rim_half_edge(*local, loop) : std::nullopt;
    if (!rim) return fill_hole_plainly(points, loop);
    std::vector<Mesh::Face_index> faces;
    std::vector<Mesh::Vertex_index> vertices;
    PMP::triangulate_refine_and_fair_hole(local->mesh, *rim, std::back_inserter(faces),
                                          std::back_inserter(vertices));
    if (faces.empty()) return fill_hole_plainly(points, loop);
    return patch_from(*local, loop, faces);
}

HolePatch fill_hole_plainly(const Positions& points, const std::vector<VertexId>& loop) {
    if (loop.size() == 3) return {{}, {{0, 2, 1}}};
    std::vector<Kernel::Point_3> polyline;
    for (std::size_t i = loop.size(); i-- > 0;) polyline.push_back(to_cgal(points[loop[i]]));

    struct Corners {
        int a, b, c;

        Corners(int i, int j, int k) : a(i), b(j), c(k) {}
    };

    std::vector<Corners> found;
    PMP::triangulate_hole_polyline(polyline, std::back_inserter(found));
    if (found.empty()) return fan(points, loop);
    HolePatch patch;
    const int last = static_cast<int>(loop.size()) - 1;
    for (const Corners& t : found)
        patch.triangles.push_back({static_cast<VertexId>(last - t.a),
                                   static_cast<VertexId>(last - t.b),
                                   static_cast<VertexId>(last - t.c)});
    return patch;
}

}  // namespace vesselbench
