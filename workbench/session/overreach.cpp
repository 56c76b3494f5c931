#include "workbench/session/overreach.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "geometry/kernel/derived_cache.h"
#include "geometry/kernel/measure.h"
#include "geometry/kernel/self_intersections.h"
#include "workbench/session/changed_wall.h"
#include "workbench/session/lost_wall.h"

namespace vesselbench {

namespace {

using Finding = std::optional<Diagnostic>;

Diagnostic error(const char* code, std::optional<Vec3> place,
                 std::map<std::string, double> figures) {
    return {.code = code,
            .severity = Severity::Error,
            .place = std::move(place),
            .figures = std::move(figures)};
}

/// Of a topology; that after one edit is that before the next.
Connectivity connectivity_of(const Topology& topology) {
    return *derived_cache().find_or_make<Connectivity>(
        "connectivity", topology.key(), [&] { return connectivity(topology); },
        [](const Connectivity& made) { return sizeof made; });
}

Finding growth_beyond(const AllowedGrowth& allowed, const char* code, std::int64_t before,
                      std::int64_t after) {
    const std::int64_t growth = after - before;
    if (growth >= allowed.least && growth <= allowed.most) return std::nullopt;
    return error(code, {},
                 {{"before", static_cast<double>(before)}, {"after", static_cast<double>(after)}});
}

Finding topology_beyond(const StatedChange& stated, const Surface& before, const Surface& after) {
    if (same_triangles(before, after)) return std::nullopt;
    if (stated.keeps_triangles)
        return error("edit-changes-triangles", {},
                     {{"before", static_cast<double>(before.triangle_count())},
                      {"after", static_cast<double>(after.triangle_count())}});
    const Connectivity was = connectivity_of(*before.topology),
                       is = connectivity_of(*after.topology);
    const auto number = [](std::size_t count) { return static_cast<std::int64_t>(count); };
    if (auto found = growth_beyond(stated.parts, "edit-changes-parts", number(was.components),
                                   number(is.components)))
        return found;
    if (auto found = growth_beyond(stated.rims, "edit-changes-rims", number(was.boundary_loops),
                                   number(is.boundary_loops)))
        return found;
    if (!was.genus || !is.genus) return std::nullopt;  // of what is no manifold, none is known
    return growth_beyond(stated.handles, "edit-changes-handles", *was.genus, *is.genus);
}

Finding zone_beyond(const StatedChange& stated, const Surface& before, const Surface& after) {
    if (!stated.zones) return std::nullopt;
    const auto place = change_outside(before, after, *stated.zones);
    if (!place) return std::nullopt;
    return error("edit-leaves-zone", place, {});
}

Finding volume_beyond(const StatedChange& stated, const Surface& before, const Surface& after) {
    if (std::isinf(stated.volume_lost) && std::isinf(stated.volume_gained)) return std::nullopt;
    const double was = volume(before), is = volume(after);
    if (is - was <= stated.volume_gained && was - is <= stated.volume_lost) return std::nullopt;
    return error("edit-changes-volume", {},
                 {{"before_mm3", was},
                  {"after_mm3", is},
                  {"stated_mm3", is > was ? stated.volume_gained : stated.volume_lost}});
}

Finding wall_beyond(const StatedChange& stated, const Surface& before, const Surface& after,
                    const Progress& progress) {
    const auto lost = lost_wall(stated, before, after, progress);
    if (!lost) return std::nullopt;
    return error("edit-loses-wall", lost->place,
                 {{"distance_mm", lost->distance}, {"stated_mm", lost->stated}});
}

/// Triangles of the surface whose boxes meet that of the flagged ones, with the flags.
struct Nearby {
    std::vector<Triangle> triangles;
    std::vector<std::uint8_t> flagged;
};

Nearby near_flagged(const Surface& surface, const std::vector<std::uint8_t>& flagged) {
    Positions corners;
    for (const VertexId v : corners_of(surface, flagged)) corners.push_back(surface.points()[v]);
    Nearby near;
    if (corners.empty()) return near;
    const Bounds box = bounds(corners);
    for (TriangleId t = 0; t < flagged.size(); ++t) {
        if (!meets(surface, t, box)) continue;
        near.triangles.push_back(surface.triangles()[t]);
        near.flagged.push_back(flagged[t]);
    }
    return near;
}

struct Crossings {
    std::size_t pairs = 0;
    Vec3 first = Vec3::Zero();  ///< [mm]
};

Crossings crossings_of(const Surface& surface, const std::vector<std::uint8_t>& flagged,
                       const Progress& progress) {
    const Nearby near = near_flagged(surface, flagged);
    const auto pairs =
        self_intersections_with(surface.points(), near.triangles, near.flagged, progress);
    if (pairs.empty()) return {};
    return {pairs.size(), surface.points()[near.triangles[pairs.front().first][0]]};
}

Finding crossings_beyond(const StatedChange& stated, const Surface& before, const Surface& after,
                         const Progress& progress) {
    if (!stated.keeps_walls_apart) return std::nullopt;
    const Crossings now =
        crossings_of(after, triangles_missing_in(before, after, stated.zones), progress);
    if (now.pairs == 0) return std::nullopt;
    const Crossings old =
        crossings_of(before, triangles_missing_in(after, before, stated.zones), progress);
    if (now.pairs <= old.pairs) return std::nullopt;
    return error(
        "edit-crosses-walls", now.first,
        {{"before", static_cast<double>(old.pairs)}, {"after", static_cast<double>(now.pairs)}});
}

constexpr double kFold = 0.0;         ///< cosine between the triangles at a folded edge
constexpr std::size_t kFewFolds = 5;  ///< a few are no rubble

/// The triangle on the other side of the edge from a to b; none: it is no inner edge.
std::optional<TriangleId> across(const Surface& surface, TriangleId t, VertexId a, VertexId b) {
    for (const TriangleId other : surface.topology->triangles_at().row(a))
        if (other != t && std::ranges::count(surface.triangles()[other], b) > 0) return other;
    return std::nullopt;
}

bool is_folded(const Surface& surface, TriangleId s, TriangleId t) {
    const Vec3 one = area_normal(surface.points(), surface.triangles()[s]),
               other = area_normal(surface.points(), surface.triangles()[t]);
    return one.dot(other) < kFold * one.norm() * other.norm();
}

Finding folds_beyond(const StatedChange& stated, const Surface& before, const Surface& after) {
    if (stated.folded >= 1.0 || !same_triangles(before, after)) return std::nullopt;
    std::size_t edges = 0, folded = 0;
    Vec3 place = Vec3::Zero();
    const auto moved = [&](VertexId v) { return before.points()[v] != after.points()[v]; };
    for (TriangleId t = 0; t < after.triangle_count(); ++t) {
        const Triangle& corners = after.triangles()[t];
        if (std::ranges::none_of(corners, moved)) continue;
        for (std::size_t k = 0; k < 3; ++k) {
            const VertexId a = corners[k], b = corners[(k + 1) % 3];
            const auto other = across(after, t, a, b);
            if (!other) continue;
            ++edges;
            if (!is_folded(after, t, *other) || is_folded(before, t, *other)) continue;
            if (folded++ == 0) place = after.points()[a];
        }
    }
    // Most edges are met from both sides.
    if (folded <= 2 * kFewFolds ||
        static_cast<double>(folded) <= stated.folded * static_cast<double>(edges))
        return std::nullopt;
    return error(
        "edit-folds-wall", place,
        {{"edges", std::floor(0.5 * static_cast<double>(folded))},
         {"share_percent", 100.0 * static_cast<double>(folded) / static_cast<double>(edges)}});
}

Finding beyond(const StatedChange& stated, const Surface& before, const Surface& after,
               const Progress& progress) {
    if (auto found = topology_beyond(stated, before, after)) return found;
    progress.check_cancelled();
    if (auto found = zone_beyond(stated, before, after)) return found;
    if (auto found = volume_beyond(stated, before, after)) return found;
    if (auto found = wall_beyond(stated, before, after, progress)) return found;
    if (auto found = folds_beyond(stated, before, after)) return found;
    progress.check_cancelled();
    return crossings_beyond(stated, before, after, progress);
}

bool has_surface(const Scene& scene) {
    return scene.surface && !scene.surface->empty();
}

}  // namespace

std::optional<Diagnostic> overreach(const StatedChange& stated, const Scene& before,
                                    const Scene& after, const Progress& progress) {
    if (stated.doubt) {
        Diagnostic doubt = *stated.doubt;
        doubt.severity = Severity::Error;
        return doubt;
    }
    if (!has_surface(before) || !has_surface(after)) return std::nullopt;
    const Surface &was = *before.surface, &is = *after.surface;
    if (was.topology == is.topology && was.positions == is.positions) return std::nullopt;
    Finding found = beyond(stated, was, is, progress);
    if (!found) return found;
    if (!found->place) found->place = farthest_change(was, is);
    found->remedies = stated.remedies;
    return found;
}

}  // namespace vesselbench
