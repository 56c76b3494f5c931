#include "meshing/remeshing/local_subdivide.h"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "geometry/editing/triangle_soup.h"
#include "geometry/kernel/argument_checks.h"
#include "geometry/kernel/diagnosed_error.h"
#include "meshing/remeshing/subdivide.h"

namespace vesselbench {

namespace {

constexpr int kMostIterations = 6;

/// A surface under refinement.
struct Refined {
    TriangleSoup soup;
    std::vector<std::uint8_t> movable;  ///< by vertex: Loop's rules move it
    std::vector<std::uint8_t> core;     ///< by triangle: it is split in every iteration
    std::vector<std::uint8_t> fresh;    ///< by triangle: it is new
};

using Edge = std::pair<VertexId, VertexId>;  ///< low, high

/// 1 at vertices of rims: of patches and of open boundaries.
std::vector<std::uint8_t> rim_vertices(const Surface& surface) {
    std::vector<std::uint8_t> rim = surface.topology->boundary_vertices();
    const CompressedRows& fans = surface.topology->triangles_at();
    for (VertexId v = 0; v < rim.size(); ++v)
        for (const TriangleId t : fans.row(v))
            if ((*surface.patch_labels)[t] != (*surface.patch_labels)[fans.row(v)[0]]) rim[v] = 1;
    return rim;
}

Refined refined_from(const Surface& surface, const SurfaceDistance& places, const NearPlace& near) {
    const SurfacePoint centre = places.closest_point(near.at);
    Refined refined{.soup = soup_from(surface),
                    .movable = std::vector<std::uint8_t>(surface.vertex_count(), 0),
                    .core = {},
                    .fresh = std::vector<std::uint8_t>(surface.triangle_count(), 0)};
    const std::vector<VertexId> vertices = vertices_within(surface, centre, near.within);
    refined.core = triangles_at(surface, vertices);
    refined.core[centre.triangle] = 1;
    const std::vector<std::uint8_t> rim = rim_vertices(surface);
    for (const VertexId v : vertices) refined.movable[v] = rim[v] ? 0 : 1;
    return refined;
}

/// The triangles and so many rings around them.
std::vector<std::uint8_t> grown(const Surface& surface, std::vector<std::uint8_t> marked,
                                int rings) {
    for (int ring = 0; ring < rings; ++ring) {
        std::vector<VertexId> vertices;
        for (TriangleId t = 0; t < marked.size(); ++t)
            if (marked[t])
                vertices.insert(vertices.end(), surface.triangles()[t].begin(),
                                surface.triangles()[t].end());
        marked = triangles_at(surface, vertices);
    }
    return marked;
}

/// New vertices in the middle of edges.
class Middles {
public:
    explicit Middles(Refined& refined) : refined_(refined) {}

    /// \param looped where Loop's rules put it
    void add(VertexId a, VertexId b, const Vec3& looped) {
        const auto [at, fresh] = of_edge_.try_emplace(std::minmax(a, b), 0);
        if (!fresh) return;
        const bool moves = refined_.movable[a] || refined_.movable[b];
        const Vec3 middle = 0.5 * (refined_.soup.points[a] + refined_.soup.points[b]);
        const std::array<VertexId, 2> ends{a, b};
        at->second = refined_.soup.add_vertex_between(moves ? looped : middle, ends);
        refined_.movable.push_back(refined_.movable[a] && refined_.movable[b] ? 1 : 0);
    }

    [[nodiscard]] std::optional<VertexId> of(VertexId a, VertexId b) const {
        const auto found = of_edge_.find(std::minmax(a, b));
        return found == of_edge_.end() ? std::nullopt : std::optional(found->second);
    }

private:
    Refined& refined_;
    std::map<Edge, VertexId> of_edge_;
};

/// The triangles that a triangle with some divided edges becomes.
std::vector<Triangle> pieces(const Triangle& t, const Middles& middles) {
    std::array<std::optional<VertexId>, 3> middle;
    int count = 0, first = 0;
    for (int k = 0; k < 3; ++k) {
        middle[k] = middles.of(t[k], t[(k + 1) % 3]);
        count += middle[k] ? 1 : 0;
    }
    if (count == 0) return {t};
    if (count == 3)
        return {{t[0], *middle[0], *middle[2]},
                {*middle[0], t[1], *middle[1]},
                {*middle[2], *middle[1], t[2]},
                {*middle[0], *middle[1], *middle[2]}};
    // Turned so that the first edge is divided, and of two the last one is not.
    while (!middle[first] || (count == 2 && middle[(first + 2) % 3])) ++first;
    const VertexId a = t[first], b = t[(first + 1) % 3], c = t[(first + 2) % 3],
                   ab = *middle[first];
    if (count == 1) return {{a, ab, c}, {ab, b, c}};
    const VertexId bc = *middle[(first + 1) % 3];
    return {{ab, b, bc}, {a, ab, bc}, {a, bc, c}};
}

/// Where Loop's rules put old and new vertices around the triangles that are split.
void place_vertices(const Surface& surface, const std::vector<std::uint8_t>& split,
                    Refined& refined, Middles& middles) {
    std::vector<std::uint8_t> around = grown(surface, split, 1);
    close_fans(surface, around);
    const LocalPart part = part_of(surface, around);
    const Surface looped = subdivide(part.surface, 1);
    TriangleId in_part = 0;
    for (TriangleId t = 0; t < around.size(); ++t) {
        if (!around[t]) continue;
        const TriangleId corner = 4 * in_part++;  // subdivide() keeps the order, four for one
        if (!split[t]) continue;
        const auto& [a, b, c] = surface.triangles()[t];
        const Triangle &at_a = looped.triangles()[corner], &at_c = looped.triangles()[corner + 2];
        middles.add(a, b, looped.points()[at_a[1]]);
        middles.add(b, c, looped.points()[at_c[1]]);
        middles.add(c, a, looped.points()[at_a[2]]);
    }
    for (VertexId v = 0; v < part.vertices.size(); ++v)
        if (refined.movable[part.vertices[v]])
            refined.soup.points[part.vertices[v]] = looped.points()[v];
}

void refine(Refined& refined, int rings_more) {
    const Surface surface = surface_from(refined.soup);
    const std::vector<std::uint8_t> split = grown(surface, refined.core, rings_more);
    Middles middles(refined);
    place_vertices(surface, split, refined, middles);
    TriangleSoup& soup = refined.soup;
    const std::vector<Triangle> old = std::exchange(soup.triangles, {});
    const PatchLabels labels = std::exchange(soup.labels, {});
    const auto core = std::exchange(refined.core, {}), fresh = std::exchange(refined.fresh, {});
    for (TriangleId t = 0; t < old.size(); ++t) {
        const std::vector<Triangle> parts = pieces(old[t], middles);
        for (const Triangle& piece : parts) {
            soup.add_triangle(piece, labels[t]);
            refined.core.push_back(core[t]);
            const bool moved =
                std::ranges::any_of(piece, [&](VertexId v) { return refined.movable[v] != 0; });
            refined.fresh.push_back(fresh[t] || parts.size() > 1 || moved ? 1 : 0);
        }
    }
}

}  // namespace

Surface subdivide_near(const Surface& surface, const SurfaceDistance& places, const NearPlace& near,
                       int iterations, const Progress& progress) {
    require_positive("within", near.within);
    require_range("iterations", iterations, 1, kMostIterations);
    Refined refined = refined_from(surface, places, near);
    for (int i = 0; i < iterations; ++i) {
        progress.report(0.8 * i / iterations, "subdividing");
        refine(refined, iterations - 1 - i);
    }
    const std::vector<std::uint8_t> fresh = refined.fresh;
    Surface result = surface_from(std::move(refined.soup));
    progress.report(0.8, "looking for crossings");
    if (const auto crossing = crossing_of(result, fresh, progress.part(0.8, 1.0)))
        throw DiagnosedFailure({.code = "would-cross-itself",
                                .operation = "subdivide",
                                .place = *crossing,
                                .remedies = {{.operation = "repair"}}});
    return result;
}

}  // namespace vesselbench
