#include "meshing/remeshing/improve_worst.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/kernel/triangle_shape.h"
#include "meshing/remeshing/selected.h"

namespace vesselbench {

namespace {

constexpr int kMostRounds = 10;
constexpr double kGain = 1e-3;  // smallest improvement that counts: prevents endless exchanges

/// Two triangles at an edge whose mean edges differ by more than this factor count as bad: slightly
/// below the default gradation of 1.5.
constexpr double kUneven = 1.46;

double shape_quality(const Vec3& a, const Vec3& b, const Vec3& c) {
    return std::min(1.0 - equiangle_skewness(a, b, c), radius_ratio(a, b, c));
}

/// The summand minimised by polishing: the radius ratio reflects the whole shape, the extreme
/// angles' cosines, scaled from 0 at 60 deg to 1, the worst angle. It is computed hundreds of times
/// for every triangle, and needs no angle itself.
double badness(const Vec3& a, const Vec3& b, const Vec3& c) {
    const double xx = (b - c).squaredNorm(), yy = (c - a).squaredNorm(), zz = (a - b).squaredNorm();
    const double least = std::min({xx, yy, zz}), most = std::max({xx, yy, zz}), sum = xx + yy + zz;
    const double middle = sum - least - most;
    const double x = std::sqrt(least), y = std::sqrt(middle), z = std::sqrt(most);
    if (!(x > 0.0)) return 1.2;
    const double obtuse = 0.5 * (least + middle - most) / (x * y),
                 acute = 0.5 * (most + middle - least) / (z * y);
    const double angles = std::max((0.5 - obtuse) / 1.5, (acute - 0.5) / 0.5);
    const double ratio = 4.0 * (b - a).cross(c - a).squaredNorm() / ((x + y + z) * x * y * z);
    return 0.2 * angles + 1.0 - ratio;
}

/// Flips, moves and collapses around single triangles.
class ShapeImprover {
public:
    explicit ShapeImprover(RemeshState& state) : state_(state) {}

    void polish();
    double improve_worst(double wanted_quality);

private:
    using HalfEdge = EditMesh::HalfEdge;

    [[nodiscard]] EditMesh& mesh() const { return state_.mesh; }

    /// The best of some places around a vertex, if `score` (vertex, place) rates it higher than the
    /// current one.
    template <class Score>
    [[nodiscard]] std::optional<TargetPlace> better_place(VertexId v, double first_step,
                                                          double last_step,
                                                          const Score& score) const;

    /// Exchanging the diagonal at h makes better triangles.
    [[nodiscard]] bool flip_polishes(HalfEdge h) const;

    /// Sum of the edge lengths of triangle t if v were at x [mm].
    [[nodiscard]] double edges_around(TriangleId t, VertexId v, const Vec3& x) const;
    /// Below 0.5 if the triangles on both sides of h differ too much in size with v at x.
    [[nodiscard]] double evenness_across(HalfEdge h, VertexId v, const Vec3& x) const;
    /// At most 1; below 0.5 if t is ill-shaped or differs in size from a neighbour.
    [[nodiscard]] double quality_of(TriangleId t) const;
    [[nodiscard]] double shape_around(VertexId v, const Vec3& x) const;
    [[nodiscard]] double worst_around(VertexId v, const Vec3& x) const;
    bool improve_by_flips(TriangleId t);
    bool improve_by_moves(VertexId v);
    bool improve_by_collapses(TriangleId t);

    RemeshState& state_;
};

double ShapeImprover::edges_around(TriangleId t, VertexId v, const Vec3& x) const {
    const auto at = [&](HalfEdge h) -> const Vec3& {
        return mesh().origin(h) == v ? x : mesh().points[mesh().origin(h)];
    };
    const Vec3 &a = at(3 * t), &b = at(3 * t + 1), &c = at(3 * t + 2);
    return (a - b).norm() + (b - c).norm() + (c - a).norm();
}

double ShapeImprover::evenness_across(HalfEdge h, VertexId v, const Vec3& x) const {
    const HalfEdge twin = mesh().twin(h);
    if (mesh().is_hole(mesh().patch_at(twin))) return 1.0;
    const double ratio = edges_around(EditMesh::triangle_of(h), v, x) /
                         edges_around(EditMesh::triangle_of(twin), v, x);
    return 0.5 * kUneven * std::min(ratio, 1.0 / ratio);
}

double ShapeImprover::quality_of(TriangleId t) const {
    const VertexId v = mesh().origin(3 * t);
    const Vec3& x = mesh().points[v];
    double worst = shape_quality(x, mesh().points[mesh().origin(3 * t + 1)],
                                 mesh().points[mesh().origin(3 * t + 2)]);
    for (HalfEdge h = 3 * t; h < 3 * t + 3; ++h) worst = std::min(worst, evenness_across(h, v, x));
    return worst;
}

double ShapeImprover::worst_around(VertexId v, const Vec3& x) const {
    double worst = 1.0;
    mesh().for_each_leaving(v, [&](HalfEdge h) {
        if (mesh().is_hole(mesh().patch_at(h))) return;
        worst = std::min(
            {worst,
             shape_quality(x, mesh().points[mesh().target(h)], mesh().points[mesh().apex(h)]),
             evenness_across(h, v, x), evenness_across(EditMesh::next(h), v, x)});
    });
    return worst;
}

bool ShapeImprover::improve_by_flips(TriangleId t) {
    for (HalfEdge h = 3 * t; h < 3 * t + 3; ++h) {
        if (!mesh().can_flip(h) || !state_.flip_keeps_shape(h)) continue;
        const Vec3 &a = mesh().points[mesh().origin(h)], &b = mesh().points[mesh().target(h)],
                   &c = mesh().points[mesh().apex(h)],
                   &d = mesh().points[mesh().apex(mesh().twin(h))];
        const double before = std::min(shape_quality(a, b, c), shape_quality(b, a, d));
        if (std::min(shape_quality(a, d, c), shape_quality(b, c, d)) < before + kGain) continue;
        mesh().flip(h);
        return true;
    }
    return false;
}

template <class Score>
std::optional<TargetPlace> ShapeImprover::better_place(VertexId v, double first_step,
                                                       double last_step, const Score& score) const {
    constexpr double kHalf = 0.5 * std::numbers::sqrt2;
    constexpr double kDirections[8][2] = {{1, 0},          {-1, 0},        {0, 1},
                                          {0, -1},         {kHalf, kHalf}, {-kHalf, -kHalf},
                                          {-kHalf, kHalf}, {kHalf, -kHalf}};
    std::optional<TargetPlace> found;
    if (mesh().leaving(v) == EditMesh::kNone || state_.is_hub(v) || state_.rests(v)) return found;
    if (state_.is_anchored(v)) return found;
    const RemeshState::VertexKind kind = state_.kind_of(v);
    if (kind.features != 0 && kind.features != 2) return found;
    Vec3 at = mesh().points[v];
    double best = score(v, at) + kGain;
    const Vec3 normal = state_.normal_at(v), x = normal.unitOrthogonal(), y = normal.cross(x);
    for (double step = first_step * state_.sizes[v]; step > last_step * state_.sizes[v];
         step *= 0.5) {
        const Vec3 from = at;
        for (const auto& [along_x, along_y] : kDirections) {
            const Vec3 raw = from + step * (along_x * x + along_y * y);
            if (kind.features == 0 && score(v, raw) <= best) continue;  // spares the search
            const TargetPlace place = state_.place_for(v, kind, raw);
            if (!place.normal.isZero(0.0) && place.normal.dot(normal) < 0.0) continue;
            const double reached = score(v, place.point);
            if (reached <= best || !state_.move_keeps_shape(v, place.point)) continue;
            best = reached + kGain;
            at = place.point;
            found = place;
        }
    }
    return found;
}

bool ShapeImprover::improve_by_moves(VertexId v) {
    const auto place = better_place(
        v, 0.2, 0.01, [this](VertexId u, const Vec3& x) { return worst_around(u, x); });
    if (place) state_.move(v, *place);
    return place.has_value();
}

/// Minus the sum of the badness of the triangles at v if it were at x.
double ShapeImprover::shape_around(VertexId v, const Vec3& x) const {
    double sum = 0.0;
    mesh().for_each_leaving(v, [&](HalfEdge h) {
        if (!mesh().is_hole(mesh().patch_at(h)))
            sum += badness(x, mesh().points[mesh().target(h)], mesh().points[mesh().apex(h)]);
    });
    return -sum;
}

bool ShapeImprover::flip_polishes(HalfEdge h) const {
    if (mesh().origin(h) == EditMesh::kNone || h > mesh().twin(h)) return false;
    if (state_.rests(mesh().origin(h)) && state_.rests(mesh().target(h))) return false;
    const Vec3 &a = mesh().points[mesh().origin(h)], &b = mesh().points[mesh().target(h)],
               &c = mesh().points[mesh().apex(h)], &d = mesh().points[mesh().apex(mesh().twin(h))];
    const double before = badness(a, b, c) + badness(b, a, d);
    return badness(a, d, c) + badness(b, c, d) <= before - kGain && mesh().can_flip(h) &&
           state_.flip_keeps_shape(h);
}

void ShapeImprover::polish() {
    for (const HalfEdge h : selected(mesh().half_edge_count(), state_.cancel,
                                     [this](HalfEdge k) { return flip_polishes(k); }))
        if (flip_polishes(h)) mesh().flip(h);
    const auto score = [this](VertexId u, const Vec3& x) { return shape_around(u, x); };
    std::vector<std::optional<TargetPlace>> places(mesh().vertex_count());
    for_all(places.size(), state_.cancel,
            [&](VertexId v) { places[v] = better_place(v, 0.1, 0.02, score); });
    for (VertexId v = 0; v < places.size(); ++v) {  // neighbours may have moved
        state_.check_cancelled();
        if (places[v] && score(v, places[v]->point) > score(v, mesh().points[v]) &&
            state_.move_keeps_shape(v, places[v]->point))
            state_.move(v, *places[v]);
    }
}

bool ShapeImprover::improve_by_collapses(TriangleId t) {
    for (HalfEdge h = 3 * t; h < 3 * t + 3; ++h)
        for (const HalfEdge k : {h, mesh().twin(h)}) {
            if (!state_.may_collapse(k, RemeshState::kLong)) continue;
            const VertexId a = mesh().origin(k), b = mesh().target(k);
            double after = 1.0;
            mesh().for_each_leaving(a, [&](HalfEdge e) {
                const VertexId u = mesh().target(e), w = mesh().apex(e);
                if (u == b || w == b || mesh().is_hole(mesh().patch_at(e))) return;
                after = std::min(
                    after, shape_quality(mesh().points[b], mesh().points[u], mesh().points[w]));
            });
            if (after < worst_around(a, mesh().points[a]) + kGain) continue;
            mesh().collapse(k);
            return true;
        }
    return false;
}

double ShapeImprover::improve_worst(double wanted_quality) {
    std::vector<std::pair<double, TriangleId>> bad;
    for (int round = 0; round < kMostRounds; ++round) {
        bad.clear();
        for (const TriangleId t :
             selected(mesh().triangle_count(), state_.cancel, [&](TriangleId s) {
                 return mesh().is_alive(s) && !mesh().is_hole(mesh().patch(s)) &&
                        quality_of(s) < wanted_quality;
             }))
            bad.emplace_back(quality_of(t), t);
        std::sort(bad.begin(), bad.end());
        bool improved = false;
        for (const auto& [q, t] : bad) {
            state_.check_cancelled();
            if (!mesh().is_alive(t) || quality_of(t) >= wanted_quality) continue;
            if (improve_by_flips(t) || (q < 0.5 * wanted_quality && improve_by_collapses(t))) {
                improved = true;
                continue;
            }
            for (HalfEdge h = 3 * t; h < 3 * t + 3; ++h)
                improved |= improve_by_moves(mesh().origin(h));
        }
        if (!improved) break;
    }
    return bad.empty() ? wanted_quality : bad.front().first;
}

}  // namespace

void polish(RemeshState& state) {
    ShapeImprover(state).polish();
}

double improve_worst(RemeshState& state, double quality) {
    return ShapeImprover(state).improve_worst(quality);
}

}  // namespace vesselbench
