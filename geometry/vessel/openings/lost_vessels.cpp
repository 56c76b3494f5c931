#include "geometry/vessel/openings/lost_vessels.h"

#include <algorithm>
#include <functional>
#include <limits>

#include "geometry/kernel/shortest_paths.h"
#include "geometry/kernel/surface_distance.h"
#include "geometry/vessel/centerlines/branch_queries.h"
#include "geometry/vessel/ends/end_choice.h"
#include "geometry/vessel/ends/flow_share.h"
#include "geometry/vessel/ends/flow_tree.h"
#include "geometry/vessel/openings/opening_axis.h"
#include "geometry/vessel/openings/rim_shape.h"

namespace vesselbench {

namespace {

/// A longer way is missed [diameters].
constexpr double kLongestLoss = 3.0;
/// A centerline this far outside the wall has lost its vessel [radii]: editing moves walls a
/// little.
constexpr double kOutside = 0.3;
constexpr double kLeastRiseDegInWall = 30.0;

/// By point of a branch.
using Flags = std::vector<bool>;

Flags outside(const CenterlineBranch& branch, const SurfaceDistance& wall) {
    const std::vector<double> distances = wall.signed_distances(branch.points);
    Flags flags(distances.size());
    for (std::size_t i = 0; i < flags.size(); ++i)
        flags[i] = distances[i] > kOutside * branch.radii[i];
    return flags;
}

/// The points of every branch that a surface misses.
std::vector<Flags> missing_points(const CenterlineGraph& before, const Surface& after,
                                  std::span<const Removal> asked) {
    const SurfaceDistance wall(after);
    std::vector<Flags> missing;
    for (const CenterlineBranch& branch : before.branches) missing.push_back(outside(branch, wall));
    for (const Removal& removal : asked) {
        const SurfaceDistance whole(removal.before), rest(removal.after);
        for (std::size_t b = 0; b < missing.size(); ++b) {
            if (std::ranges::find(missing[b], true) == missing[b].end()) continue;
            const Flags gone = outside(before.branches[b], rest);
            const Flags never = outside(before.branches[b], whole);
            for (std::size_t i = 0; i < gone.size(); ++i)
                if (gone[i] && !never[i]) missing[b][i] = false;
        }
    }
    return missing;
}

/// A missing stretch of a branch, between two places: nodes of the graph, or points where the
/// branch is there again.
struct Stretch {
    std::uint32_t from = 0, to = 0;  ///< places
    double length = 0.0;             ///< [mm]
    double diameter = 0.0;           ///< in its middle [mm]
    Vec3 middle = Vec3::Zero();

    [[nodiscard]] double diameters() const { return diameter > 0.0 ? length / diameter : 0.0; }
};

/// The missing stretches of all branches, and the longest ways along them.
class MissingParts {
public:
    MissingParts(const CenterlineGraph& graph, const std::vector<Flags>& missing) {
        for (const CenterlineNode& node : graph.nodes) places_.push_back({node.position, false});
        for (std::size_t b = 0; b < missing.size(); ++b) {
            const CenterlineBranch& branch = graph.branches[b];
            if (missing[b].empty()) continue;
            if (!missing[b].front()) places_[branch.start_node].is_root = true;
            if (!missing[b].back()) places_[branch.end_node].is_root = true;
            add_stretches(branch, missing[b]);
        }
        stretches_at_.resize(places_.size());
        for (std::size_t s = 0; s < stretches_.size(); ++s) {
            stretches_at_[stretches_[s].from].push_back(s);
            stretches_at_[stretches_[s].to].push_back(s);
        }
    }

    /// Of every connected part, the way to the place that is farthest from what is left.
    [[nodiscard]] std::vector<LostVessel> longest_ways() const {
        std::vector<LostVessel> longest;
        std::vector<bool> seen(places_.size(), false);
        for (std::uint32_t place = 0; place < places_.size(); ++place) {
            if (seen[place] || stretches_at_[place].empty()) continue;
            const std::vector<std::uint32_t> part = part_of(place);
            for (const std::uint32_t other : part) seen[other] = true;
            longest.push_back(longest_way(part));
        }
        return longest;
    }

private:
    struct Place {
        Vec3 position;
        bool is_root = false;  ///< next to what is left
    };

    void add_stretches(const CenterlineBranch& branch, const Flags& missing) {
        const std::vector<double> s = abscissas(branch);
        for (std::size_t i = 0; i < s.size(); ++i) {
            std::size_t end = i;
            while (end < s.size() && missing[end]) ++end;
            if (end == i) continue;
            const std::size_t last = end - 1, middle = (i + last) / 2;
            stretches_.push_back({.from = i == 0 ? static_cast<std::uint32_t>(branch.start_node)
                                                 : root_at(branch.points[i]),
                                  .to = end == s.size()
                                            ? static_cast<std::uint32_t>(branch.end_node)
                                            : root_at(branch.points[last]),
                                  .length = s[last] - s[i],
                                  .diameter = 2.0 * branch.radii[middle],
                                  .middle = branch.points[middle]});
            i = last;
        }
    }

    std::uint32_t root_at(const Vec3& point) {
        places_.push_back({point, true});
        return static_cast<std::uint32_t>(places_.size() - 1);
    }

    [[nodiscard]] std::uint32_t other_end(std::size_t stretch, std::uint32_t place) const {
        const Stretch& s = stretches_[stretch];
        return s.from == place ? s.to : s.from;
    }

    [[nodiscard]] std::vector<std::uint32_t> part_of(std::uint32_t place) const {
        std::vector<std::uint32_t> part = {place};
        for (std::size_t i = 0; i < part.size(); ++i)
            for (const std::size_t s : stretches_at_[part[i]])
                if (const std::uint32_t next = other_end(s, part[i]);
                    std::ranges::find(part, next) == part.end())
                    part.push_back(next);
        return part;
    }

    /// From any place next to what is left; from any place if nothing is.
    [[nodiscard]] LostVessel longest_way(const std::vector<std::uint32_t>& part) const {
        const bool rooted = std::ranges::any_of(part, [&](auto p) { return places_[p].is_root; });
        LostVessel longest;
        double most = -1.0;
        for (const std::uint32_t place : part)
            if (!rooted || places_[place].is_root)
                if (const double far = way_from(place, part, most, longest); far > most) most = far;
        return longest;
    }

    /// The length of the longest of the shortest ways from a place [diameters]; `longest` becomes
    /// this way if it is longer than `most`.
    double way_from(std::uint32_t start, const std::vector<std::uint32_t>& part, double most,
                    LostVessel& longest) const {
        std::vector<double> distance(places_.size(), std::numeric_limits<double>::infinity());
        std::vector<std::size_t> by(places_.size(), stretches_.size());
        ShortestPaths paths(distance);
        paths.lower(start, 0.0);
        while (const auto at = paths.next())
            for (const std::size_t s : stretches_at_[at->vertex]) {
                const std::uint32_t next = other_end(s, at->vertex);
                const double to = at->distance + stretches_[s].diameters();
                if (to < distance[next]) by[next] = s;
                paths.lower(next, to);
            }
        const std::uint32_t end = *std::ranges::max_element(
            part, {}, [&](std::uint32_t place) { return distance[place]; });
        if (distance[end] > most) longest = way_to(end, by);
        return distance[end];
    }

    [[nodiscard]] LostVessel way_to(std::uint32_t end, const std::vector<std::size_t>& by) const {
        LostVessel way{.tip = places_[end].position};
        double diameters = 0.0, most = -1.0;
        std::uint32_t place = end;
        for (; by[place] < stretches_.size(); place = other_end(by[place], place)) {
            const Stretch& stretch = stretches_[by[place]];
            way.length += stretch.length;
            diameters += stretch.diameters();
            if (stretch.length > most) {
                most = stretch.length;
                way.place = stretch.middle;
            }
        }
        way.root = places_[place].position;
        way.diameter = diameters > 0.0 ? way.length / diameters : 0.0;
        return way;
    }

    std::vector<Place> places_;  ///< the graph's nodes first
    std::vector<Stretch> stretches_;
    std::vector<std::vector<std::size_t>> stretches_at_;  ///< by place
};

bool had(const Surface& before, const Surface& after, std::size_t patch) {
    const PatchShape shape = patch_shape(after, patch);
    for (std::size_t p = 0; p < before.patches.size(); ++p) {
        if (before.patches[p].kind == PatchKind::Wall ||
            std::ranges::find(*before.patch_labels, p) == before.patch_labels->end())
            continue;
        const Vec3 apart = patch_shape(before, p).plane.point - shape.plane.point;
        if (apart.norm() < 0.1 * shape.diameter()) return true;
    }
    return false;
}

}  // namespace

bool LostVessel::matters() const {
    return share > kLeastShare;
}

std::vector<LostVessel> lost_vessels(const CenterlineGraph& before, const Surface& after,
                                     std::span<const Removal> asked) {
    std::vector<LostVessel> lost =
        MissingParts(before, missing_points(before, after, asked)).longest_ways();
    std::erase_if(lost, [](const LostVessel& vessel) {
        return !(vessel.length > kLongestLoss * vessel.diameter);
    });
    std::ranges::stable_sort(lost, std::greater{}, &LostVessel::diameter);
    if (lost.empty()) return lost;
    const double widest = std::ranges::max(course_diameters(before));
    for (LostVessel& vessel : lost) vessel.share = share_of_flow(vessel.diameter, widest);
    return lost;
}

std::vector<std::size_t> openings_in_walls(const Surface& before, const Surface& after) {
    std::vector<std::size_t> found;
    for (std::size_t p = 0; p < after.patches.size(); ++p) {
        if (after.patches[p].kind == PatchKind::Wall ||
            std::ranges::find(*after.patch_labels, p) == after.patch_labels->end() ||
            had(before, after, p))
            continue;
        const auto rim = rim_shape_of_cap(after, p);
        if (rim && rim->rise_deg < kLeastRiseDegInWall) found.push_back(p);
    }
    return found;
}

}  // namespace vesselbench
