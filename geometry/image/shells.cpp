#include "geometry/image/shells.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <string>
#include <utility>

#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/disjoint_sets.h"
#include "geometry/kernel/edges.h"

namespace vesselbench {

namespace {

/// A smaller dropped piece is no tree of vessels [volume of what is kept].
constexpr double kTreeShare = 0.05;

std::vector<Remedy> another_threshold() {
    return {{.arguments = {{"threshold", ""}}}};
}

struct Shells {
    std::vector<std::uint32_t> of_triangle;  ///< #T, numbered by first triangle
    std::vector<double> volumes;             ///< signed [mm^3]; negative: a hollow
};

Shells shells_of(const Surface& surface) {
    Components components = connected_components(*surface.topology);
    Shells found;
    found.volumes.assign(components.count(), 0.0);
    found.of_triangle = std::move(components.of_triangle);
    const Positions& points = surface.points();
    const Vec3 origin = points.empty() ? Vec3(Vec3::Zero()) : points.front();
    for (TriangleId t = 0; t < surface.triangle_count(); ++t) {
        const Triangle& triangle = surface.triangles()[t];
        found.volumes[found.of_triangle[t]] +=
            (points[triangle[0]] - origin).dot(area_normal(points, triangle)) / 6.0;
    }
    return found;
}

/// The part of the surface with the chosen shells; the patch table is kept.
Surface part_of(const Surface& surface, const Shells& shells, const std::vector<bool>& chosen) {
    std::vector<bool> keep(surface.triangle_count());
    for (TriangleId t = 0; t < keep.size(); ++t) keep[t] = chosen[shells.of_triangle[t]];
    return select_triangles(surface, keep);
}

ShellChoice counted(const Shells& shells, const std::vector<bool>& chosen) {
    ShellChoice choice;
    for (std::size_t s = 0; s < shells.volumes.size(); ++s) {
        const double volume = shells.volumes[s];
        ++(volume > 0.0 ? choice.bodies : choice.hollows);
        if (!chosen[s]) choice.largest_dropped = std::max(choice.largest_dropped, volume);
    }
    return choice;
}

/// A piece whose branches or bends make it look wider than it is: the largest dropped one, with the
/// diameter of the tubes that have its volume and area.
std::optional<PieceShape> dropped_tree(std::vector<PieceShape> shapes, const Shells& shells,
                                       const std::vector<bool>& chosen) {
    double kept = 0.0;
    for (std::size_t s = 0; s < chosen.size(); ++s)
        if (chosen[s]) kept += shells.volumes[s];
    std::optional<PieceShape> largest;
    for (PieceShape& shape : shapes) {
        const double volume = shells.volumes[shape.piece];
        if (chosen[shape.piece] || volume < kTreeShare * kept ||
            (largest && volume <= shells.volumes[largest->piece]))
            continue;
        const double area = std::numbers::pi * shape.length * shape.diameter;
        shape.diameter = area > 0.0 ? 4.0 * volume / area : 0.0;
        if (shape.is_vessel()) largest = shape;
    }
    return largest;
}

/// A hollow in a body is none.
std::optional<PieceShape> dropped_vessel(const Surface& surface, const Shells& shells,
                                         const std::vector<bool>& chosen) {
    std::vector<PieceShape> shapes = piece_shapes(surface.points(), surface.triangles(),
                                                  shells.of_triangle, shells.volumes.size());
    std::erase_if(shapes,
                  [&](const PieceShape& shape) { return !(shells.volumes[shape.piece] > 0.0); });
    if (auto vessel = longest_dropped_vessel(shapes, chosen)) return vessel;
    return dropped_tree(std::move(shapes), shells, chosen);
}

ShellChoice only(const Surface& surface, const Shells& shells, std::size_t shell) {
    std::vector<bool> chosen(shells.volumes.size(), false);
    chosen[shell] = true;
    ShellChoice choice = counted(shells, chosen);
    choice.surface = part_of(surface, shells, chosen);
    if (choice.bodies > 1) choice.dropped_vessel = dropped_vessel(surface, shells, chosen);
    return choice;
}

/// Solid angle [sr] of a triangle seen from the origin (van Oosterom, Strackee 1983).
double solid_angle(const Vec3& a, const Vec3& b, const Vec3& c) {
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    return 2.0 * std::atan2(a.dot(b.cross(c)),
                            la * lb * lc + a.dot(b) * lc + a.dot(c) * lb + b.dot(c) * la);
}

/// Winding number of every shell around the point, and the distance of its nearest vertex [mm].
struct Nearness {
    std::vector<double> winding;
    std::vector<double> distance;
};

Nearness nearness(const Surface& surface, const Shells& shells, const Vec3& point) {
    Nearness near;
    near.winding.assign(shells.volumes.size(), 0.0);
    near.distance.assign(shells.volumes.size(), std::numeric_limits<double>::infinity());
    const Positions& p = surface.points();
    for (TriangleId t = 0; t < surface.triangle_count(); ++t) {
        const auto& [a, b, c] = surface.triangles()[t];
        const std::uint32_t s = shells.of_triangle[t];
        near.winding[s] += solid_angle(p[a] - point, p[b] - point, p[c] - point);
        near.distance[s] = std::min(near.distance[s], (p[a] - point).norm());
    }
    for (double& w : near.winding) w /= 4.0 * std::numbers::pi;
    return near;
}

/// Connected parts of cut patches: triangles of one patch that share a vertex belong together, so a
/// node is a pair (vertex, patch).
class CutNodes {
public:
    explicit CutNodes(const Surface& surface)
        : surface_(surface), sets_(surface.vertex_count() * surface.patches.size()) {
        for (TriangleId t = 0; t < surface.triangle_count(); ++t)
            if (surface.patch_of(t).kind == PatchKind::Cut)
                for (const VertexId v : surface.triangles()[t])
                    sets_.join(node(t, surface.triangles()[t][0]), node(t, v));
    }

    [[nodiscard]] std::uint32_t name_of(TriangleId t) const {
        return sets_.root(node(t, surface_.triangles()[t][0]));
    }

private:
    [[nodiscard]] std::uint32_t node(TriangleId t, VertexId v) const {
        return static_cast<std::uint32_t>(v * surface_.patches.size() +
                                          (*surface_.patch_labels)[t]);
    }

    const Surface& surface_;
    mutable DisjointSets sets_;
};

struct Cap {
    std::uint32_t name = 0;
    double area = 0.0;  ///< [mm^2]
};

std::vector<Patch> other_patches(const Surface& surface) {
    std::vector<Patch> patches;
    for (const Patch& patch : surface.patches)
        if (patch.kind != PatchKind::Cut) patches.push_back(patch);
    return patches;
}

/// New label of every patch that is not a cut.
std::vector<std::uint16_t> kept_labels(const Surface& surface) {
    std::vector<std::uint16_t> labels(surface.patches.size(), 0);
    std::uint16_t next = 0;
    for (std::size_t p = 0; p < labels.size(); ++p)
        if (surface.patches[p].kind != PatchKind::Cut) labels[p] = next++;
    return labels;
}

}  // namespace

Surface with_separate_cuts(const Surface& surface, double smallest) {
    const CutNodes nodes(surface);
    std::vector<Cap> caps;
    std::map<std::uint32_t, std::size_t> cap_of;  // by name of its set
    for (TriangleId t = 0; t < surface.triangle_count(); ++t) {
        if (surface.patch_of(t).kind != PatchKind::Cut) continue;
        const auto [at, fresh] = cap_of.try_emplace(nodes.name_of(t), caps.size());
        if (fresh) caps.push_back({at->first, 0.0});
        caps[at->second].area += 0.5 * area_normal(surface.points(), surface.triangles()[t]).norm();
    }
    std::map<std::uint32_t, std::uint16_t> label_of;
    for (const Cap& cap : caps) label_of[cap.name] = 0;
    std::erase_if(caps, [&](const Cap& cap) { return cap.area < smallest; });
    constexpr std::size_t kMostPatches = 60000;  // patch labels are 16 bits
    if (caps.size() > kMostPatches)
        throw DiagnosedFailure({.code = "threshold-in-noise",
                                .figures = {{"places", static_cast<double>(caps.size())}},
                                .remedies = another_threshold()});
    std::stable_sort(caps.begin(), caps.end(),
                     [](const Cap& a, const Cap& b) { return a.area > b.area; });
    std::vector<Patch> patches = other_patches(surface);
    std::vector<std::uint16_t> new_label = kept_labels(surface);
    std::size_t number = 0;
    for (const Cap& cap : caps) {
        label_of[cap.name] = static_cast<std::uint16_t>(patches.size());
        patches.push_back({"cut_" + std::to_string(++number), PatchKind::Cut});
    }
    PatchLabels labels(surface.triangle_count());
    for (TriangleId t = 0; t < surface.triangle_count(); ++t)
        labels[t] = surface.patch_of(t).kind == PatchKind::Cut
                        ? label_of[nodes.name_of(t)]
                        : new_label[(*surface.patch_labels)[t]];
    return surface.with_patches(std::move(labels), std::move(patches));
}

ShellChoice largest_body(const Surface& surface) {
    const Shells shells = shells_of(surface);
    std::size_t best = 0;
    for (std::size_t s = 0; s < shells.volumes.size(); ++s)
        if (shells.volumes[s] > shells.volumes[best]) best = s;
    if (shells.volumes.empty() || !(shells.volumes[best] > 0.0))
        throw DiagnosedFailure({.code = "no-closed-body", .remedies = another_threshold()});
    return only(surface, shells, best);
}

ShellChoice body_at(const Surface& surface, const Vec3& point, double tolerance) {
    const Shells shells = shells_of(surface);
    const Nearness near = nearness(surface, shells, point);
    std::size_t best = shells.volumes.size(), nearest = best;
    for (std::size_t s = 0; s < shells.volumes.size(); ++s) {
        if (shells.volumes[s] <= 0.0) continue;
        if (near.winding[s] > 0.5 &&
            (best == shells.volumes.size() || shells.volumes[s] < shells.volumes[best]))
            best = s;
        if (nearest == shells.volumes.size() || near.distance[s] < near.distance[nearest])
            nearest = s;
    }
    if (nearest == shells.volumes.size())
        throw DiagnosedFailure({.code = "no-closed-body", .remedies = another_threshold()});
    if (best == shells.volumes.size() && near.distance[nearest] > tolerance)
        throw DiagnosedFailure({.code = "seed-in-no-body",
                                .place = point,
                                .figures = {{"distance_mm", near.distance[nearest]}},
                                .remedies = {{.arguments = {{"seed", ""}}}}});
    return only(surface, shells, best == shells.volumes.size() ? nearest : best);
}

ShellChoice all_bodies(const Surface& surface) {
    const Shells shells = shells_of(surface);
    ShellChoice choice = counted(shells, std::vector<bool>(shells.volumes.size(), true));
    choice.surface = surface;
    return choice;
}

}  // namespace vesselbench
