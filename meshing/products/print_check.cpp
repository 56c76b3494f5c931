#include "meshing/products/print_check.h"

#include <algorithm>
#include <set>

#include "geometry/kernel/argument_checks.h"
#include "geometry/kernel/disjoint_sets.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/facing_walls.h"
#include "geometry/kernel/measure.h"

namespace vesselbench {

namespace {

FacingPlaces places_of(const Surface& surface, const FacingWall& facing) {
    return {facing.distance, surface.points()[facing.from], facing.to};
}

/// Several closed bodies are printed beside each other, each of them watertight.
bool is_leak(const SurfaceProblem& problem) {
    return is_obstacle(problem) && problem.kind != SurfaceProblem::Kind::SeveralParts;
}

}  // namespace

bool PrintCheck::is_watertight() const {
    return std::ranges::none_of(problems, is_leak);
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
    const auto across = facing_walls(surface, search, FacingSide::Lumen);
    if (!across.empty()) check.lumen = places_of(surface, across.front());
    for (const FacingWall& facing : facing_walls(surface, search, FacingSide::Outside)) {
        progress.check_cancelled();
        if (is_fold(surface, facing)) continue;
        check.gap = places_of(surface, facing);
        break;
    }
    return check;
}

std::vector<FacingPlaces> narrow_gaps(const Surface& surface, double width,
                                      const Progress& progress) {
    require_positive("width", width);
    std::vector<FacingWall> narrow;
    std::vector<std::uint8_t> is_narrow(surface.vertex_count(), 0);
    for (const FacingWall& facing :
         facing_walls(surface, distance_to(surface), FacingSide::Outside, width)) {
        progress.check_cancelled();
        if (is_fold(surface, facing)) continue;
        narrow.push_back(facing);
        is_narrow[facing.from] = 1;
    }
    DisjointSets sets(surface.vertex_count());
    for (const FacingWall& facing : narrow) {
        for (const VertexId u : surface.topology->rings().row(facing.from))
            if (is_narrow[u] != 0) sets.join(facing.from, u);
        for (const VertexId u : surface.triangles()[facing.triangle]) sets.join(facing.from, u);
    }
    std::vector<FacingPlaces> gaps;
    std::set<VertexId> seen;
    for (const FacingWall& facing : narrow)  // nearest first
        if (seen.insert(sets.root(facing.from)).second) gaps.push_back(places_of(surface, facing));
    return gaps;
}

}  // namespace vesselbench
