#include "meshing/remeshing/improve_worst.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/kernel/triangle_shape.h"

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

/// The summand minimised by polishing: the radius ratio reflects the whole shape, the skewness the
/// worst angle.
double badness(const Vec3& a, const Vec3& b, const Vec3& c) {
    return 0.2 * equiangle_skewness(a, b, c) + 1.0 - radius_ratio(a, b, c);
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

    /// Moves a vertex to the best of some places around it if `score` (vertex, place) rates it
    /// higher than the current one.
    template <class Score>
    bool try_places(VertexId v, double first_step, double last_step, const Score& score);

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
bool ShapeImprover::try_places(VertexId v, double first_step, double last_step,
                               const Score& score) {
    constexpr int kDirections = 8;
    const RemeshState::VertexKind kind = state_.kind_of(v);
    if (state_.is_hub(v) || (kind.features != 0 && kind.features != 2)) return false;
    bool improved = false;
    double best = score(v, mesh().points[v]) + kGain;
    for (double step = first_step * state_.sizes[v]; step > last_step * state_.sizes[v];
         step *= 0.5) {
        const Vec3 normal = state_.normal_at(v), x = normal.unitOrthogonal(), y = normal.cross(x);
        std::optional<TargetPlace> better;
        for (int i = 0; i < kDirections; ++i) {
            const double turn = 2.0 * std::numbers::pi * i / kDirections;
            const Vec3 raw = mesh().points[v] + step * (std::cos(turn) * x + std::sin(turn) * y);
            if (kind.features == 0 && score(v, raw) <= best) continue;  // spares the search
            const TargetPlace place = state_.place_for(v, kind, raw);
            if (!place.normal.isZero(0.0) && place.normal.dot(normal) < 0.0) continue;
            const double reached = score(v, place.point);
            if (reached <= best || !state_.move_keeps_shape(v, place.point)) continue;
            best = reached + kGain;
            better = place;
        }
        if (better) state_.move(v, *better);
        improved |= better.has_value();
    }
    return improved;
}

bool ShapeImprover::improve_by_moves(VertexId v) {
    return try_places(v, 0.2, 0.01,
                      [this](VertexId u, const Vec3& x) { return worst_around(u, x); });
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

void ShapeImprover::polish() {
    for (HalfEdge h = 0; h < mesh().half_edge_count(); ++h) {
        if (mesh().origin(h) == EditMesh::kNone || h > mesh().twin(h)) continue;
        const Vec3 &a = mesh().points[mesh().origin(h)], &b = mesh().points[mesh().target(h)],
                   &c = mesh().points[mesh().apex(h)],
                   &d = mesh().points[mesh().apex(mesh().twin(h))];
        const double before = badness(a, b, c) + badness(b, a, d);
        if (badness(a, d, c) + badness(b, c, d) > before - kGain) continue;
        if (mesh().can_flip(h) && state_.flip_keeps_shape(h)) mesh().flip(h);
    }
    for (VertexId v = 0; v < mesh().vertex_count(); ++v)
        if (mesh().leaving(v) != EditMesh::kNone)
            try_places(v, 0.1, 0.02,
                       [this](VertexId u, const Vec3& x) { return shape_around(u, x); });
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
        for (TriangleId t = 0; t < mesh().triangle_count(); ++t)
            if (mesh().is_alive(t) && !mesh().is_hole(mesh().patch(t)))
                if (const double q = quality_of(t); q < wanted_quality) bad.emplace_back(q, t);
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
