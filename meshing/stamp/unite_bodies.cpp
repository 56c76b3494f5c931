#include "meshing/stamp/unite_bodies.h"

#include <algorithm>
#include <set>

#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/measure.h"
#include "geometry/kernel/self_intersections.h"
#include "geometry/kernel/surface_distance.h"
#include "meshing/stamp/corefinement.h"

namespace vesselbench {

namespace {

/// A part by itself, outward.
Surface body_of(const Surface& surface, const Components& parts, std::uint32_t part) {
    std::vector<bool> keep(surface.triangle_count());
    for (TriangleId t = 0; t < keep.size(); ++t) keep[t] = parts.of_triangle[t] == part;
    Surface body = select_triangles(surface, keep);
    return volume(body) < 0.0 ? flipped(body) : body;
}

/// The same body again, or one inside: both cannot be united where their walls coincide, and need
/// not be.
bool lies_within(const Surface& body, const SurfaceDistance& other) {
    const double tolerance = 1e-4 * bounds(body).diagonal();
    const auto is_within = [&](const Vec3& p) {
        return other.closest_point(p).distance <= tolerance || other.inside(p);
    };
    return std::ranges::all_of(body.points(), is_within) &&
           std::ranges::all_of(body.triangles(), [&](const Triangle& t) {
               return is_within((body.points()[t[0]] + body.points()[t[1]] + body.points()[t[2]]) /
                                3.0);
           });
}

Surface union_of(const Surface& one, const Surface& other) {
    const SurfaceDistance distance(one);
    CorefinementProblem problem = CorefinementProblem::Degenerate;
    auto both = corefined(
        one, other, StampMode::Add, [&](const Vec3& p) { return distance.inside(p); }, problem);
    if (both) return std::move(both->surface);
    if (problem == CorefinementProblem::Swallowed) return other;
    if (lies_within(other, distance)) return one;
    if (lies_within(one, SurfaceDistance(other))) return other;
    const Bounds box = bounds(other);
    throw DiagnosedFailure({.code = "bodies-not-united", .place = 0.5 * (box.min + box.max)});
}

/// Surfaces of one patch table behind each other.
class Collection {
public:
    void add(const Surface& surface) {
        const auto first = static_cast<VertexId>(points_.size());
        points_.insert(points_.end(), surface.points().begin(), surface.points().end());
        for (const Triangle& t : surface.triangles())
            triangles_.push_back({t[0] + first, t[1] + first, t[2] + first});
        labels_.insert(labels_.end(), surface.patch_labels->begin(), surface.patch_labels->end());
    }

    [[nodiscard]] Surface result(const std::vector<Patch>& patches) {
        return make_surface(std::move(points_), std::move(triangles_), std::move(labels_), patches);
    }

private:
    Positions points_;
    std::vector<Triangle> triangles_;
    PatchLabels labels_;
};

/// The parts that are connected with one by crossings, each behind one that it crosses.
std::vector<std::uint32_t> group_of(std::uint32_t first, const std::vector<BodyPair>& crossing) {
    std::vector<std::uint32_t> group{first};
    const auto add = [&](std::uint32_t part) {
        if (std::ranges::find(group, part) == group.end()) group.push_back(part);
    };
    for (std::size_t i = 0; i < group.size(); ++i)
        for (const auto& [a, b] : crossing) {
            if (a == group[i]) add(b);
            if (b == group[i]) add(a);
        }
    return group;
}

}  // namespace

std::vector<BodyPair> crossing_bodies(const Surface& surface, const Components& parts,
                                      const Progress& progress) {
    std::set<BodyPair> pairs;
    for (const auto& [s, t] : self_intersections(surface, progress)) {
        const std::uint32_t a = parts.of_triangle[s], b = parts.of_triangle[t];
        if (a != b) pairs.insert(std::minmax(a, b));
    }
    return {pairs.begin(), pairs.end()};
}

UnitedBodies united_bodies(const Surface& surface, const Components& parts,
                           const std::vector<BodyPair>& crossing, const Progress& progress) {
    UnitedBodies united{.surface = surface};
    if (crossing.empty()) return united;
    std::vector<bool> in_union(parts.count(), false);
    std::vector<Surface> made;
    for (const BodyPair& pair : crossing) {
        if (in_union[pair.first]) continue;
        const std::vector<std::uint32_t> group = group_of(pair.first, crossing);
        Surface whole;
        for (const std::uint32_t part : group) {
            progress.report(static_cast<double>(united.bodies) / static_cast<double>(parts.count()),
                            "uniting bodies");
            const Surface body = body_of(surface, parts, part);
            whole = whole.empty() ? body : union_of(whole, body);
            in_union[part] = true;
            ++united.bodies;
        }
        made.push_back(std::move(whole));
    }
    std::vector<bool> rest(surface.triangle_count());
    for (TriangleId t = 0; t < rest.size(); ++t) rest[t] = !in_union[parts.of_triangle[t]];
    Collection all;
    all.add(select_triangles(surface, rest));
    for (const Surface& body : made) all.add(body);
    united.made = made.size();
    united.surface = all.result(surface.patches);
    return united;
}

}  // namespace vesselbench
