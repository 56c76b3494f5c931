#include "geometry/vessel/openings/clip.h"

#include <utility>

#include "geometry/editing/plane_cut.h"
#include "geometry/editing/rims.h"
#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/wording.h"

namespace vesselbench {

OpenedSurface cut_branch(const Surface& surface, const Plane& plane) {
    auto curve = cross_section_at(surface, plane);
    if (!curve)
        throw DiagnosedFailure({.code = "plane-misses-surface",
                                .operation = "clip-opening",
                                .place = plane.point,
                                .remedies = {{.arguments = {{"tip", ""}}}}});
    if (!curve->closed)
        throw DiagnosedFailure(
            {.code = "plane-meets-border", .operation = "clip-opening", .place = plane.point});
    // Moving vertices may pinch the rim on a bad mesh; cutting without moving never does.
    bool separates = true;
    for (const NearVertices near : {NearVertices::MoveOntoPlane, NearVertices::Stay}) {
        OpenedSurface opened{EditableSurface(surface), {}};
        PlaneCut cut = cut_along(opened.surface, plane, *curve, near);
        if (cut.rim.empty()) continue;
        const auto branch = part_above(opened.surface, cut);
        separates = branch.has_value();
        if (!separates) continue;
        opened.surface.remove(*branch);
        opened.rim = std::move(cut.rim);
        clean_rim(opened.surface, opened.rim);
        return opened;
    }
    if (!separates)
        throw DiagnosedFailure(
            {.code = "cut-in-loop", .operation = "clip-opening", .place = plane.point});
    throw DiagnosedFailure({.code = "cut-without-rim",
                            .operation = "clip-opening",
                            .place = plane.point,
                            .remedies = {{.operation = "repair"}}});
}

void cap_rim(OpenedSurface& opened, const Plane& plane, const Patch& patch) {
    // The cap's half-edges are opposite to the wall's.
    const std::vector<VertexId> rim(opened.rim.rbegin(), opened.rim.rend());
    for (const VertexId v : rim) opened.surface.move(v, plane.projected(opened.surface.point(v)));
    const std::uint16_t label = opened.surface.add_patch(patch);
    close_flat(opened.surface, rim, plane, mean_edge(opened.surface, rim), label);
}

Surface clip_branch(const Surface& surface, const Plane& plane, const Patch& patch) {
    OpenedSurface opened = cut_branch(surface, plane);
    cap_rim(opened, plane, patch);
    return opened.surface.to_surface();
}

}  // namespace vesselbench
