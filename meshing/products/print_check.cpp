#include "meshing/products/print_check.h"

#include <algorithm>
#include <limits>
#include <map>
#include <set>

#include <tbb/parallel_for.h>

#include "geometry/kernel/argument_checks.h"
#include "geometry/kernel/disjoint_sets.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/measure.h"
#include "geometry/kernel/shortest_paths.h"
#include "geometry/kernel/surface_distance.h"

namespace vesselbench {

namespace {

// Facing: the normals differ by more than 120 degrees.
constexpr double kFacing = -0.5;
// A half circle's arc is 1.57 times its opening: the bottom of a fold. Two branches are farther
// apart.
constexpr double kDetour = 3.0;

struct Candidate {
    double distance;
    VertexId from;
    Vec3 to;
    TriangleId triangle;
};

std::vector<std::uint8_t> on_openings(const Surface& surface) {
    std::vector<std::uint8_t> flags(surface.vertex_count(), 0);
    for (TriangleId t = 0; t < surface.triangle_count(); ++t)
        if (surface.patch_of(t).kind != PatchKind::Wall)
            for (const VertexId v : surface.triangles()[t]) flags[v] = 1;
    return flags;
}

// Distances along sign * normal from every wall vertex to the opposite wall; nearest first.
// \param reach farther walls do not count [mm]
std::vector<Candidate> facing_walls(const Surface& surface, const SurfaceDistance& search,
                                    double sign,
                                    double reach = std::numeric_limits<double>::infinity()) {
    const Positions normals = vertex_normals(surface);
    const auto skipped = on_openings(surface);
    const double lift =
        1e-6 * bounds(surface).diagonal();  // away from the triangles at the vertex itself
    std::vector<std::optional<Candidate>> found(surface.vertex_count());
    tbb::parallel_for(std::size_t{0}, found.size(), [&](std::size_t v) {
        if (skipped[v] != 0 || normals[v].squaredNorm() < 0.5) return;
        const Vec3 direction = sign * normals[v], start = surface.points()[v] + lift * direction;
        const auto hit = search.first_hit(start, direction, reach);
        if (!hit || surface.patch_of(hit->triangle).kind != PatchKind::Wall) return;
        const Vec3 normal =
            area_normal(surface.points(), surface.triangles()[hit->triangle]).normalized();
        if (normal.dot(normals[v]) > kFacing) return;
        found[v] =
            Candidate{hit->distance + lift, static_cast<VertexId>(v), hit->point, hit->triangle};
    });
    std::vector<Candidate> candidates;
    for (const auto& candidate : found)
        if (candidate) candidates.push_back(*candidate);
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const auto& l, const auto& r) { return l.distance < r.distance; });
    return candidates;
}

// Distances of the few vertices that a search reaches.
class FewDistances {
public:
    double& operator[](VertexId v) {
        return known_.try_emplace(v, std::numeric_limits<double>::infinity()).first->second;
    }

private:
    std::map<VertexId, double> known_;
};

// True if a path along the edges from `from` to one of the triangle's corners is shorter than
// `reach`.
bool near_along_surface(const Surface& surface, VertexId from, const Triangle& target,
                        double reach) {
    FewDistances distances;
    ShortestPaths paths(distances);
    paths.lower(from, 0.0);
    while (const auto at = paths.next()) {
        if (std::ranges::find(target, at->vertex) != target.end()) return true;
        for (const VertexId u : surface.topology->rings().row(at->vertex)) {
            const double way =
                at->distance + (surface.points()[u] - surface.points()[at->vertex]).norm();
            if (way <= reach) paths.lower(u, way);
        }
    }
    return false;
}

// True if the candidate's walls belong to one fold.
bool is_fold(const Surface& surface, const Candidate& candidate) {
    return near_along_surface(surface, candidate.from, surface.triangles()[candidate.triangle],
                              kDetour * candidate.distance);
}

FacingPlaces places_of(const Surface& surface, const Candidate& candidate) {
    return {candidate.distance, surface.points()[candidate.from], candidate.to};
}

}  // namespace

bool PrintCheck::is_watertight() const {
    return std::none_of(problems.begin(), problems.end(), is_obstacle);
}

bool PrintCheck::is_printable(double thinnest, double closest) const {
    return is_watertight() && !(lumen && lumen->distance < thinnest) &&
           !(gap && gap->distance < closest);
}

PrintCheck print_check(const Surface& surface, const Progress& progress) {
    if (surface.empty()) throw InvalidInput("the surface has no triangles");
    PrintCheck check;
    progress.report(0.0, "checking the surface");
    check.problems = surface_problems(surface, progress);
    const Bounds box = bounds(surface);
    check.size = box.max - box.min;
    check.volume = volume(surface);
    check.area = area(surface);
    progress.report(0.5, "measuring walls and gaps");
    const SurfaceDistance search = distance_to(surface);
    const auto across = facing_walls(surface, search, -1.0);
    if (!across.empty()) check.lumen = places_of(surface, across.front());
    for (const Candidate& candidate : facing_walls(surface, search, 1.0)) {
        progress.check_cancelled();
        if (is_fold(surface, candidate)) continue;
        check.gap = places_of(surface, candidate);
        break;
    }
    return check;
}

std::vector<FacingPlaces> narrow_gaps(const Surface& surface, double width,
                                      const Progress& progress) {
    require_positive("width", width);
    std::vector<Candidate> narrow;
    std::vector<std::uint8_t> is_narrow(surface.vertex_count(), 0);
    for (const Candidate& candidate : facing_walls(surface, distance_to(surface), 1.0, width)) {
        progress.check_cancelled();
        if (is_fold(surface, candidate)) continue;
        narrow.push_back(candidate);
        is_narrow[candidate.from] = 1;
    }
    DisjointSets sets(surface.vertex_count());
    for (const Candidate& candidate : narrow) {
        for (const VertexId u : surface.topology->rings().row(candidate.from))
            if (is_narrow[u] != 0) sets.join(candidate.from, u);
        for (const VertexId u : surface.triangles()[candidate.triangle])
            sets.join(candidate.from, u);
    }
    std::vector<FacingPlaces> gaps;
    std::set<VertexId> seen;
    for (const Candidate& candidate : narrow)  // nearest first
        if (seen.insert(sets.root(candidate.from)).second)
            gaps.push_back(places_of(surface, candidate));
    return gaps;
}

}  // namespace vesselbench
