// The last pass of remeshing: works on single bad triangles, which averages do not see.

#include <algorithm>
#include <cmath>
#include <numbers>

#include "meshing/remeshing/remesher.h"
#include "meshing/remeshing/triangle_shape.h"

namespace vesselbench {

namespace {

constexpr int kMostRounds = 10;
constexpr double kGain = 1e-3;  // smallest improvement that counts: ends endless exchanges

/// Two triangles at an edge whose mean edges differ by more than this factor count as bad: a little
/// below the gradation of 1.5 that is promised by default.
constexpr double kUneven = 1.46;

double shape_quality(const Vec3& a, const Vec3& b, const Vec3& c) {
    return std::min(1.0 - equiangle_skewness(a, b, c), radius_ratio(a, b, c));
}

/// What polishing lowers the sum of: the radius ratio sees all of the shape, the skewness the
/// worst angle.
double badness(const Vec3& a, const Vec3& b, const Vec3& c) {
    return 0.2 * equiangle_skewness(a, b, c) + 1.0 - radius_ratio(a, b, c);
}

}  // namespace

double Remesher::edges_around(TriangleId t, VertexId v, const Vec3& x) const {
    const auto at = [&](HalfEdge h) -> const Vec3& {
        return mesh_.origin(h) == v ? x : mesh_.points[mesh_.origin(h)];
    };
    const Vec3 &a = at(3 * t), &b = at(3 * t + 1), &c = at(3 * t + 2);
    return (a - b).norm() + (b - c).norm() + (c - a).norm();
}

double Remesher::evenness_across(HalfEdge h, VertexId v, const Vec3& x) const {
    const HalfEdge twin = mesh_.twin(h);
    if (mesh_.is_hole(mesh_.patch_at(twin))) return 1.0;
    const double ratio = edges_around(EditMesh::triangle_of(h), v, x) /
                         edges_around(EditMesh::triangle_of(twin), v, x);
    return 0.5 * kUneven * std::min(ratio, 1.0 / ratio);
}

double Remesher::quality_of(TriangleId t) const {
    const VertexId v = mesh_.origin(3 * t);
    const Vec3& x = mesh_.points[v];
    double worst = shape_quality(x, mesh_.points[mesh_.origin(3 * t + 1)],
                                 mesh_.points[mesh_.origin(3 * t + 2)]);
    for (HalfEdge h = 3 * t; h < 3 * t + 3; ++h) worst = std::min(worst, evenness_across(h, v, x));
    return worst;
}

double Remesher::worst_around(VertexId v, const Vec3& x) const {
    double worst = 1.0;
    mesh_.for_each_leaving(v, [&](HalfEdge h) {
        if (mesh_.is_hole(mesh_.patch_at(h))) return;
        worst = std::min(
            {worst, shape_quality(x, mesh_.points[mesh_.target(h)], mesh_.points[mesh_.apex(h)]),
             evenness_across(h, v, x), evenness_across(EditMesh::next(h), v, x)});
    });
    return worst;
}

bool Remesher::improve_by_flips(TriangleId t) {
    for (HalfEdge h = 3 * t; h < 3 * t + 3; ++h) {
        if (!mesh_.can_flip(h) || !flip_keeps_shape(h)) continue;
        const Vec3 &a = mesh_.points[mesh_.origin(h)], &b = mesh_.points[mesh_.target(h)],
                   &c = mesh_.points[mesh_.apex(h)], &d = mesh_.points[mesh_.apex(mesh_.twin(h))];
        const double before = std::min(shape_quality(a, b, c), shape_quality(b, a, d));
        if (std::min(shape_quality(a, d, c), shape_quality(b, c, d)) < before + kGain) continue;
        mesh_.flip(h);
        return true;
    }
    return false;
}

template <class Score>
bool Remesher::try_places(VertexId v, double first_step, double last_step, const Score& score) {
    constexpr int kDirections = 8;
    const VertexKind kind = kind_of(v);
    if (is_hub(v) || (kind.features != 0 && kind.features != 2)) return false;
    bool improved = false;
    double best = score(v, mesh_.points[v]) + kGain;
    for (double step = first_step * size_[v]; step > last_step * size_[v]; step *= 0.5) {
        const Vec3 normal = normal_at(v), x = normal.unitOrthogonal(), y = normal.cross(x);
        std::optional<TargetPlace> better;
        for (int i = 0; i < kDirections; ++i) {
            const double turn = 2.0 * std::numbers::pi * i / kDirections;
            const Vec3 raw = mesh_.points[v] + step * (std::cos(turn) * x + std::sin(turn) * y);
            if (kind.features == 0 && score(v, raw) <= best) continue;  // spares the search
            const TargetPlace place = place_for(v, kind, raw);
            if (!place.normal.isZero(0.0) && place.normal.dot(normal) < 0.0) continue;
            const double reached = score(v, place.point);
            if (reached <= best || !move_keeps_shape(v, place.point)) continue;
            best = reached + kGain;
            better = place;
        }
        if (better) move(v, *better);
        improved |= better.has_value();
    }
    return improved;
}

bool Remesher::improve_by_moves(VertexId v) {
    return try_places(v, 0.2, 0.01,
                      [this](VertexId u, const Vec3& x) { return worst_around(u, x); });
}

/// Minus the sum of the badness of the triangles at v if it were at x.
double Remesher::shape_around(VertexId v, const Vec3& x) const {
    double sum = 0.0;
    mesh_.for_each_leaving(v, [&](HalfEdge h) {
        if (!mesh_.is_hole(mesh_.patch_at(h)))
            sum += badness(x, mesh_.points[mesh_.target(h)], mesh_.points[mesh_.apex(h)]);
    });
    return -sum;
}

void Remesher::polish() {
    for (HalfEdge h = 0; h < mesh_.half_edge_count(); ++h) {
        if (mesh_.origin(h) == EditMesh::kNone || h > mesh_.twin(h)) continue;
        const Vec3 &a = mesh_.points[mesh_.origin(h)], &b = mesh_.points[mesh_.target(h)],
                   &c = mesh_.points[mesh_.apex(h)], &d = mesh_.points[mesh_.apex(mesh_.twin(h))];
        const double before = badness(a, b, c) + badness(b, a, d);
        if (badness(a, d, c) + badness(b, c, d) > before - kGain) continue;
        if (mesh_.can_flip(h) && flip_keeps_shape(h)) mesh_.flip(h);
    }
    for (VertexId v = 0; v < mesh_.vertex_count(); ++v)
        if (mesh_.leaving(v) != EditMesh::kNone)
            try_places(v, 0.1, 0.02,
                       [this](VertexId u, const Vec3& x) { return shape_around(u, x); });
}

bool Remesher::improve_by_collapses(TriangleId t) {
    for (HalfEdge h = 3 * t; h < 3 * t + 3; ++h)
        for (const HalfEdge k : {h, mesh_.twin(h)}) {
            if (!may_collapse(k, kLong)) continue;
            const VertexId a = mesh_.origin(k), b = mesh_.target(k);
            double after = 1.0;
            mesh_.for_each_leaving(a, [&](HalfEdge e) {
                const VertexId u = mesh_.target(e), w = mesh_.apex(e);
                if (u == b || w == b || mesh_.is_hole(mesh_.patch_at(e))) return;
                after = std::min(after,
                                 shape_quality(mesh_.points[b], mesh_.points[u], mesh_.points[w]));
            });
            if (after < worst_around(a, mesh_.points[a]) + kGain) continue;
            mesh_.collapse(k);
            return true;
        }
    return false;
}

double Remesher::improve_worst(double wanted_quality) {
    std::vector<std::pair<double, TriangleId>> bad;
    for (int round = 0; round < kMostRounds; ++round) {
        bad.clear();
        for (TriangleId t = 0; t < mesh_.triangle_count(); ++t)
            if (mesh_.is_alive(t) && !mesh_.is_hole(mesh_.patch(t)))
                if (const double q = quality_of(t); q < wanted_quality) bad.emplace_back(q, t);
        std::sort(bad.begin(), bad.end());
        bool improved = false;
        for (const auto& [q, t] : bad) {
            if (!mesh_.is_alive(t) || quality_of(t) >= wanted_quality) continue;
            if (improve_by_flips(t) || (q < 0.5 * wanted_quality && improve_by_collapses(t))) {
                improved = true;
                continue;
            }
            for (HalfEdge h = 3 * t; h < 3 * t + 3; ++h)
                improved |= improve_by_moves(mesh_.origin(h));
        }
        if (!improved) break;
    }
    return bad.empty() ? wanted_quality : bad.front().first;
}

}  // namespace vesselbench
