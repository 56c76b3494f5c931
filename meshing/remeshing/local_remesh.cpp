#include "meshing/remeshing/local_remesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "geometry/kernel/argument_checks.h"
#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/reached_distances.h"
#include "geometry/kernel/self_intersections.h"
#include "geometry/kernel/shortest_paths.h"
#include "geometry/kernel/surface_gap.h"
#include "geometry/kernel/wording.h"
#include "meshing/remeshing/remesh_rounds.h"
#include "meshing/remeshing/sizing_field.h"

namespace vesselbench {

namespace {

constexpr double kSlope = 0.25;      ///< with which edges grow beyond the surroundings [-]
constexpr double kGradation = 1.5;   ///< as remesh() has by default [-]
constexpr double kSourceEdge = 1.5;  ///< longest edge that carries sizes, in target edges [-]

/// Ways along edges are longer than straight ones on the surface, by up to 15 % in a regular mesh.
constexpr double kDetour = 1.16;

/// Where the given edge length holds.
struct Core {
    SurfacePoint centre;
    double within = 0.0;               ///< [mm]
    double edge = 0.0;                 ///< [mm]
    std::vector<VertexId> vertices{};  ///< within it, ascending

    /// Target edge length at a place [mm].
    [[nodiscard]] double size_at(const Vec3& x) const {
        return edge + kSlope * std::max(0.0, (x - centre.point).norm() - within);
    }
};

/// With the triangle of the centre and its neighbours: there may be no vertex so near.
std::vector<std::uint8_t> marked_around(const Surface& surface, const SurfacePoint& centre,
                                        std::span<const VertexId> vertices) {
    std::vector<std::uint8_t> marked = triangles_at(surface, vertices);
    const Triangle& middle = surface.triangles()[centre.triangle];
    marked[centre.triangle] = 1;
    for (const VertexId v : middle)
        for (const TriangleId t : surface.topology->triangles_at().row(v))
            if (std::ranges::count_if(surface.triangles()[t], [&](VertexId u) {
                    return std::ranges::find(middle, u) != middle.end();
                }) == 2)
                marked[t] = 1;
    return marked;
}

double mean_edge_of(const Surface& surface, std::span<const std::uint8_t> marked) {
    double sum = 0.0, count = 0.0;
    for (TriangleId t = 0; t < marked.size(); ++t) {
        if (!marked[t]) continue;
        const Triangle& corners = surface.triangles()[t];
        for (int k = 0; k < 3; ++k)
            sum += (surface.points()[corners[k]] - surface.points()[corners[(k + 1) % 3]]).norm();
        count += 3.0;
    }
    return sum / count;
}

/// Length of an edge in the target length where it is nearest to the centre [-].
double share_of(const EditMesh& mesh, EditMesh::HalfEdge h, const Core& core) {
    const Vec3 &a = mesh.points[mesh.origin(h)], &b = mesh.points[mesh.target(h)];
    const Vec3 nearest = segment_gap(core.centre.point, core.centre.point, a, b).to;
    return (a - b).norm() / core.size_at(nearest);
}

/// Rims that stay: an edge to what lies outside the part, or between two vertices that stay.
bool is_fixed_rim(const EditMesh& mesh, EditMesh::HalfEdge h,
                  std::span<const std::uint8_t> anchored) {
    if (mesh.is_hole(mesh.patch_at(h)) || mesh.is_hole(mesh.patch_at(mesh.twin(h)))) return true;
    const auto stays = [&](VertexId v) { return v < anchored.size() && anchored[v] != 0; };
    return mesh.is_feature(h) && stays(mesh.origin(h)) && stays(mesh.target(h));
}

/// Of both its triangles: dividing others beside a rim that stays makes no end of long edges.
bool is_longest(const EditMesh& mesh, EditMesh::HalfEdge h) {
    const auto squared = [&](EditMesh::HalfEdge k) {
        return (mesh.points[mesh.origin(k)] - mesh.points[mesh.target(k)]).squaredNorm();
    };
    const double own = squared(h);
    return std::ranges::all_of(std::array{h, mesh.twin(h)}, [&](EditMesh::HalfEdge side) {
        return mesh.is_hole(mesh.patch_at(side)) ||
               (squared(EditMesh::next(side)) <= own && squared(EditMesh::prev(side)) <= own);
    });
}

/// The part with its edges divided until sizes at vertices say what is wanted in between. Old
/// vertices keep their numbers.
/// \param anchored 1 at vertices that stay
Surface divided(const Surface& part, const Core& core, std::span<const std::uint8_t> anchored,
                const Progress& cancel) {
    EditMesh mesh(part);
    const auto is_long = [&](EditMesh::HalfEdge h) {
        return mesh.origin(h) < mesh.target(h) && !is_fixed_rim(mesh, h, anchored) &&
               share_of(mesh, h, core) > kSourceEdge && is_longest(mesh, h);
    };
    std::vector<std::pair<double, EditMesh::HalfEdge>> edges;
    do {
        edges.clear();
        for (EditMesh::HalfEdge h = 0; h < mesh.half_edge_count(); ++h)
            if (is_long(h)) edges.emplace_back(-share_of(mesh, h, core), h);
        std::ranges::sort(edges);
        // The longest first, and no others with them: splits in any order make slivers.
        constexpr double kAtOnce = 0.7;
        for (const auto& [share, h] : edges) {
            cancel.check_cancelled();
            if (share > kAtOnce * edges.front().first) break;
            const Vec3 middle = 0.5 * (mesh.points[mesh.origin(h)] + mesh.points[mesh.target(h)]);
            static_cast<void>(mesh.split(h, middle));
        }
    } while (!edges.empty());
    std::vector<VertexId> kept;
    return mesh.to_surface(part.patches, kept);
}

/// \param anchored 1 at vertices of the part that stay
std::vector<double> sizes_of(const Surface& source, const Surface& part,
                             std::span<const std::uint8_t> anchored, const Core& core) {
    const std::vector<double> present = mean_edges(part);
    std::vector<double> sizes;
    for (VertexId v = 0; v < source.vertex_count(); ++v) {
        sizes.push_back(core.size_at(source.points()[v]));
        if (v < anchored.size() && anchored[v]) sizes.back() = std::min(sizes.back(), present[v]);
    }
    limit_slope(source, slope_of(kGradation), sizes);
    return sizes;
}

void check_count(const Core& core) {
    const double count =
        std::numbers::pi * std::pow(core.within / core.edge, 2) / (std::sqrt(3.0) / 4.0);
    const auto most = static_cast<double>(Remesher::kMostTriangles);
    if (count <= most) return;
    const double finest = 1.1 * core.edge * std::sqrt(count / most);
    throw DiagnosedFailure({.code = "edges-too-fine",
                            .operation = "remesh",
                            .figures = {{"edge_mm", core.edge},
                                        {"millions", count / 1e6},
                                        {"most_millions", most / 1e6}},
                            .remedies = {{.arguments = {{"edge", formatted(finest, "%.2g")}}}}});
}

Core core_of(const Surface& surface, const SurfaceDistance& places, const NearPlace& near,
             std::optional<double> edge) {
    require_positive("within", near.within);
    require_in_proportion("within", near.within, surface, 1.0);
    Core core{.centre = places.closest_point(near.at),
              .within = near.within,
              .edge = edge.value_or(near.within / kEdgesPerRadius)};
    require_positive("edge", core.edge);
    require_range("edge", core.edge, 0.0, core.within);
    check_count(core);
    core.vertices = vertices_within(surface, core.centre, near.within);
    return core;
}

std::vector<std::uint8_t> anchored_vertices(const LocalPart& part, const Core& core) {
    std::vector<std::uint8_t> anchored = part.rim;
    for (VertexId v = 0; v < anchored.size(); ++v)
        if (!std::ranges::binary_search(core.vertices, part.vertices[v])) anchored[v] = 1;
    return anchored;
}

}  // namespace

std::vector<VertexId> vertices_within(const Surface& surface, const SurfacePoint& centre,
                                      double within) {
    ReachedDistances distances;
    ShortestPaths paths(distances);
    const Positions& points = surface.points();
    for (const VertexId v : surface.triangles()[centre.triangle])
        paths.lower(v, (points[v] - centre.point).norm());
    std::vector<VertexId> vertices;
    while (const auto at = paths.next()) {
        if ((points[at->vertex] - centre.point).norm() <= within) vertices.push_back(at->vertex);
        for (const VertexId u : surface.topology->rings().row(at->vertex)) {
            const double distance = at->distance + (points[u] - points[at->vertex]).norm();
            if (distance <= kDetour * within) paths.lower(u, distance);
        }
    }
    std::ranges::sort(vertices);
    return vertices;
}

std::vector<std::uint8_t> triangles_at(const Surface& surface, std::span<const VertexId> vertices) {
    std::vector<std::uint8_t> marked(surface.triangle_count(), 0);
    for (const VertexId v : vertices)
        for (const TriangleId t : surface.topology->triangles_at().row(v)) marked[t] = 1;
    return marked;
}

std::vector<double> mean_edges(const Surface& surface) {
    std::vector<double> means(surface.vertex_count(), 0.0);
    const CompressedRows& rings = surface.topology->rings();
    for (VertexId v = 0; v < means.size(); ++v) {
        const auto ring = rings.row(v);
        for (const VertexId u : ring)
            means[v] += (surface.points()[u] - surface.points()[v]).norm();
        if (!ring.empty()) means[v] /= static_cast<double>(ring.size());
    }
    return means;
}

std::optional<Vec3> crossing_of(const Surface& surface, std::span<const std::uint8_t> changed,
                                const Progress& progress) {
    const auto pairs =
        self_intersections_with(surface.points(), surface.triangles(), changed, progress);
    if (pairs.empty()) return std::nullopt;
    const Triangle& t = surface.triangles()[pairs.front().first];
    return (surface.points()[t[0]] + surface.points()[t[1]] + surface.points()[t[2]]) / 3.0;
}

double mean_edge_near(const Surface& surface, const SurfaceDistance& places,
                      const NearPlace& near) {
    require_positive("within", near.within);
    const SurfacePoint centre = places.closest_point(near.at);
    return mean_edge_of(
        surface, marked_around(surface, centre, vertices_within(surface, centre, near.within)));
}

EditedPart remesh_part(const Surface& part, std::vector<double> sizes,
                       std::span<const std::uint8_t> anchored, const Progress& progress) {
    for (double& size : sizes) size /= Remesher::kStretch;
    Remesher remesher(part, sizes, part, progress);
    remesher.anchor(anchored);
    static_cast<void>(remeshed(remesher, 0, progress));
    EditedPart edited;
    std::vector<VertexId> kept;
    edited.surface = remesher.mesh.to_surface(part.patches, kept);
    for (const VertexId v : kept)
        edited.former.push_back(remesher.is_anchored(v) ? remesher.anchors[v] : kNewVertex);
    return edited;
}

/// Each halving of the edges takes a ring of triangles and rounds of splits.
void check_fineness(double edge, double present) {
    constexpr double kFinest = 1000.0;  ///< times shorter than what is there
    if (edge * kFinest >= present) return;
    throw AlgorithmFailure("edges of " + formatted(edge, "%.3g mm") +
                           " are more than a thousand times shorter than those there, " +
                           formatted(present, "%.3g mm") +
                           ": give a larger edge, or a larger within");
}

LocalRemeshed remesh_near(const Surface& surface, const SurfaceDistance& places,
                          const NearPlace& near, std::optional<double> edge,
                          const Progress& progress) {
    const Core core = core_of(surface, places, near, edge);
    LocalRemeshReport report{.edge = core.edge};
    report.edge_before = mean_edge_of(surface, marked_around(surface, core.centre, core.vertices));
    check_fineness(core.edge, report.edge_before);
    report.reach = core.within + std::max(0.0, report.edge_before - core.edge) / kSlope;
    std::vector<std::uint8_t> marked =
        marked_around(surface, core.centre, vertices_within(surface, core.centre, report.reach));
    close_fans(surface, marked);
    report.replaced = static_cast<std::size_t>(std::ranges::count(marked, 1));
    const LocalPart part = part_of(surface, marked);
    std::vector<std::uint8_t> anchored = anchored_vertices(part, core);
    const Surface source = divided(part.surface, core, anchored, progress);
    std::vector<double> sizes = sizes_of(source, part.surface, anchored, core);
    anchored.resize(source.vertex_count(), 0);
    const EditedPart edited =
        remesh_part(source, std::move(sizes), anchored, progress.part(0.0, 0.8));
    report.replacement = edited.surface.triangle_count();
    progress.report(0.8, "looking for crossings");
    LocalRemeshed result{sewn(surface, marked, part, edited), report};
    std::vector<std::uint8_t> changed(result.surface.triangle_count(), 0);
    std::fill(changed.end() - static_cast<std::ptrdiff_t>(report.replacement), changed.end(), 1);
    if (const auto crossing = crossing_of(result.surface, changed, progress.part(0.8, 1.0)))
        throw DiagnosedFailure({.code = "would-cross-itself",
                                .operation = "remesh",
                                .place = *crossing,
                                .remedies = {{.arguments = {{"edge", ""}}}}});
    return result;
}

}  // namespace vesselbench
