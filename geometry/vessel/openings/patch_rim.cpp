#include "geometry/vessel/openings/patch_rim.h"

#include <algorithm>
#include <map>

#include "geometry/kernel/diagnosed_error.h"
#include "geometry/vessel/ends/patch_shape.h"

namespace vesselbench {

namespace {

[[noreturn]] void fail(const Surface& surface, std::size_t patch) {
    throw DiagnosedFailure({.code = "cap-not-a-disc",
                            .place = patch_shape(surface, patch).plane.point,
                            .words = {{"cap", surface.patches.at(patch).name}}});
}

}  // namespace

PatchRim patch_rim(const Surface& surface, std::size_t patch) {
    std::map<VertexId, VertexId> next;
    PatchRim rim;
    const auto triangles = surface.triangles();
    const auto& labels = *surface.patch_labels;
    for (TriangleId t = 0; t < triangles.size(); ++t) {
        if (labels[t] != patch) continue;
        for (int k = 0; k < 3; ++k) {
            const VertexId a = triangles[t][k], b = triangles[t][(k + 1) % 3];
            bool inner = false;
            for (const TriangleId other : surface.topology->triangles_at().row(a)) {
                const Triangle& c = triangles[other];
                if (other == t || std::find(c.begin(), c.end(), b) == c.end()) continue;
                if (labels[other] == patch)
                    inner = true;
                else
                    rim.wall_label = labels[other];
            }
            if (!inner && !next.emplace(a, b).second) fail(surface, patch);
        }
    }
    if (next.size() < 3) fail(surface, patch);
    rim.loop.push_back(next.begin()->first);
    for (auto at = next.find(next.begin()->second);
         at != next.end() && at->first != rim.loop.front(); at = next.find(at->second)) {
        rim.loop.push_back(at->first);
        if (rim.loop.size() > next.size()) fail(surface, patch);
    }
    if (rim.loop.size() != next.size()) fail(surface, patch);
    return rim;
}

}  // namespace vesselbench
