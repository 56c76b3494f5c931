#include "meshing/stamp/stamp.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include "geometry/editing/local_part.h"
#include "geometry/kernel/argument_checks.h"
#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/measure.h"
#include "geometry/kernel/self_intersections.h"
#include "geometry/kernel/wording.h"
#include "meshing/remeshing/local_remesh.h"
#include "meshing/remeshing/sizing_field.h"
#include "meshing/stamp/refusal.h"

namespace vesselbench {

namespace {

constexpr double kThinnest = 0.5;    ///< of the mean edge: triangles cannot follow a thinner tool
constexpr double kMostVolume = 0.5;  ///< of the vessel: more is a mistake
constexpr double kRoom = 2.0;        ///< edges beyond the influence: fixed triangles to sew to
constexpr int kAttempts = 3;         ///< each moves a tool that touches the wall degenerately
constexpr double kNudge = 1e-4;      ///< of the mean edge, per attempt
constexpr double kGradation = 1.5;   ///< as remesh() has by default [-]
constexpr int kContinuity = 1;       ///< of the faired seam

const std::vector<Remedy>& another_place() {
    static const std::vector<Remedy> remedies = {{.arguments = {{"centre", ""}}}};
    return remedies;
}

/// The wall that a tool reaches.
class Reach {
public:
    Reach(const Surface& surface, const SurfaceDistance& places, const ToolBody& tool)
        : surface_(surface),
          tool_(tool),
          body_(tool.surface),
          near_(places.triangles_within(tool.centre, tool.reach)) {
        double sum = 0.0, count = 0.0;
        for (const TriangleId t : near_) {
            if (!may_meet(t, 0.0)) continue;
            const auto& [a, b, c] = surface.triangles()[t];
            const Positions& p = surface.points();
            sum += (p[a] - p[b]).norm() + (p[b] - p[c]).norm() + (p[c] - p[a]).norm();
            count += 3.0;
        }
        edge_ = count > 0.0 ? sum / count : 0.0;
    }

    /// Mean edge of the triangles that may meet the tool [mm]; 0: there is none.
    [[nodiscard]] double edge() const { return edge_; }

    /// Distance to the tool's surface [mm], negative inside.
    [[nodiscard]] double distance(const Vec3& p) const { return body_.signed_distance(p); }

    [[nodiscard]] const SurfaceDistance& body() const { return body_; }

    /// 1 at the triangles within a margin [mm] of the tool, or inside it, #T.
    [[nodiscard]] std::vector<std::uint8_t> marked(const SurfaceDistance& places,
                                                   double margin) const {
        std::vector<std::uint8_t> marked(surface_.triangle_count(), 0);
        for (const TriangleId t : places.triangles_within(tool_.centre, tool_.reach + margin))
            if (may_meet(t, margin)) marked[t] = 1;
        return marked;
    }

    /// The first triangle of an opening that the tool meets.
    [[nodiscard]] std::optional<TriangleId> opening_met() const {
        const auto in_tool = static_cast<TriangleId>(tool_.surface.triangle_count());
        std::vector<TriangleId> caps;
        for (const TriangleId t : near_)
            if (surface_.patch_of(t).kind != PatchKind::Wall && may_meet(t, 0.0)) caps.push_back(t);
        Positions points = tool_.surface.points();
        const auto first = static_cast<VertexId>(points.size());
        points.insert(points.end(), surface_.points().begin(), surface_.points().end());
        std::vector<Triangle> triangles(tool_.surface.triangles().begin(),
                                        tool_.surface.triangles().end());
        for (const TriangleId t : caps) {
            const auto& [a, b, c] = surface_.triangles()[t];
            if (distance(surface_.points()[a]) < 0.0) return t;
            triangles.push_back({first + a, first + b, first + c});
        }
        for (const auto& [low, high] : self_intersections(points, triangles))
            if (low < in_tool && high >= in_tool) return caps[high - in_tool];
        return std::nullopt;
    }

private:
    /// False only if the triangle is farther from the tool than the margin [mm].
    [[nodiscard]] bool may_meet(TriangleId t, double margin) const {
        const auto& [a, b, c] = surface_.triangles()[t];
        const Positions& p = surface_.points();
        const double longest = longest_edge(p[a], p[b], p[c]);
        return std::ranges::any_of(surface_.triangles()[t],
                                   [&](VertexId v) { return distance(p[v]) <= margin + longest; });
    }

    const Surface& surface_;
    const ToolBody& tool_;
    SurfaceDistance body_;
    std::vector<TriangleId> near_;
    double edge_ = 0.0;
};

/// The tool a little aside, where an earlier attempt met the wall degenerately.
Surface nudged(const ToolBody& tool, double edge, int attempt) {
    if (attempt == 0) return tool.surface;
    const Vec3 aside = kNudge * edge * attempt * Vec3(0.71, -0.53, 0.46);
    Positions points = tool.surface.points();
    for (Vec3& p : points) p += aside;
    return tool.surface.with_positions(std::move(points));
}

/// The part with a patch before its own: corefined() gives it to the tool's triangles, whose seam
/// is then a rim that remeshing keeps.
Surface with_tool_patch(const Surface& part) {
    PatchLabels labels = *part.patch_labels;
    for (std::uint16_t& label : labels) ++label;
    std::vector<Patch> patches = part.patches;
    patches.insert(patches.begin(), {"tool", PatchKind::Wall});
    return part.with_patches(std::move(labels), std::move(patches));
}

/// The tool's triangles become wall.
Surface without_tool_patch(const Surface& surface) {
    PatchLabels labels = *surface.patch_labels;
    for (std::uint16_t& label : labels) label -= label > 0 ? 1 : 0;
    return surface.with_patches(std::move(labels),
                                {surface.patches.begin() + 1, surface.patches.end()});
}

Corefined cut(const Surface& part, const ToolBody& tool, const SurfaceDistance& places,
              StampMode mode, double edge) {
    CorefinementProblem problem{};
    for (int attempt = 0; attempt < kAttempts; ++attempt) {
        auto both = corefined(
            part, nudged(tool, edge, attempt), mode,
            [&](const Vec3& p) { return places.inside(p); }, problem);
        if (both && connectivity(*both->surface.topology).manifold) return std::move(*both);
        if (problem != CorefinementProblem::Degenerate) break;
    }
    switch (problem) {
        case CorefinementProblem::Apart:
            refuse("stamp-touches-nothing", "stamp", tool.centre, {}, another_place());
        case CorefinementProblem::Swallowed:
            refuse("stamp-swallows", "stamp", tool.centre, {}, another_place());
        default:
            refuse("stamp-degenerate", "stamp", tool.centre, {}, another_place());
    }
}

/// Vertices that may move: new ones, and those of the wall within the influence.
std::vector<std::uint8_t> anchored_vertices(const Corefined& both, const LocalPart& part,
                                            const Reach& reach, double influence) {
    std::vector<std::uint8_t> anchored(both.former.size(), 0);
    for (VertexId v = 0; v < anchored.size(); ++v)
        if (both.former[v] != kNewVertex &&
            (part.rim[both.former[v]] ||
             std::abs(reach.distance(both.surface.points()[v])) > influence))
            anchored[v] = 1;
    for (TriangleId t = 0; t < both.surface.triangle_count(); ++t)
        if (both.surface.patch_of(t).kind != PatchKind::Wall)
            for (const VertexId v : both.surface.triangles()[t])
                anchored[v] = both.former[v] != kNewVertex ? 1 : 0;
    return anchored;
}

std::vector<double> sizes_of(const Corefined& both, const Surface& part, double edge) {
    const std::vector<double> present = mean_edges(part);
    std::vector<double> sizes;
    for (const VertexId v : both.former) sizes.push_back(v == kNewVertex ? edge : present[v]);
    limit_slope(both.surface, slope_of(kGradation), sizes);
    return sizes;
}

/// 1 at the vertices of caps and openings, which stay flat.
std::vector<std::uint8_t> at_caps(const Surface& surface) {
    std::vector<std::uint8_t> caps(surface.vertex_count(), 0);
    for (TriangleId t = 0; t < surface.triangle_count(); ++t)
        if (surface.patch_of(t).kind != PatchKind::Wall)
            for (const VertexId v : surface.triangles()[t]) caps[v] = 1;
    return caps;
}

/// Vertices near the seam that may move, and whose neighbours are all part of the piece.
std::vector<VertexId> fairing_zone(const EditedPart& piece, const Corefined& both, double blend) {
    std::vector<Triangle> segments;
    for (const auto& [a, b] : both.seam) segments.push_back({a, b, b});
    const SurfaceDistance seam(both.surface.points(), segments);
    const std::vector<std::uint8_t>& border = piece.surface.topology->boundary_vertices();
    const std::vector<std::uint8_t> caps = at_caps(piece.surface);
    std::vector<VertexId> zone;
    for (VertexId v = 0; v < piece.former.size(); ++v)
        if (piece.former[v] == kNewVertex && !border[v] && !caps[v] &&
            seam.closest_point(piece.surface.points()[v], blend))
            zone.push_back(v);
    return zone;
}

/// Fairs the seam; what would enter the tool stays on its surface.
void fair_seam(EditedPart& piece, const Corefined& both, const Reach& reach, double blend,
               const ToolBody& tool) {
    const std::vector<VertexId> zone = fairing_zone(piece, both, blend);
    if (zone.empty()) return;
    auto moved = faired(piece.surface, zone, kContinuity);
    if (!moved)
        refuse("stamp-degenerate", "stamp", tool.centre, {}, {{.arguments = {{"blend", ""}}}});
    for (const VertexId v : zone)
        if (reach.distance((*moved)[v]) < 0.0)
            (*moved)[v] = reach.body().closest_point((*moved)[v]).point;
    piece.surface = piece.surface.with_positions(std::move(*moved));
}

/// \throw AlgorithmFailure unless the result is as sound as the surface was
void require_sound(const Surface& before, const Surface& after, const StampReport& report,
                   const ToolBody& tool, const Progress& progress) {
    const Connectivity was = connectivity(*before.topology), is = connectivity(*after.topology);
    if (is.boundary_loops != was.boundary_loops || (was.manifold && !is.manifold) ||
        (was.oriented && !is.oriented))
        refuse("stamp-degenerate", "stamp", tool.centre, {}, another_place());
    std::vector<std::uint8_t> changed(after.triangle_count(), 0);
    std::fill(changed.end() - static_cast<std::ptrdiff_t>(report.replacement), changed.end(), 1);
    if (const auto crossing = crossing_of(after, changed, progress))
        refuse("stamp-crosses", "stamp", *crossing, {},
               {{.arguments = {{"blend", ""}}}, {.operation = "repair"}});
}

void measure_change(const Surface& before, const Surface& after, const ToolBody& tool,
                    StampReport& report) {
    const Connectivity was = connectivity(*before.topology), is = connectivity(*after.topology);
    report.components_before = was.components;
    report.components_after = is.components;
    report.genus_before = was.genus.value_or(0);
    report.genus_after = is.genus.value_or(0);
    const double volume_before = volume(before);
    report.volume_change = volume(after) - volume_before;
    const double share = std::abs(report.volume_change) / std::max(std::abs(volume_before), 1e-300);
    if (share > kMostVolume)
        refuse("stamp-swallows", "stamp", tool.centre, {{"volume_percent", 100.0 * share}},
               another_place());
}

void check_tool(const Reach& reach, const ToolBody& tool, const Surface& surface) {
    if (reach.edge() == 0.0)
        refuse("stamp-touches-nothing", "stamp", tool.centre, {}, another_place());
    if (tool.thickness < kThinnest * reach.edge()) {
        const Vec3& at = tool.centre;
        refuse("stamp-too-thin", "stamp", at,
               {{"thickness_mm", tool.thickness}, {"edge_mm", reach.edge()}},
               {{.operation = "remesh",
                 .arguments = {{"at", formatted(at.x(), "%.2f,") + formatted(at.y(), "%.2f,") +
                                          formatted(at.z(), "%.2f")},
                               {"within", formatted(tool.reach, "%.2g")},
                               {"edge", formatted(tool.thickness, "%.2g")}},
                 .before = true}});
    }
    if (const auto cap = reach.opening_met())
        throw DiagnosedFailure({.code = "stamp-cuts-opening",
                                .operation = "stamp",
                                .place = tool.centre,
                                .words = {{"opening", surface.patch_of(*cap).name}},
                                .remedies = another_place()});
}

}  // namespace

double mean_edge_at(const Surface& surface, const SurfaceDistance& places, const ToolBody& tool) {
    return Reach(surface, places, tool).edge();
}

Stamped stamp(const Surface& surface, const SurfaceDistance& places, const ToolBody& tool,
              const StampParameters& parameters, const Progress& progress) {
    require_range("blend", parameters.blend, 0.0, 1e6);
    require_in_proportion("blend", parameters.blend, surface, 0.5);
    progress.report(0.0, "cutting the wall");
    const Reach reach(surface, places, tool);
    check_tool(reach, tool, surface);
    StampReport report{.edge = std::min(reach.edge(), tool.detail)};
    report.influence = std::max(parameters.blend, reach.edge());
    std::vector<std::uint8_t> marked =
        reach.marked(places, report.influence + kRoom * reach.edge());
    close_fans(surface, marked);
    report.replaced = static_cast<std::size_t>(std::ranges::count(marked, 1));
    const LocalPart part = part_of(surface, marked);
    const Corefined both =
        cut(with_tool_patch(part.surface), tool, places, parameters.mode, reach.edge());
    EditedPart piece = remesh_part(both.surface, sizes_of(both, part.surface, report.edge),
                                   anchored_vertices(both, part, reach, report.influence),
                                   progress.part(0.2, 0.7));
    piece.surface = without_tool_patch(piece.surface);
    for (VertexId& v : piece.former)
        if (v != kNewVertex) v = both.former[v];
    progress.report(0.7, "fairing the seam");
    if (parameters.blend > 0.0) fair_seam(piece, both, reach, parameters.blend, tool);
    report.replacement = piece.surface.triangle_count();
    Stamped result{sewn(surface, marked, part, piece), report};
    progress.report(0.8, "looking for crossings");
    require_sound(surface, result.surface, result.report, tool, progress.part(0.8, 1.0));
    measure_change(surface, result.surface, tool, result.report);
    return result;
}

}  // namespace vesselbench
