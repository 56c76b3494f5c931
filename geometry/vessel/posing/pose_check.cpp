#include "geometry/vessel/posing/pose_check.h"

#include <algorithm>
#include <vector>

#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/self_intersections.h"

namespace vesselbench {

void require_gentle(const Armature& armature, std::span<const RodPose> poses) {
    if (const auto bend = too_sharp(armature, poses, kLeastBend))
        throw DiagnosedFailure({.code = "bend-too-strong",
                                .place = bend->place,
                                .figures = {{"bend_mm", bend->radius},
                                            {"least_mm", kLeastBend * bend->vessel},
                                            {"radii", kLeastBend}},
                                .remedies = {{.arguments = {{"reach", ""}}}}});
}

void require_no_crossing(const Surface& before, const Positions& moved, const Progress& progress) {
    std::vector<std::uint8_t> touched(before.triangle_count(), 0);
    for (TriangleId t = 0; t < touched.size(); ++t)
        for (const VertexId v : before.triangles()[t])
            if (moved[v] != before.points()[v]) touched[t] = 1;
    const auto old =
        self_intersections_with(before.points(), before.triangles(), touched, progress);
    for (const TrianglePair& pair :
         self_intersections_with(moved, before.triangles(), touched, progress))
        if (!std::ranges::binary_search(old, pair))
            throw DiagnosedFailure({.code = "posing-crosses-walls",
                                    .place = moved[before.triangles()[pair.first][0]]});
}

void throw_stiff(const StiffBranch& branch) {
    throw DiagnosedFailure(
        {.code = branch.code, .place = branch.place, .figures = {{"length_mm", branch.length}}});
}

}  // namespace vesselbench
