#include "geometry/vessel/ends/stub_lines.h"

#include <algorithm>
#include <limits>

#include "geometry/vessel/centerlines/branch_queries.h"
#include "geometry/vessel/centerlines/centerlines.h"

namespace vesselbench {

namespace {

/// A point this far from a stub's tip does not mean it [lengths of the stub].
constexpr double kFarthest = 2.0;

}  // namespace

std::vector<Stub> stubs_apart(const std::vector<Stub>& stubs, const CenterlineGraph& graph,
                              const std::vector<SurfaceEnd>& ends) {
    std::vector<Stub> apart;
    for (const Stub& stub : stubs)
        if (std::ranges::none_of(ends, [&](const SurfaceEnd& end) {
                return is_corner_of(end, graph, stub.tip, stub.widest);
            }))
            apart.push_back(stub);
    return apart;
}

LinesAndStubs lines_to_ends(const Surface& surface, const Positions& points,
                            const Progress& progress) {
    LinesAndStubs lines{centerlines_of(surface, {}, progress), *stubs_of(surface)};
    Positions ends;
    for (const Vec3& point : points) {
        const auto tip = nearest_tip(*lines.graph, point);
        const double beside = tip ? (lines.graph->nodes[*tip].position - point).norm()
                                  : std::numeric_limits<double>::infinity();
        const auto stub = std::ranges::find_if(lines.stubs, [&](const Stub& s) {
            const double distance = (s.tip - point).norm();
            return distance < beside && distance <= kFarthest * std::max(s.length, s.widest);
        });
        if (stub == lines.stubs.end()) continue;
        ends.push_back(stub->tip);
        lines.stubs.erase(stub);
    }
    if (!ends.empty()) lines.graph = centerlines_of(surface, {.ends = ends}, progress);
    return lines;
}

}  // namespace vesselbench
