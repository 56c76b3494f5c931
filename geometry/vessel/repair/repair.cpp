#include "geometry/vessel/repair/repair.h"

#include <algorithm>

#include "geometry/editing/triangle_soup.h"
#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/edges.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/finite_positions.h"
#include "geometry/kernel/measure.h"
#include "geometry/vessel/repair/sheets.h"
#include "geometry/vessel/repair/slivers.h"
#include "geometry/vessel/repair/soup.h"
#include "geometry/vessel/repair/stray_holes.h"
#include "geometry/vessel/repair/untangle.h"

namespace vesselbench {

namespace {

constexpr int kMostClosings = 5;  ///< closing holes at a shared vertex may reveal others

/// Fraction of the area [-] that untangling may cost before it counts as damage.
constexpr double kMostLost = 0.05;

void check_input(const Surface& surface) {
    if (surface.empty()) throw InvalidInput("the surface has no triangles");
    require_near(surface.points());
}

/// Manifold, one component, stray holes closed.
void restore_manifold(TriangleSoup& mesh, const RepairParameters& parameters,
                      RepairReport& report) {
    make_manifold(mesh, false, report);
    keep_largest_components(mesh, parameters, report);
    face_outward(mesh, report);
    // The inner side of a wall faces its cavity: that is no fault of the surface.
    if (report.removed_outer_wall) report.turned_inside_out = false;
    for (int closing = 0; closing < kMostClosings; ++closing) {
        if (!close_stray_holes(mesh, parameters, report)) break;
        make_manifold(mesh, false, report);
    }
    make_manifold(mesh, true, report);
    keep_largest_components(mesh, parameters, report);
    remove_degenerate_and_duplicate(mesh, report);
    std::fill(mesh.marks.begin(), mesh.marks.end(), std::uint8_t{0});
    remove_slivers(mesh, parameters.smallest_feature, report);
}

void note_intersections(const TriangleSoup& mesh, const std::vector<TrianglePair>& pairs,
                        RepairReport& report) {
    report.self_intersections = pairs.size();
    for (const auto& [a, b] : pairs)
        report.places.push_back(
            {RepairKind::SelfIntersection, centroid(mesh, mesh.triangles[a]), 0.0});
}

[[noreturn]] void fail_tangled(const TriangleSoup& mesh, const std::vector<TrianglePair>& pairs) {
    throw DiagnosedFailure(
        {.code = "self-intersections-left",
         .place = centroid(mesh, mesh.triangles[pairs.front().first]),
         .figures = {{"self_intersections", static_cast<double>(pairs.size())}},
         .remedies = {{.operation = "remove-branch"}, {.operation = "clip-opening"}}});
}

/// Bodies that pass through each other fall apart when the intersection is cut out: never silently.
void check_nothing_lost(const TriangleSoup& mesh, double area_before, const Vec3& place) {
    const double lost = 1.0 - area_of(mesh) / area_before;
    if (lost > kMostLost)
        throw DiagnosedFailure({.code = "parts-pass-through-each-other",
                                .place = place,
                                .figures = {{"area_percent", 100.0 * lost}}});
}

void untangle_all(TriangleSoup& mesh, const RepairParameters& parameters, const Progress& progress,
                  RepairReport& report) {
    const double area_before = area_of(mesh);
    auto pairs = self_intersections(mesh.points, mesh.triangles, progress.part(0.0, 0.5));
    note_intersections(mesh, pairs, report);
    for (int attempt = 0; !pairs.empty(); ++attempt) {
        if (attempt == kUntangleAttempts) fail_tangled(mesh, pairs);
        progress.report(0.5 + 0.5 * attempt / kUntangleAttempts, "removing self-intersections");
        const Vec3 place = centroid(mesh, mesh.triangles[pairs.front().first]);
        const Regions regions = untangle(mesh, pairs, attempt, report);
        restore_manifold(mesh, parameters, report);
        check_nothing_lost(mesh, area_before, place);
        pairs = self_intersections_in(mesh, regions, progress);
        if (pairs.empty()) pairs = self_intersections(mesh.points, mesh.triangles, progress);
    }
}

void check_result(const TriangleSoup& mesh) {
    const ManifoldDefects defects = manifold_defects(Topology(mesh.triangles, mesh.points.size()));
    if (defects.none()) return;
    const VertexId at = !defects.edges.empty()      ? defects.edges[0][0]
                        : !defects.vertices.empty() ? defects.vertices[0]
                        : !defects.inconsistent_edges.empty()
                            ? defects.inconsistent_edges[0][0]
                            : mesh.triangles[defects.degenerate[0]][0];
    throw DiagnosedFailure(
        {.code = "still-not-manifold",
         .place = mesh.points[at],
         .remedies = {{.operation = "remove-branch"}, {.operation = "clip-opening"}}});
}

}  // namespace

Repaired repair(const Surface& surface, const RepairParameters& parameters,
                const Progress& progress) {
    check_input(surface);
    RepairReport report;
    TriangleSoup mesh = soup_from(surface);
    progress.report(0.0, "welding");
    weld(mesh, parameters.smallest_feature * mean_side(mesh), report);
    remove_degenerate_and_duplicate(mesh, report);
    if (mesh.triangles.empty()) throw DiagnosedInput({.code = "no-triangle-left"});
    progress.report(0.2, "repairing connectivity");
    restore_manifold(mesh, parameters, report);
    if (mesh.triangles.empty()) throw DiagnosedInput({.code = "no-triangle-left"});
    if (parameters.remove_self_intersections)
        untangle_all(mesh, parameters, progress.part(0.4, 1.0), report);
    report.unused_vertices = mesh.remove_unused_vertices();
    check_result(mesh);
    progress.report(1.0, "repaired");
    if (!report.changed()) return {surface, std::move(report)};
    return {surface_from(std::move(mesh)), std::move(report)};
}

}  // namespace vesselbench
