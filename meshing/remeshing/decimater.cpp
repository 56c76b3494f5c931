#include "meshing/remeshing/decimater.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "geometry/kernel/measure.h"
#include "geometry/kernel/triangle_shape.h"

namespace vesselbench {

namespace {

/// Weight of the squared distances from the merged vertices relative to those from the planes [-]:
/// where planes are ambiguous the middle is taken, and short edges collapse first.
constexpr double kPoints = 1e-5;

/// Weights below this are raised to it [-]. Much smaller ones ruin the free part to preserve the
/// rest, and the rest's border with it.
constexpr double kLeastWeight = 0.1;

/// At weight 0 a collapse costs at least as much as moving its ends by a third of the edge at
/// weight 1, so that even planar parts are kept until then.
constexpr double kKept = 0.1;

/// Finite penalties for triangles without area [-].
constexpr double kLeastDivisor = 1e-3;

/// Largest turn of a triangle's normal in one collapse (cosine).
constexpr double kLeastCosine = 0.2;

/// The normal of a triangle worse than this is arbitrary; the vertex's is used [-].
constexpr double kNoNormal = 0.02;

/// Triangles worse than this are only made from worse ones; 1 is equilateral [-].
constexpr double kLeastShape = 0.15;

/// Penalty factors for collapses that create bad triangles, 1 + kShape (1 / shape - 1), or turn
/// normals, 1 + kTurn (1 - cosine). Both were tuned on real surfaces: the mean and the largest
/// distance decrease together with the skewness.
constexpr double kShape = 0.05;
constexpr double kTurn = 50.0;

/// Weight of border edges: on a rim, few vertices define an opening's shape.
constexpr double kBorder = 3.0;

/// A place farther from the edge than this many edge lengths is rejected.
constexpr double kFarthest = 2.0;

/// Largest penalty (inverse) if all triangles are nearly degenerate.
constexpr double kLeastShare = 1e-6;

constexpr std::size_t kReportEvery = 1024;  // collapses

/// Cosine of the angle between two directions; 1 if one of them is zero.
double cosine(const Vec3& a, const Vec3& b) {
    const double lengths = a.norm() * b.norm();
    return lengths > 0.0 ? a.dot(b) / lengths : 1.0;
}

double importance_of(const Triangle& triangle, std::span<const double> weights) {
    if (weights.empty()) return 1.0;
    double weight = 0.0;
    for (const VertexId v : triangle) weight += weights[v] / 3.0;
    weight = std::max(weight, kLeastWeight);
    return 1.0 / (weight * weight);
}

/// Calls visit(u, w) for the other two corners of the triangles at a that survive a collapse of a
/// and b.
template <class Visit>
void for_each_survivor(const EditMesh& mesh, VertexId a, VertexId b, const Visit& visit) {
    mesh.for_each_leaving(a, [&](EditMesh::HalfEdge k) {
        const VertexId u = mesh.target(k), w = mesh.apex(k);
        if (u == b || w == b || mesh.is_hole(mesh.patch_at(k))) return;
        visit(EditMesh::triangle_of(k), u, w);
    });
}

}  // namespace

bool Decimater::Entry::operator<(const Entry& other) const {
    return std::tie(cost, edge) > std::tie(other.cost, other.edge);
}

Decimater::Decimater(const Surface& source, std::span<const double> weights,
                     std::span<const std::uint8_t> locked, ErrorBound* bound)
    : mesh_(source),
      quadrics_(mesh_.vertex_count()),
      areas_(mesh_.vertex_count(), 0.0),
      keep_(mesh_.vertex_count(), 0),
      locked_(locked.begin(), locked.end()),
      border_(mesh_.vertex_count(), 0),
      stamps_(mesh_.vertex_count(), 0),
      bound_(bound),
      centre_(bounds(source).centre()),
      triangles_(source.triangle_count()),
      start_triangles_(source.triangle_count()) {
    for (std::size_t v = 0; v < weights.size(); ++v) keep_[v] = weights[v] == 0.0;
    intact_ = keep_;
    locked_.resize(mesh_.vertex_count(), 0);
    add_quadrics(source, weights);
}

void Decimater::add_quadrics(const Surface& source, std::span<const double> weights) {
    for (TriangleId t = 0; t < source.triangle_count(); ++t) {
        const Triangle& triangle = source.triangles()[t];
        const Vec3 normal = mesh_.area_normal_of(t);
        const double importance = importance_of(triangle, weights);
        const double share = importance * normal.norm() / 6.0;
        for (int i = 0; i < 3; ++i) {
            const VertexId v = triangle[i];
            const Vec3 p = mesh_.points[v] - centre_;
            areas_[v] += normal.norm() / 6.0;
            quadrics_[v].add_plane(normal.stableNormalized(), p, share);
            quadrics_[v].add_point(p, kPoints * share);
            add_border(3 * t + i, importance);
        }
    }
}

/// Planes through a border edge, perpendicular to its triangle, hold the border in place.
void Decimater::add_border(HalfEdge h, double importance) {
    if (!mesh_.is_feature(h)) return;
    const VertexId a = mesh_.origin(h), b = mesh_.target(h);
    border_[a] = border_[b] = 1;
    const Vec3 along = mesh_.points[b] - mesh_.points[a];
    const Vec3 across =
        mesh_.area_normal_of(EditMesh::triangle_of(h)).cross(along).stableNormalized();
    for (const VertexId v : {a, b})
        quadrics_[v].add_plane(across, mesh_.points[v] - centre_,
                               0.5 * kBorder * importance * along.squaredNorm());
}

bool Decimater::is_current(const Entry& entry) const {
    const HalfEdge h = entry.edge;
    return mesh_.origin(h) != EditMesh::kNone && stamps_[mesh_.origin(h)] == entry.origin_stamp &&
           stamps_[mesh_.target(h)] == entry.target_stamp;
}

/// The place of the vertex merged from a and b, neither of them on a border.
Vec3 Decimater::place_inside(VertexId a, VertexId b, const Quadric& sum) const {
    const Vec3 middle = 0.5 * (mesh_.points[a] + mesh_.points[b]);
    const Vec3 least = centre_ + sum.least(middle - centre_);
    const double length = (mesh_.points[a] - mesh_.points[b]).norm();
    return (least - middle).norm() <= kFarthest * length ? least : middle;
}

std::optional<Decimater::Collapse> Decimater::best_collapse(HalfEdge h) {
    const HalfEdge g = mesh_.twin(h);
    const VertexId a = mesh_.origin(h), b = mesh_.target(h);
    Quadric sum = quadrics_[a];
    sum += quadrics_[b];
    const auto onto = [&](HalfEdge k) {
        const Vec3& place = mesh_.points[mesh_.target(k)];
        return Collapse{k, place, sum.at(place - centre_)};
    };
    if (border_[a] == 0 && border_[b] == 0) {
        const Vec3 place = place_inside(a, b, sum);
        return Collapse{h, place, sum.at(place - centre_)};
    }
    // The remaining vertices of a border do not move, so that they stay on the curve.
    if (border_[a] != 0 && border_[b] != 0 && !mesh_.is_feature(h)) return std::nullopt;
    if (border_[a] == 0) return onto(h);
    if (border_[b] == 0) return onto(g);
    const Collapse there = onto(h), back = onto(g);
    const bool to_b = there.cost <= back.cost;
    if (mesh_.can_collapse(to_b ? h : g)) return to_b ? there : back;
    return to_b ? back : there;
}

/// The direction of triangle t at v.
Vec3 Decimater::facing(TriangleId t, VertexId v) const {
    const Vec3 &a = mesh_.points[mesh_.origin(3 * t)], &b = mesh_.points[mesh_.origin(3 * t + 1)],
               &c = mesh_.points[mesh_.origin(3 * t + 2)];
    if (edge_area_ratio(a, b, c) >= kNoNormal) return mesh_.area_normal_of(t);
    Vec3 sum = Vec3::Zero();
    mesh_.for_each_leaving(v, [&](HalfEdge k) {
        if (!mesh_.is_hole(mesh_.patch_at(k)))
            sum += mesh_.area_normal_of(EditMesh::triangle_of(k));
    });
    return sum;
}

bool Decimater::folds(const Collapse& collapse) const {
    const VertexId a = mesh_.origin(collapse.edge), b = mesh_.target(collapse.edge);
    bool found = false;
    double worst_before = 1.0, worst_after = 1.0;
    for (const auto& [end, other] : {std::pair(a, b), std::pair(b, a)})
        for_each_survivor(mesh_, end, other, [&](TriangleId t, VertexId u, VertexId w) {
            const Vec3 &pu = mesh_.points[u], &pw = mesh_.points[w];
            const Vec3 before = facing(t, end);
            const Vec3 after = (pu - collapse.place).cross(pw - collapse.place);
            const bool vanishes = after.isZero(0.0) && !mesh_.area_normal_of(t).isZero(0.0);
            if (cosine(before, after) < kLeastCosine || vanishes) found = true;
            worst_before = std::min(worst_before, edge_area_ratio(mesh_.points[end], pu, pw));
            worst_after = std::min(worst_after, edge_area_ratio(collapse.place, pu, pw));
        });
    return found || (worst_after < kLeastShape && worst_after < worst_before);
}

/// Penalties beyond the quadrics: bad triangles, turned normals, and a vertex of tiny triangles
/// that also belongs to large ones.
double Decimater::penalty(const Collapse& collapse) const {
    const VertexId a = mesh_.origin(collapse.edge), b = mesh_.target(collapse.edge);
    double worst = 1.0, least_cosine = 1.0, area = 0.0;
    for (const auto& [end, other] : {std::pair(a, b), std::pair(b, a)})
        for_each_survivor(mesh_, end, other, [&](TriangleId t, VertexId u, VertexId w) {
            const Vec3 &pu = mesh_.points[u], &pw = mesh_.points[w];
            worst = std::min(worst, edge_area_ratio(collapse.place, pu, pw));
            const Vec3 before = facing(t, end);
            const Vec3 after = (pu - collapse.place).cross(pw - collapse.place);
            area += 0.5 * after.norm();
            least_cosine = std::min(least_cosine, cosine(before, after));
        });
    const double carried = 3.0 * (areas_[a] + areas_[b]);
    return std::max(1.0, area / std::max(carried, kLeastShare * area)) *
           (1.0 + kTurn * (1.0 - least_cosine)) *
           (1.0 + kShape * (1.0 / std::max(worst, kLeastDivisor) - 1.0));
}

double Decimater::full_cost(const Collapse& collapse) const {
    const VertexId a = mesh_.origin(collapse.edge), b = mesh_.target(collapse.edge);
    const double cost = collapse.cost * penalty(collapse);
    if (keep_[a] == 0 && keep_[b] == 0) return cost;
    const double square = (mesh_.points[a] - mesh_.points[b]).squaredNorm();
    return cost + kKept * (areas_[a] + areas_[b]) * square;
}

void Decimater::push(HalfEdge h) {
    const VertexId a = mesh_.origin(h), b = mesh_.target(h);
    if (locked_[a] != 0 || locked_[b] != 0) return;
    if (mesh_.is_hole(mesh_.patch_at(h)) && mesh_.is_hole(mesh_.patch_at(mesh_.twin(h)))) return;
    if (bound_ != nullptr && (keep_[a] != 0 || keep_[b] != 0)) return;  // no error is allowed
    const auto collapse = best_collapse(h);
    if (!collapse) return;
    const double cost = full_cost(*collapse);
    queue_.push({cost, h, stamps_[a], stamps_[b]});
}

void Decimater::push_all(const Progress& progress) {
    queue_ = {};
    for (HalfEdge h = 0; h < mesh_.half_edge_count(); ++h) {
        if (h % kReportEvery == 0) progress.check_cancelled();
        if (mesh_.origin(h) != EditMesh::kNone && h < mesh_.twin(h)) push(h);
    }
}

void Decimater::push_around(VertexId v) {
    mesh_.for_each_leaving(v, [&](HalfEdge h) { push(std::min(h, mesh_.twin(h))); });
}

void Decimater::lose(VertexId v) {
    kept_lost_ += intact_[v];
    intact_[v] = 0;
}

void Decimater::commit(const Collapse& collapse) {
    const HalfEdge h = collapse.edge;
    const VertexId a = mesh_.origin(h), b = mesh_.target(h);
    for (const HalfEdge k : {h, mesh_.twin(h)})
        if (!mesh_.is_hole(mesh_.patch_at(k))) --triangles_;
    lose(a);
    if (collapse.place != mesh_.points[b]) lose(b);
    mesh_.collapse(h);
    mesh_.points[b] = collapse.place;
    quadrics_[b] += quadrics_[a];
    areas_[b] += areas_[a];
    keep_[b] = keep_[a] | keep_[b];
    ++stamps_[b];
    push_around(b);
}

bool Decimater::try_collapse(const Entry& entry) {
    const auto collapse = best_collapse(entry.edge);
    if (!collapse || !mesh_.can_collapse(collapse->edge) || folds(*collapse)) return false;
    const double cost = full_cost(*collapse);
    if (cost > entry.cost && !queue_.empty()) {  // its neighbours have changed
        Entry later = entry;
        later.cost = cost;
        if (later < queue_.top()) {
            queue_.push(later);
            return false;
        }
    }
    if (bound_ != nullptr && !stays_near(*collapse)) return false;
    commit(*collapse);
    return true;
}

/// True if the bound permits the collapse, which it then records.
bool Decimater::stays_near(const Collapse& collapse) {
    const VertexId a = mesh_.origin(collapse.edge), b = mesh_.target(collapse.edge);
    std::vector<TriangleId> gone;
    std::vector<ErrorBound::Fresh> fresh;
    for (const HalfEdge k : {collapse.edge, mesh_.twin(collapse.edge)})
        if (!mesh_.is_hole(mesh_.patch_at(k))) gone.push_back(EditMesh::triangle_of(k));
    for (const auto& [end, other] : {std::pair(a, b), std::pair(b, a)})
        for_each_survivor(mesh_, end, other, [&](TriangleId t, VertexId u, VertexId w) {
            gone.push_back(t);
            fresh.push_back({t, collapse.place, mesh_.points[u], mesh_.points[w]});
        });
    if (!bound_->allows(gone, fresh)) return false;
    bound_->accept(gone, fresh);
    return true;
}

/// \return true if anything has collapsed
bool Decimater::work_off_queue(std::size_t triangles, const Progress& progress) {
    std::size_t visited = 0;
    bool changed = false;
    while (triangles_ > triangles && !queue_.empty()) {
        if (visited++ % kReportEvery == 0)
            progress.report(static_cast<double>(start_triangles_ - triangles_) /
                                static_cast<double>(start_triangles_ - triangles),
                            "decimating");
        const Entry entry = queue_.top();
        queue_.pop();
        if (is_current(entry)) changed |= try_collapse(entry);
    }
    return changed;
}

void Decimater::run(std::size_t triangles, const Progress& progress) {
    // A collapse rejected in one round may be permitted once its neighbours have changed.
    do push_all(progress);
    while (work_off_queue(triangles, progress) && triangles_ > triangles);
}

Surface Decimater::result(const std::vector<Patch>& patches) const {
    std::vector<VertexId> kept;
    return mesh_.to_surface(patches, kept);
}

}  // namespace vesselbench
