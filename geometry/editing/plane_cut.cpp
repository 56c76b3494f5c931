#include "geometry/editing/plane_cut.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <utility>

namespace vesselbench {

namespace {

/// A vertex closer to the plane than this fraction of its cut edge is moved onto it.
constexpr double kSnapShare = 0.3;
/// A rim edge shorter than this fraction of the rim's mean edge is collapsed.
constexpr double kShortRimEdge = 0.4;
/// Cosine of the largest turn of a triangle when a vertex is moved or an edge collapsed.
constexpr double kLeastTurnCosine = 0.5;
/// A triangle keeps at least this share of its area when a vertex is moved onto the plane.
constexpr double kLeastAreaShare = 0.05;
constexpr std::size_t kFewestRimEdges = 6;

enum class Side : signed char { Below = -1, On = 0, Above = 1 };

using Edge = std::pair<VertexId, VertexId>;

/// Area normal of a triangle if its corner v were at `to` [mm^2].
Vec3 moved_normal(const EditableSurface& surface, TriangleId t, VertexId v, const Vec3& to) {
    Positions moved;
    for (const VertexId c : surface.triangle(t)) moved.push_back(c == v ? to : surface.point(c));
    return area_normal(moved, {0, 1, 2});
}

bool turns_over(const Vec3& before, const Vec3& after) {
    return after.dot(before) < kLeastTurnCosine * after.norm() * before.norm();
}

/// The cut of one surface along one curve, step by step.
class Cutter {
public:
    Cutter(EditableSurface& surface, const Plane& plane, const SectionCurve& curve)
        : surface_(surface), plane_(plane), curve_(curve) {
        in_strip_.assign(surface.triangle_count(), 0);
        for (const TriangleId t : curve.triangles) in_strip_[t] = 1;
        for (const TriangleId t : curve.triangles)
            for (const VertexId v : surface.triangle(t))
                side_[v] = plane.distance(surface.point(v)) >= 0.0 ? Side::Above : Side::Below;
    }

    /// Moves strip vertices near the plane onto it, nearest first.
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
                before_.emplace(move.vertex, surface_.point(move.vertex));
                surface_.move(move.vertex, move.to);
                side_[move.vertex] = Side::On;
            }
    }

    /// Splits the strip's triangles along the plane.
    void divide() {
        std::vector<TriangleId> strip = curve_.triangles;
        std::sort(strip.begin(), strip.end());
        for (const TriangleId t : strip) divide(t);
        find_rim();
    }

    PlaneCut take() { return std::move(cut_); }

private:
    /// Only this curve may meet the fan, and no triangle may turn over.
    bool may_snap(VertexId v, const Vec3& to) const {
        for (const TriangleId t : surface_.triangles_at(v)) {
            if (!in_strip_[t] && crosses(surface_.triangle(t))) return false;
            const Vec3 before = surface_.area_normal_of(t),
                       after = moved_normal(surface_, t, v, to);
            if (turns_over(before, after)) return false;
            if (after.norm() < kLeastAreaShare * before.norm()) return false;
        }
        return !surface_.on_rim(v);
    }

    /// True if the triangle met the plane before any vertex was moved.
    bool crosses(const Triangle& t) const {
        int above = 0;
        for (const VertexId v : t) {
            const auto moved = before_.find(v);
            const Vec3 at = moved == before_.end() ? surface_.point(v) : moved->second;
            above += plane_.distance(at) >= 0.0 ? 1 : 0;
        }
        return above != 0 && above != 3;
    }

    VertexId cut_point(VertexId a, VertexId b) {
        const auto [low, high] = std::minmax(a, b);
        const auto [it, fresh] = cut_points_.try_emplace({low, high}, 0);
        if (!fresh) return it->second;
        const Vec3 below = surface_.point(low), above = surface_.point(high);
        const double dl = std::abs(plane_.distance(below));
        const double dh = std::abs(plane_.distance(above));
        const double t = dl + dh > 0.0 ? dl / (dl + dh) : 0.5;
        const Vec3 at = (1.0 - t) * below + t * above;
        const VertexId sources[] = {low, high};
        const double weights[] = {1.0 - t, t};
        it->second = surface_.add_vertex(plane_.projected(at), sources, weights);
        return it->second;
    }

    void add(const Triangle& triangle, std::uint16_t label, bool above) {
        note(surface_.add_triangle(triangle, label), above);
    }

    void note(TriangleId t, bool above) { (above ? cut_.above : cut_.below).push_back(t); }

    void divide(TriangleId t) {
        const Triangle corners = surface_.triangle(t);
        std::array<Side, 3> s{};
        for (int k = 0; k < 3; ++k) s[k] = side_.at(corners[k]);
        const bool any_below = std::count(s.begin(), s.end(), Side::Below) > 0;
        const bool any_above = std::count(s.begin(), s.end(), Side::Above) > 0;
        if (!any_below || !any_above) {
            note(t, !any_below);
            return;
        }
        const std::uint16_t label = surface_.label(t);
        surface_.remove(t);
        const auto on = std::find(s.begin(), s.end(), Side::On);
        if (on != s.end())
            divide_from_corner(corners, static_cast<int>(on - s.begin()), label);
        else
            divide_off_corner(corners, s, label);
    }

    /// Corner k lies on the plane.
    void divide_from_corner(const Triangle& corners, int k, std::uint16_t label) {
        const VertexId p = corners[k], a = corners[(k + 1) % 3], b = corners[(k + 2) % 3];
        const VertexId m = cut_point(a, b);
        add({p, a, m}, label, side_.at(a) == Side::Above);
        add({p, m, b}, label, side_.at(b) == Side::Above);
    }

    /// One corner is alone on its side.
    void divide_off_corner(const Triangle& corners, const std::array<Side, 3>& s,
                           std::uint16_t label) {
        int k = 0;
        while (s[(k + 1) % 3] != s[(k + 2) % 3]) ++k;
        const VertexId p = corners[k], a = corners[(k + 1) % 3], b = corners[(k + 2) % 3];
        const VertexId pa = cut_point(p, a), pb = cut_point(p, b);
        const bool above = s[k] == Side::Above;
        add({p, pa, pb}, label, above);
        const auto apart = [&](VertexId u, VertexId v) {
            return (surface_.point(u) - surface_.point(v)).squaredNorm();
        };
        if (apart(a, pb) < apart(b, pa)) {
            add({pa, a, pb}, label, !above);
            add({a, b, pb}, label, !above);
        } else {
            add({pa, a, b}, label, !above);
            add({pa, b, pb}, label, !above);
        }
    }

    /// The half-edges below whose other side lies above, as one loop.
    void find_rim() {
        std::vector<std::uint8_t> above(surface_.triangle_count(), 0);
        for (const TriangleId t : cut_.above) above[t] = 1;
        std::map<VertexId, VertexId> next;
        for (const TriangleId t : cut_.below)
            for (int k = 0; k < 3; ++k) {
                const auto beyond = surface_.across(t, k);
                if (std::none_of(beyond.begin(), beyond.end(),
                                 [&](TriangleId other) { return above[other] != 0; }))
                    continue;
                const Triangle corners = surface_.triangle(t);
                if (!next.emplace(corners[k], corners[(k + 1) % 3]).second) return;
            }
        if (next.size() < 3) return;
        std::vector<VertexId> loop{next.begin()->first};
        for (auto at = next.find(next.begin()->second); at != next.end() && at->first != loop[0];
             at = next.find(at->second)) {
            loop.push_back(at->first);
            if (loop.size() > next.size()) return;
        }
        if (loop.size() == next.size()) cut_.rim = std::move(loop);
    }

    EditableSurface& surface_;
    Plane plane_;
    const SectionCurve& curve_;
    PlaneCut cut_;
    std::vector<std::uint8_t> in_strip_;
    std::map<VertexId, Side> side_;
    std::map<VertexId, Vec3> before_;  ///< where moved vertices were
    std::map<Edge, VertexId> cut_points_;
};

/// Merges rim[i + 1] into rim[i] at their middle.
bool merge_next(EditableSurface& surface, VertexId a, VertexId b) {
    const auto ring_a = surface.ring(a), ring_b = surface.ring(b);
    std::vector<VertexId> common;
    std::set_intersection(ring_a.begin(), ring_a.end(), ring_b.begin(), ring_b.end(),
                          std::back_inserter(common));
    if (common.size() != 1) return false;
    const Vec3 middle = 0.5 * (surface.point(a) + surface.point(b));
    const auto shared = surface.triangles_on(a, b);
    for (const VertexId v : {a, b})
        for (const TriangleId t : surface.triangles_at(v))
            if (std::find(shared.begin(), shared.end(), t) == shared.end() &&
                turns_over(surface.area_normal_of(t), moved_normal(surface, t, v, middle)))
                return false;
    const VertexId ends[] = {a, b};
    const double halves[] = {0.5, 0.5};
    if (!surface.collapse(b, a)) return false;
    surface.move(a, middle);
    surface.blend_attributes(a, ends, halves);
    return true;
}

}  // namespace

PlaneCut cut_along(EditableSurface& surface, const Plane& plane, const SectionCurve& curve,
                   NearVertices near) {
    Cutter cutter(surface, plane, curve);
    if (near == NearVertices::MoveOntoPlane) cutter.snap();
    cutter.divide();
    return cutter.take();
}

std::optional<std::vector<std::uint8_t>> part_above(const EditableSurface& surface,
                                                    const PlaneCut& cut) {
    enum Place : std::uint8_t { Elsewhere, Below, Above };

    std::vector<std::uint8_t> at_rim(surface.triangle_count(), Elsewhere);
    std::vector<std::uint8_t> found(surface.triangle_count(), 0);
    for (const TriangleId t : cut.below) at_rim[t] = Below;
    for (const TriangleId t : cut.above) {
        at_rim[t] = Above;
        found[t] = 1;
    }
    std::vector<TriangleId> open = cut.above;
    while (!open.empty()) {
        const TriangleId t = open.back();
        open.pop_back();
        for (int k = 0; k < 3; ++k)
            for (const TriangleId other : surface.across(t, k)) {
                if (found[other] || (at_rim[t] == Above && at_rim[other] == Below)) continue;
                if (at_rim[other] == Below) return std::nullopt;
                found[other] = 1;
                open.push_back(other);
            }
    }
    return found;
}

void clean_rim(EditableSurface& surface, std::vector<VertexId>& rim) {
    const double shortest = kShortRimEdge * mean_edge(surface, rim);
    for (std::size_t i = 0; i < rim.size() && rim.size() > kFewestRimEdges;) {
        const VertexId a = rim[i], b = rim[(i + 1) % rim.size()];
        if ((surface.point(a) - surface.point(b)).norm() < shortest && merge_next(surface, a, b))
            rim.erase(rim.begin() + static_cast<std::ptrdiff_t>((i + 1) % rim.size()));
        else
            ++i;
    }
}

}  // namespace vesselbench
