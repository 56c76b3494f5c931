#include "geometry/vessel/openings/clip.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <unordered_map>
#include <utility>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/wording.h"
#include "geometry/vessel/openings/flat_cap.h"
#include "geometry/vessel/openings/surface_parts.h"

namespace vesselbench {

namespace {

/// A vertex nearer to the plane than this share of its cut edge is moved onto it.
constexpr double kSnapShare = 0.3;
/// A rim edge shorter than this share of the rim's mean edge is collapsed.
constexpr double kShortRimEdge = 0.4;
/// A triangle may turn by at most this cosine when a vertex is moved or an edge collapsed.
constexpr double kLeastTurnCosine = 0.5;

enum class Side : signed char { Below = -1, On = 0, Above = 1 };

std::uint64_t edge_key(VertexId a, VertexId b) {
    const auto [low, high] = std::minmax(a, b);
    return static_cast<std::uint64_t>(low) << 32 | high;
}

std::uint64_t half_edge(VertexId from, VertexId to) {
    return static_cast<std::uint64_t>(from) << 32 | to;
}

/// The cut of one surface along one curve, step by step.
class Cut {
public:
    Cut(const Surface& surface, const Plane& plane, SectionCurve curve)
        : surface_(surface), plane_(plane), curve_(std::move(curve)), parts_(take_apart(surface)) {
        in_strip_.assign(surface.triangle_count(), 0);
        for (const TriangleId t : curve_.triangles) in_strip_[t] = 1;
        for (const TriangleId t : curve_.triangles)
            for (const VertexId v : surface.triangles()[t])
                side_[v] = plane.distance(surface.points()[v]) >= 0.0 ? Side::Above : Side::Below;
    }

    /// Moves strip vertices near the plane onto it, the nearest first.
    void snap() {
        struct Move {
            double share;
            VertexId vertex;
            Vec3 to;
        };

        std::vector<Move> moves;
        for (std::size_t i = 0; i < curve_.crossings.size(); ++i) {
            const auto& [below, above, t] = curve_.crossings[i];
            if (t < kSnapShare) moves.push_back({t, below, curve_.points[i]});
            if (1.0 - t < kSnapShare) moves.push_back({1.0 - t, above, curve_.points[i]});
        }
        std::stable_sort(moves.begin(), moves.end(),
                         [](const Move& a, const Move& b) { return a.share < b.share; });
        for (const Move& move : moves)
            if (side_.at(move.vertex) != Side::On && may_snap(move.vertex, move.to)) {
                parts_.positions[move.vertex] = move.to;
                side_[move.vertex] = Side::On;
            }
    }

    /// Divides the strip's triangles along the plane.
    void divide() {
        gone_.assign(parts_.triangles.size(), 0);
        std::vector<TriangleId> strip = curve_.triangles;
        std::sort(strip.begin(), strip.end());
        for (const TriangleId t : strip) divide(t);
    }

    /// The half-edges of the lower part along the plane, as one loop; empty if they are not one.
    std::vector<VertexId> rim() const {
        std::vector<std::uint64_t> upper;
        for (const TriangleId t : strip_above_)
            for (int k = 0; k < 3; ++k)
                upper.push_back(
                    half_edge(parts_.triangles[t][k], parts_.triangles[t][(k + 1) % 3]));
        std::sort(upper.begin(), upper.end());
        std::map<VertexId, VertexId> next;
        for (const TriangleId t : strip_below_)
            for (int k = 0; k < 3; ++k) {
                const VertexId a = parts_.triangles[t][k], b = parts_.triangles[t][(k + 1) % 3];
                if (!std::binary_search(upper.begin(), upper.end(), half_edge(b, a))) continue;
                if (!next.emplace(a, b).second) return {};
            }
        if (next.size() < 3) return {};
        std::vector<VertexId> loop{next.begin()->first};
        for (auto at = next.find(next.begin()->second); at != next.end() && at->first != loop[0];
             at = next.find(at->second)) {
            loop.push_back(at->first);
            if (loop.size() > next.size()) return {};
        }
        return loop.size() == next.size() ? loop : std::vector<VertexId>{};
    }

    /// Marks everything that hangs together with the strip's upper part. False if the lower part
    /// does, too.
    bool mark_removed() {
        std::vector<std::uint8_t> below(parts_.triangles.size(), 0);
        for (const TriangleId t : strip_below_) below[t] = 1;
        std::map<std::uint64_t, std::vector<TriangleId>> strip_edges;
        for (const auto* part : {&strip_below_, &strip_above_})
            for (const TriangleId t : *part)
                for (int k = 0; k < 3; ++k) strip_edges[edge_of(t, k)].push_back(t);
        std::vector<std::uint8_t> strip_above(parts_.triangles.size(), 0);
        removed_ = gone_;
        std::vector<TriangleId> open = strip_above_;
        for (const TriangleId t : open) removed_[t] = strip_above[t] = 1;
        while (!open.empty()) {
            const TriangleId t = open.back();
            open.pop_back();
            for (int k = 0; k < 3; ++k)
                for (const TriangleId other : neighbours(t, k, strip_edges)) {
                    if (removed_[other] || (strip_above[t] && below[other])) continue;
                    if (below[other]) return false;
                    removed_[other] = 1;
                    open.push_back(other);
                }
        }
        return true;
    }

    OpenedSurface result(const std::vector<VertexId>& rim) const {
        std::vector<VertexId> ids;
        OpenedSurface opened{put_together(parts_, removed_, &ids), {}};
        for (const VertexId v : rim) opened.rim.push_back(ids[v]);
        return opened;
    }

private:
    /// The whole fan must be met by this curve only, and no triangle may turn over.
    bool may_snap(VertexId v, const Vec3& to) const {
        for (const TriangleId t : surface_.topology->triangles_at().row(v)) {
            const Triangle& corners = surface_.triangles()[t];
            if (!in_strip_[t] && crosses(corners)) return false;
            const Vec3 before = area_normal(parts_.positions, corners);
            Positions moved;
            for (const VertexId c : corners) moved.push_back(c == v ? to : parts_.positions[c]);
            const Vec3 after = area_normal(moved, {0, 1, 2});
            if (after.dot(before) < kLeastTurnCosine * after.norm() * before.norm()) return false;
            if (after.norm() < 0.05 * before.norm()) return false;
        }
        return !surface_.topology->boundary_vertices()[v];
    }

    std::uint64_t edge_of(TriangleId t, int k) const {
        return edge_key(parts_.triangles[t][k], parts_.triangles[t][(k + 1) % 3]);
    }

    /// The triangles across the k-th edge of t: those of the divided strip, and untouched ones.
    std::vector<TriangleId> neighbours(
        TriangleId t, int k,
        const std::map<std::uint64_t, std::vector<TriangleId>>& strip_edges) const {
        std::vector<TriangleId> found;
        if (const auto it = strip_edges.find(edge_of(t, k)); it != strip_edges.end())
            found = it->second;
        const VertexId a = parts_.triangles[t][k], b = parts_.triangles[t][(k + 1) % 3];
        if (a >= surface_.vertex_count() || b >= surface_.vertex_count()) return found;
        for (const TriangleId other : surface_.topology->triangles_at().row(a)) {
            const Triangle& c = surface_.triangles()[other];
            if (!in_strip_[other] && std::find(c.begin(), c.end(), b) != c.end())
                found.push_back(other);
        }
        return found;
    }

    bool crosses(const Triangle& t) const {
        int above = 0;
        for (const VertexId v : t) above += plane_.distance(surface_.points()[v]) >= 0.0 ? 1 : 0;
        return above != 0 && above != 3;
    }

    VertexId cut_point(VertexId a, VertexId b) {
        const auto [it, fresh] = cut_points_.try_emplace(edge_key(a, b), 0);
        if (!fresh) return it->second;
        const auto [low, high] = std::minmax(a, b);
        const double dl = std::abs(plane_.distance(parts_.positions[low]));
        const double dh = std::abs(plane_.distance(parts_.positions[high]));
        const double t = dl + dh > 0.0 ? dl / (dl + dh) : 0.5;
        const Vec3 at = (1.0 - t) * parts_.positions[low] + t * parts_.positions[high];
        const VertexId sources[] = {low, high};
        const double weights[] = {1.0 - t, t};
        it->second = parts_.add_vertex(plane_.projected(at), sources, weights);
        return it->second;
    }

    void add(const Triangle& triangle, TriangleId origin, bool above) {
        parts_.add_triangle(triangle, parts_.labels[origin]);
        gone_.push_back(0);
        note(static_cast<TriangleId>(parts_.triangles.size() - 1), above);
    }

    void note(TriangleId t, bool above) { (above ? strip_above_ : strip_below_).push_back(t); }

    void divide(TriangleId t) {
        const Triangle corners = parts_.triangles[t];
        std::array<Side, 3> s{};
        for (int k = 0; k < 3; ++k) s[k] = side_.at(corners[k]);
        const bool any_below = std::count(s.begin(), s.end(), Side::Below) > 0;
        const bool any_above = std::count(s.begin(), s.end(), Side::Above) > 0;
        if (!any_below || !any_above) {
            note(t, !any_below);
            return;
        }
        gone_[t] = 1;
        if (const auto on = std::find(s.begin(), s.end(), Side::On); on != s.end()) {
            const auto k = static_cast<int>(on - s.begin());
            const VertexId p = corners[k], a = corners[(k + 1) % 3], b = corners[(k + 2) % 3];
            const VertexId m = cut_point(a, b);
            add({p, a, m}, t, side_.at(a) == Side::Above);
            add({p, m, b}, t, side_.at(b) == Side::Above);
            return;
        }
        // One corner alone on its side.
        int k = 0;
        while (s[(k + 1) % 3] != s[(k + 2) % 3]) ++k;
        const VertexId p = corners[k], a = corners[(k + 1) % 3], b = corners[(k + 2) % 3];
        const VertexId pa = cut_point(p, a), pb = cut_point(p, b);
        const bool above = s[k] == Side::Above;
        add({p, pa, pb}, t, above);
        const auto& x = parts_.positions;
        if ((x[a] - x[pb]).squaredNorm() < (x[b] - x[pa]).squaredNorm()) {
            add({pa, a, pb}, t, !above);
            add({a, b, pb}, t, !above);
        } else {
            add({pa, a, b}, t, !above);
            add({pa, b, pb}, t, !above);
        }
    }

    const Surface& surface_;
    Plane plane_;
    SectionCurve curve_;
    SurfaceParts parts_;
    std::vector<std::uint8_t> in_strip_;
    std::map<VertexId, Side> side_;
    std::map<std::uint64_t, VertexId> cut_points_;
    std::vector<std::uint8_t> gone_, removed_;
    std::vector<TriangleId> strip_above_, strip_below_;
};

/// Collapses short edges of a planar rim, one at a time, where no triangle turns over.
class RimCleaner {
public:
    explicit RimCleaner(const OpenedSurface& opened)
        : parts_(take_apart(opened.surface)),
          rim_(opened.rim),
          removed_(parts_.triangles.size(), 0) {
        for (TriangleId t = 0; t < parts_.triangles.size(); ++t)
            for (const VertexId v : parts_.triangles[t]) fans_[v].push_back(t);
    }

    OpenedSurface run() {
        const double shortest = kShortRimEdge * mean_edge(parts_.positions, rim_);
        for (std::size_t i = 0; i < rim_.size() && rim_.size() > 6;) {
            const VertexId a = rim_[i], b = rim_[(i + 1) % rim_.size()];
            const bool is_short = (parts_.positions[a] - parts_.positions[b]).norm() < shortest;
            if (is_short && collapse(a, b))
                rim_.erase(rim_.begin() + static_cast<std::ptrdiff_t>((i + 1) % rim_.size()));
            else
                ++i;
        }
        std::vector<VertexId> ids;
        OpenedSurface cleaned{put_together(parts_, removed_, &ids), {}};
        for (const VertexId v : rim_) cleaned.rim.push_back(ids[v]);
        return cleaned;
    }

private:
    std::vector<VertexId> ring(VertexId v) {
        std::vector<VertexId> around;
        for (const TriangleId t : fans_[v])
            if (!removed_[t])
                for (const VertexId u : parts_.triangles[t])
                    if (u != v) around.push_back(u);
        std::sort(around.begin(), around.end());
        around.erase(std::unique(around.begin(), around.end()), around.end());
        return around;
    }

    bool has_edge_triangle(TriangleId t, VertexId a, VertexId b) const {
        const Triangle& c = parts_.triangles[t];
        return std::count(c.begin(), c.end(), a) + std::count(c.begin(), c.end(), b) == 2;
    }

    bool turns(VertexId v, VertexId other, const Vec3& to) {
        for (const TriangleId t : fans_[v]) {
            if (removed_[t] || has_edge_triangle(t, v, other)) continue;
            const Vec3 before = area_normal(parts_.positions, parts_.triangles[t]);
            Positions moved;
            for (const VertexId c : parts_.triangles[t])
                moved.push_back(c == v ? to : parts_.positions[c]);
            const Vec3 after = area_normal(moved, {0, 1, 2});
            if (after.dot(before) < kLeastTurnCosine * after.norm() * before.norm()) return true;
        }
        return false;
    }

    /// Merges b into a at their middle.
    bool collapse(VertexId a, VertexId b) {
        const auto ring_a = ring(a), ring_b = ring(b);
        std::vector<VertexId> common;
        std::set_intersection(ring_a.begin(), ring_a.end(), ring_b.begin(), ring_b.end(),
                              std::back_inserter(common));
        if (common.size() != 1) return false;
        const Vec3 middle = 0.5 * (parts_.positions[a] + parts_.positions[b]);
        if (turns(a, b, middle) || turns(b, a, middle)) return false;
        parts_.positions[a] = middle;
        for (auto& [name, values] : parts_.attributes) values[a] = 0.5 * (values[a] + values[b]);
        for (const TriangleId t : fans_[b]) {
            if (removed_[t]) continue;
            if (has_edge_triangle(t, a, b)) {
                removed_[t] = 1;
                continue;
            }
            for (VertexId& c : parts_.triangles[t])
                if (c == b) c = a;
            fans_[a].push_back(t);
        }
        return true;
    }

    SurfaceParts parts_;
    std::vector<VertexId> rim_;
    std::vector<std::uint8_t> removed_;
    std::unordered_map<VertexId, std::vector<TriangleId>> fans_;
};

}  // namespace

OpenedSurface cut_branch(const Surface& surface, const Plane& plane) {
    auto curve = cross_section_at(surface, plane);
    if (!curve)
        throw AlgorithmFailure(
            "the clipping plane at " + place_text(plane.point) +
            " does not meet the surface: give the distance from the tip, or open the "
            "ends one by one (tip=x,y,z)");
    if (!curve->closed)
        throw AlgorithmFailure("the clipping plane at " + place_text(plane.point) +
                               " meets an open border: clip further away from the tip");
    // Moving vertices may pinch the rim where the mesh is bad; cutting without it never does.
    bool separates = true;
    for (const bool snapping : {true, false}) {
        Cut cut(surface, plane, *curve);
        if (snapping) cut.snap();
        cut.divide();
        const auto rim = cut.rim();
        if (rim.empty()) continue;
        separates = cut.mark_removed();
        if (separates) return RimCleaner(cut.result(rim)).run();
    }
    if (!separates)
        throw AlgorithmFailure("the cut at " + place_text(plane.point) +
                               " does not separate the branch from the rest: the vessels form a "
                               "loop there; clip one of the other branches as well, or choose "
                               "another place");
    throw AlgorithmFailure("the cut at " + place_text(plane.point) +
                           " has no simple rim: repair the surface there, or clip elsewhere");
}

Surface cap_rim(const OpenedSurface& opened, const Plane& plane, const Patch& patch) {
    SurfaceParts parts = take_apart(opened.surface);
    // The cap runs against the wall's half-edges.
    std::vector<VertexId> rim(opened.rim.rbegin(), opened.rim.rend());
    Positions corners;
    for (const VertexId v : rim)
        corners.push_back(parts.positions[v] = plane.projected(parts.positions[v]));
    const FlatCap cap = fill_flat(corners, plane, mean_edge(parts.positions, rim));
    const std::vector<double> equal(rim.size(), 1.0 / static_cast<double>(rim.size()));
    std::vector<VertexId> ids = rim;
    for (const Vec3& p : cap.inner) ids.push_back(parts.add_vertex(p, rim, equal));
    const std::uint16_t label = parts.add_patch(patch);
    for (const auto& [a, b, c] : cap.triangles) parts.add_triangle({ids[a], ids[b], ids[c]}, label);
    return put_together(parts);
}

Surface clip_branch(const Surface& surface, const Plane& plane, const Patch& patch) {
    return cap_rim(cut_branch(surface, plane), plane, patch);
}

}  // namespace vesselbench
