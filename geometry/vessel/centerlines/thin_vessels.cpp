#include "geometry/vessel/centerlines/thin_vessels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <ranges>
#include <utility>
#include <vector>

#include <tbb/parallel_for.h>

#include "geometry/kernel/disjoint_sets.h"
#include "geometry/kernel/one_rings.h"
#include "geometry/kernel/shortest_paths.h"
#include "geometry/kernel/surface.h"

namespace vesselbench {
namespace {

/// The wall around voxels of the lumen is at most 0.87 + sqrt(3) / 2 voxels away from one of them
/// where the lumen is wider than the grid resolves.
constexpr double kShown = 2.0;
/// Shorter stretches are corners, sharp edges and rounded tips [voxels].
constexpr double kShortest = 6.0;
/// The opposite wall is not looked for farther away [voxels].
constexpr double kWidest = 4.0;
/// Steps along a path [voxels].
constexpr double kStep = 0.25;
/// Ways tried between the parts beside one stretch.
constexpr int kMostTries = 5;
/// Rays begin and end this far from the wall [voxels].
constexpr double kSkin = 1e-3;

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

class ThinVessels {
public:
    ThinVessels(LumenGrid& grid, const VesselWall& wall, const Progress& cancel)
        : grid_(grid),
          wall_(wall),
          cancel_(cancel),
          offsets_(grid.neighbour_offsets()),
          rings_(one_rings(wall.closed, wall.points.size())),
          normals_(wall.points.size(), Vec3::Zero()),
          parts_(lumen_parts(grid, cancel)),
          joined_(parts_.members.size()),
          shown_by_(wall.points.size(), kNone),
          border_(wall.points.size(), kNone),
          way_(wall.points.size(), std::numeric_limits<double>::infinity()),
          before_(wall.points.size(), kNone) {
        for (const Triangle& t : wall.closed) {
            const Vec3 n = area_normal(wall.points, t);
            for (const VertexId v : t) normals_[v] += n;
        }
        for (Vec3& n : normals_) n.normalize();
    }

    void add() {
        find_shown();
        std::vector<std::uint8_t> seen(wall_.points.size(), 0);
        for (VertexId v = 0; v < wall_.points.size(); ++v) {
            if (seen[v] != 0 || is_shown(v) || rings_.rows.row(v).empty()) continue;
            cancel_.check_cancelled();
            std::vector<VertexId> stretch = {v};
            seen[v] = 1;
            for (std::size_t i = 0; i < stretch.size(); ++i)
                for (const VertexId next : rings_.rows.row(stretch[i]))
                    if (!is_shown(next) && std::exchange(seen[next], 1) == 0)
                        stretch.push_back(next);
            add_stretch(stretch);
        }
        std::ranges::sort(grid_.voxels);
    }

private:
    [[nodiscard]] VoxelId neighbour(VoxelId v, std::size_t n) const {
        return static_cast<VoxelId>(static_cast<int>(v) + offsets_[n]);
    }

    [[nodiscard]] bool is_shown(VertexId v) const { return shown_by_[v] != kNone; }

    [[nodiscard]] bool is_open(const Vec3& from, const Vec3& to) const {
        const double length = (to - from).norm();
        return length == 0.0 ||
               !wall_.distance->first_hit(from, to - from, length - kSkin * grid_.spacing);
    }

    /// The wall's vertices with a voxel of the lumen on their inner side.
    void find_shown() {
        tbb::parallel_for(VertexId{0}, static_cast<VertexId>(wall_.points.size()), [&](VertexId v) {
            if (!normals_[v].allFinite()) return;
            const Vec3& p = wall_.points[v];
            VoxelId at = 0;
            if (!grid_.nearest(p, kShown * grid_.spacing, at)) return;
            const Vec3 centre = grid_.centre(at);
            if ((centre - p).dot(normals_[v]) < 0.0 && is_open(centre, p)) shown_by_[v] = at;
        });
    }

    [[nodiscard]] std::optional<VertexId> shown_beside(VertexId v) const {
        const auto ring = rings_.rows.row(v);
        const auto found = std::ranges::find_if(ring, [&](VertexId n) { return is_shown(n); });
        return found == ring.end() ? std::nullopt : std::optional(*found);
    }

    /// The parts where a stretch begins. Its vertices beside shown ones that are neighbours are one
    /// border.
    std::vector<std::uint32_t> find_borders(const std::vector<VertexId>& stretch) {
        std::vector<std::uint32_t> parts;
        for (const VertexId seed : stretch) {
            const auto shown = shown_beside(seed);
            if (border_[seed] != kNone || !shown) continue;
            const auto name = static_cast<std::uint32_t>(parts.size());
            parts.push_back(parts_.of_voxel[shown_by_[*shown]]);
            std::vector<VertexId> stack = {seed};
            border_[seed] = name;
            while (!stack.empty()) {
                const VertexId v = stack.back();
                stack.pop_back();
                for (const VertexId next : rings_.rows.row(v)) {
                    if (is_shown(next) || border_[next] != kNone || !shown_beside(next)) continue;
                    border_[next] = name;
                    stack.push_back(next);
                }
            }
        }
        return parts;
    }

    /// Shortest ways along the wall from the nearest border to all of a stretch.
    void measure_ways(const std::vector<VertexId>& stretch) {
        ShortestPaths paths(way_);
        for (const VertexId v : stretch)
            if (border_[v] != kNone) paths.lower(v, 0.0);
        while (const auto at = paths.next())
            for (const VertexId next : rings_.rows.row(at->vertex)) {
                if (is_shown(next)) continue;
                const double to =
                    at->distance + (wall_.points[next] - wall_.points[at->vertex]).norm();
                if (!(to < way_[next])) continue;
                before_[next] = at->vertex;
                border_[next] = border_[at->vertex];
                paths.lower(next, to);
            }
    }

    void add_stretch(const std::vector<VertexId>& stretch) {
        const std::vector<std::uint32_t> borders = find_borders(stretch);
        if (borders.empty()) return;
        measure_ways(stretch);
        if (borders.size() > 1) return join_parts(stretch, borders);
        const VertexId end =
            *std::ranges::max_element(stretch, {}, [&](VertexId v) { return way_[v]; });
        if (way_[end] < kShortest * grid_.spacing) return;
        add_path(way_to(end), borders.front(), std::nullopt);
    }

    /// Along the shortest ways between borders of parts that are not joined yet.
    void join_parts(const std::vector<VertexId>& stretch,
                    const std::vector<std::uint32_t>& borders) {
        struct Meeting {
            double length;
            VertexId a, b;
        };

        std::vector<Meeting> meetings;
        for (const VertexId a : stretch)
            for (const VertexId b : rings_.rows.row(a))
                if (a < b && !is_shown(b) && border_[a] != border_[b])
                    meetings.push_back(
                        {way_[a] + (wall_.points[a] - wall_.points[b]).norm() + way_[b], a, b});
        std::ranges::stable_sort(meetings, {}, &Meeting::length);
        int tries = 0;
        for (const Meeting& at : meetings) {
            const std::uint32_t from = borders[border_[at.a]], to = borders[border_[at.b]];
            if (joined_.root(from) == joined_.root(to)) continue;
            if (tries++ == kMostTries) return;
            std::vector<VertexId> way = way_to(at.a);
            const std::vector<VertexId> back = way_to(at.b);
            way.insert(way.end(), back.rbegin(), back.rend());
            if (add_path(way, from, to)) joined_.join(from, to);
        }
    }

    /// From a border.
    [[nodiscard]] std::vector<VertexId> way_to(VertexId end) const {
        std::vector<VertexId> way;
        for (VertexId v = end; v != kNone; v = before_[v]) way.push_back(v);
        std::ranges::reverse(way);
        return way;
    }

    /// Halfway from a point of the wall to the opposite one.
    [[nodiscard]] Vec3 middle_from(const Vec3& wall, const Vec3& outward) const {
        const Vec3 from = wall - kSkin * grid_.spacing * outward;
        const auto hit = wall_.distance->first_hit(from, -outward, kWidest * grid_.spacing);
        return from - 0.5 * (hit ? hit->distance : grid_.spacing) * outward;
    }

    /// The middle of the vessel along a way, from a voxel at its start, and to one at its end if it
    /// ends beside shown vertices.
    [[nodiscard]] Positions middle_of(const std::vector<VertexId>& way) const {
        const auto voxel_beside = [&](VertexId v) {
            const auto shown = shown_beside(v);
            return shown ? Positions{grid_.centre(shown_by_[*shown])} : Positions{};
        };
        Positions line = voxel_beside(way.front());
        for (std::size_t i = 0; i + 1 < way.size(); ++i) {
            const Vec3 &a = wall_.points[way[i]], &b = wall_.points[way[i + 1]];
            const int steps = static_cast<int>((b - a).norm() / (kStep * grid_.spacing)) + 1;
            for (int k = 0; k < steps; ++k) {
                const double t = static_cast<double>(k) / steps;
                const Vec3 normal = (1.0 - t) * normals_[way[i]] + t * normals_[way[i + 1]];
                if (normal.norm() > 0.0)
                    line.push_back(middle_from((1.0 - t) * a + t * b, normal.normalized()));
            }
        }
        const Positions end = voxel_beside(way.back());
        line.insert(line.end(), end.begin(), end.end());
        return line;
    }

    struct PathVoxel {
        VoxelId voxel = 0;
        Vec3 point = Vec3::Zero();  ///< of the path [mm]
    };

    /// The voxels along the middle of a way, up to the first wall.
    [[nodiscard]] std::vector<PathVoxel> voxels_along(const std::vector<VertexId>& way) const {
        std::vector<PathVoxel> voxels;
        Vec3 last = Vec3::Zero();
        for (const Vec3& p : middle_of(way)) {
            if (!voxels.empty() && !is_open(last, p)) break;
            const double step = kStep * grid_.spacing;
            const int steps = voxels.empty() ? 1 : static_cast<int>((p - last).norm() / step) + 1;
            for (int k = 1; k <= steps; ++k) {
                const Vec3 q = voxels.empty() ? p : Vec3(last + (p - last) * k / steps);
                const auto v = voxel_at(q);
                if (!v) return voxels;
                if (voxels.empty() || voxels.back().voxel != *v) voxels.push_back({*v, q});
            }
            last = p;
        }
        return voxels;
    }

    [[nodiscard]] std::optional<VoxelId> voxel_at(const Vec3& p) const {
        std::array<int, 3> at{};
        for (int a = 0; a < 3; ++a) {
            at[a] = static_cast<int>(std::lround((p[a] - grid_.origin[a]) / grid_.spacing));
            if (at[a] < 1 || at[a] + 1 >= grid_.size[a]) return std::nullopt;
        }
        return grid_.id(at[0], at[1], at[2]);
    }

    /// Beside, or one of, the voxels of a part.
    [[nodiscard]] bool touches(VoxelId v, std::uint32_t part) {
        const auto belongs = [&](VoxelId w) {
            return grid_.lumen[w] != 0 && joined_.root(parts_.of_voxel[w]) == joined_.root(part);
        };
        if (belongs(v)) return true;
        for (std::size_t n = 0; n < offsets_.size(); ++n)
            if (belongs(neighbour(v, n))) return true;
        return false;
    }

    /// Not beside a voxel beyond a wall, seen from the path: the voxel's own centre may lie outside
    /// the vessel.
    [[nodiscard]] bool may_join(const PathVoxel& at) const {
        for (std::size_t n = 0; n < offsets_.size(); ++n) {
            const VoxelId w = neighbour(at.voxel, n);
            if (grid_.lumen[w] != 0 && !is_open(at.point, grid_.centre(w))) return false;
        }
        return true;
    }

    /// Adds the voxels of a way between the part that it leaves and the one it leads to, or its
    /// end. False: it cannot lead there.
    bool add_path(const std::vector<VertexId>& way, std::uint32_t from,
                  std::optional<std::uint32_t> to) {
        const std::vector<PathVoxel> path = voxels_along(way);
        std::size_t first = 0, last = path.size();
        for (std::size_t i = 0; i < path.size() && last == path.size(); ++i) {
            if (to && touches(path[i].voxel, *to)) last = i + 1;
            if (touches(path[i].voxel, from)) first = i;
        }
        if (path.empty() || (to && !touches(path[last - 1].voxel, *to))) return false;
        if (!touches(path[first].voxel, from)) return false;
        const auto blocked = std::find_if(
            path.begin() + static_cast<std::ptrdiff_t>(first),
            path.begin() + static_cast<std::ptrdiff_t>(last),
            [&](const PathVoxel& at) { return grid_.lumen[at.voxel] == 0 && !may_join(at); });
        const auto end = static_cast<std::size_t>(blocked - path.begin());
        if (to ? end < last : static_cast<double>(end - first) < 0.5 * kShortest) return false;
        for (std::size_t i = first; i < end; ++i) {
            const VoxelId v = path[i].voxel;
            if (grid_.lumen[v] != 0) continue;
            grid_.lumen[v] = 1;
            parts_.of_voxel[v] = from;
            grid_.voxels.push_back(v);
        }
        return true;
    }

    LumenGrid& grid_;
    const VesselWall& wall_;
    const Progress& cancel_;
    std::array<int, 26> offsets_;
    OneRings rings_;
    Positions normals_;  ///< outward, #V
    LumenParts parts_;
    DisjointSets joined_;
    std::vector<VoxelId> shown_by_;      ///< #V
    std::vector<std::uint32_t> border_;  ///< of the stretch from which a vertex is reached, #V
    std::vector<double> way_;            ///< from there [mm], #V
    std::vector<VertexId> before_;       ///< on that way, #V
};

}  // namespace

void add_thin_vessels(LumenGrid& grid, const VesselWall& wall, const Progress& cancel) {
    ThinVessels(grid, wall, cancel).add();
}

}  // namespace vesselbench
