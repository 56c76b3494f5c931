#include "workbench/session/source_counterpart.h"

#include <algorithm>

#include "geometry/kernel/measure.h"
#include "workbench/case/measure_json.h"

namespace vesselbench {

namespace {

/// How far inward of an end the surface may intentionally differ from the source [diameters].
constexpr double kInward = 0.5;
/// How far to the side the end's own vessel extends [diameters].
constexpr double kSideward = 1.5;

void add_ends(const Surface& surface, std::vector<MadeEnd>& ends) {
    for (const PatchMeasures& patch : measure_patches(surface))
        if (patch.kind != PatchKind::Wall)
            ends.push_back({patch.centroid, patch.normal, diameter_of_area(patch.area)});
}

bool near_an_end(const Vec3& p, const std::vector<MadeEnd>& ends) {
    return std::ranges::any_of(ends, [&](const MadeEnd& end) {
        const double along = (p - end.centre).dot(end.outward);
        const double aside = ((p - end.centre) - along * end.outward).norm();
        return along > -kInward * end.diameter && aside < kSideward * end.diameter;
    });
}

}  // namespace

std::vector<MadeEnd> made_ends(Session& session, const std::string& variant,
                               const Progress& progress) {
    std::vector<MadeEnd> ends;
    for (const LogEntry& entry : session.log(variant)) {
        if (entry.edit.place.step != Step::Openings || entry.status != EditStatus::Done) continue;
        const Scene scene = session.scene_after(entry.edit.edit.id, progress);
        if (scene.surface) add_ends(*scene.surface, ends);
    }
    return ends;
}

std::vector<std::uint8_t> comparable_vertices(const Surface& surface,
                                              const std::vector<MadeEnd>& ends) {
    std::vector<std::uint8_t> flags(surface.vertex_count(), 0);
    for (TriangleId t = 0; t < surface.triangle_count(); ++t)
        if (surface.patch_of(t).kind == PatchKind::Wall)
            for (const VertexId v : surface.triangles()[t]) flags[v] = 1;
    for (VertexId v = 0; v < surface.vertex_count(); ++v)
        if (flags[v] && near_an_end(surface.points()[v], ends)) flags[v] = 0;
    return flags;
}

Positions comparable_points(const Surface& surface, const std::vector<std::uint8_t>& comparable) {
    Positions points;
    for (VertexId v = 0; v < surface.vertex_count(); ++v)
        if (comparable[v]) points.push_back(surface.points()[v]);
    return points;
}

}  // namespace vesselbench
