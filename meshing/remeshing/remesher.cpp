#include "meshing/remeshing/remesher.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include "geometry/kernel/diagnosed_error.h"
#include "meshing/remeshing/selected.h"

namespace vesselbench {

namespace {

// Botsch & Kobbelt's limits: splitting and collapsing then do not undo each other.
constexpr double kShort = 4.0 / 5.0;

// Longest edges that may be collapsed for better valences, and longest edges that may result:
// slightly above twice the height of an equilateral triangle. Flips and moves shorten those.
constexpr double kDefect = 1.2, kAfterDefect = 1.8;

/// The edges in a scattered order: in index order every second row of a regular grid would be
/// collapsed, and the remaining rows would stay too far apart in one direction.
std::vector<EditMesh::HalfEdge> scattered(std::vector<EditMesh::HalfEdge> edges) {
    constexpr std::uint32_t kGolden = 2654435769U;  // odd: no two edges share a place
    std::sort(edges.begin(), edges.end(),
              [](std::uint32_t g, std::uint32_t h) { return g * kGolden < h * kGolden; });
    return edges;
}

constexpr double kMostLift =
    0.08;  // in target edges: a third more than the lift for 9 edges around

constexpr int kMostPasses = 12;  // of splits or collapses in one step; each halves the rest

/// Edges too long by this factor belong to a coarse source; they are split in steps of this factor.
constexpr double kCoarse = 8.0, kCoarseStep = 1.3;

/// Vertices around which the last pass changed something: the next one visits only those.
class Touched {
public:
    explicit Touched(std::size_t vertices) : now_(vertices, 1), next_(vertices, 1) {}

    void begin_pass() {
        now_.swap(next_);
        std::fill(next_.begin(), next_.end(), std::uint8_t{0});
        any_ = false;
        ++passes_;
    }

    void add(VertexId v) {
        now_[v] = next_[v] = 1;
        any_ = true;
    }

    [[nodiscard]] bool operator[](VertexId v) const { return now_[v] != 0; }

    [[nodiscard]] bool any() const { return any_; }

    [[nodiscard]] int passes() const { return passes_; }

private:
    std::vector<std::uint8_t> now_, next_;
    bool any_ = false;
    int passes_ = 0;
};

double cotangent(const Vec3& at, const Vec3& p, const Vec3& q) {
    const Vec3 u = p - at, w = q - at;
    return u.dot(w) / std::max(u.cross(w).norm(), 1e-300);
}

}  // namespace

bool Remesher::is_long(HalfEdge h, double limit) const {
    const VertexId a = mesh.origin(h), b = mesh.target(h);
    if (a == EditMesh::kNone || a > b || !is_above(h, limit) || rests(h)) return false;
    if (is_anchored_rim(h)) return false;
    return !(mesh.is_hole(mesh.patch_at(h)) && mesh.is_hole(mesh.patch_at(mesh.twin(h))));
}

double Remesher::longest_share() const {
    return tbb::parallel_reduce(
        tbb::blocked_range<std::size_t>(0, mesh.half_edge_count(), 4096), 0.0,
        [&](const auto& range, double longest) {
            for (std::size_t i = range.begin(); i != range.end(); ++i) {
                const auto h = static_cast<HalfEdge>(i);
                if (is_long(h, longest))
                    longest = length(h) / wanted(mesh.origin(h), mesh.target(h));
            }
            return longest;
        },
        [](double one, double other) { return std::max(one, other); });
}

void Remesher::check_size() const {
    if (mesh.triangle_count() <= kMostAtOnce) return;
    throw DiagnosedFailure({.code = "remeshing-too-fine",
                            .operation = "remesh",
                            .figures = {{"most_millions", static_cast<double>(kMostAtOnce) / 1e6}},
                            .remedies = {{.arguments = {{"edge", ""}}}}});
}

void Remesher::set_sizes(const std::vector<double>& source_sizes) {
    constexpr int kRings = 3;
    constexpr double kSame = 0.99;
    target.set_sizes(source_sizes);
    std::vector<std::uint8_t> rest(mesh.vertex_count(), 1);
    for_all(rest.size(), cancel, [&](VertexId v) {
        if (mesh.leaving(v) == EditMesh::kNone || is_hub(v)) return;
        const VertexKind kind = kind_of(v);
        if (kind.features != 0 && kind.features != 2) return;
        const double before = sizes[v];
        move(v, place_for(v, kind, mesh.points[v]));
        if (sizes[v] < kSame * before) rest[v] = 0;
    });
    rest_beyond(std::move(rest), kRings);
}

void Remesher::rest_beyond(std::vector<std::uint8_t> rest, int rings) {
    rest.resize(mesh.vertex_count(), 1);
    for (int ring = 0; ring < rings; ++ring) {
        const std::vector<std::uint8_t> last = rest;
        for_all(rest.size(), cancel, [&](VertexId v) {
            if (mesh.leaving(v) == EditMesh::kNone || is_hub(v)) return;
            mesh.for_each_leaving(v, [&](HalfEdge h) {
                if (last[mesh.target(h)] == 0) rest[v] = 0;
            });
        });
    }
    resting = std::move(rest);
}

void Remesher::split_long_edges(double limit) {
    // In a coarse source the longest edges are split first: in arbitrary order its triangles would
    // become slivers of slivers, millions out of fifty.
    for (double coarse = longest_share() / kCoarseStep; coarse > kCoarse * limit;
         coarse /= kCoarseStep)
        split_edges_above(coarse);
    split_edges_above(limit);
}

void Remesher::split_edges_above(double limit) {
    for (int pass = 0; pass < kMostPasses; ++pass) {
        const auto edges =
            selected(mesh.half_edge_count(), cancel, [&](HalfEdge h) { return is_long(h, limit); });
        if (edges.empty()) return;
        for (const HalfEdge h : edges) {
            check_cancelled();
            check_size();
            const VertexId m = split(h);
            const TargetPlace place = place_for(m, kind_of(m), mesh.points[m]);
            if (move_keeps_shape(m, place.point)) move(m, place);
        }
    }
}

bool Remesher::is_short(HalfEdge h) const {
    const VertexId a = mesh.origin(h), b = mesh.target(h);
    return a != EditMesh::kNone && a < b && !is_above(h, kShort) && !rests(h) && !is_hub(a) &&
           !is_hub(b);
}

void Remesher::collapse_short_edges() {
    Touched touched(mesh.vertex_count());
    const auto may = [&](HalfEdge h) {
        return is_short(h) && (touched[mesh.origin(h)] || touched[mesh.target(h)]) &&
               (may_collapse(h, kLong) || may_collapse(mesh.twin(h), kLong));
    };
    do {
        touched.begin_pass();
        for (const HalfEdge h : scattered(selected(mesh.half_edge_count(), cancel, may))) {
            check_cancelled();
            if (!is_short(h)) continue;
            const VertexId a = mesh.origin(h), b = mesh.target(h);
            const bool to_b = may_collapse(h, kLong);
            if (!to_b && !may_collapse(mesh.twin(h), kLong)) continue;
            mesh.collapse(to_b ? h : mesh.twin(h));
            mesh.for_each_leaving(to_b ? b : a, [&](HalfEdge k) { touched.add(mesh.target(k)); });
        }
    } while (touched.any() && touched.passes() < kMostPasses);
    compact();
}

void Remesher::count_valences() {
    valence_.assign(mesh.vertex_count(), 0);
    for (HalfEdge h = 0; h < mesh.half_edge_count(); ++h)
        if (mesh.origin(h) != EditMesh::kNone) ++valence_[mesh.origin(h)];
}

int Remesher::collapse_valence_excess(HalfEdge h) const {
    const auto square = [](int off) { return off * off; };
    const int a = valence_[mesh.origin(h)] - 6, b = valence_[mesh.target(h)] - 6,
              c = valence_[mesh.apex(h)] - 6, d = valence_[mesh.apex(mesh.twin(h))] - 6;
    return square(a + b + 2) + square(c - 1) + square(d - 1) - square(a) - square(b) - square(c) -
           square(d);
}

bool Remesher::is_defect(HalfEdge h) const {
    const VertexId a = mesh.origin(h), b = mesh.target(h);
    return a != EditMesh::kNone && collapse_valence_excess(h) <= 0 && !is_above(h, kDefect) &&
           !rests(h) && !is_hub(a) && !is_hub(b);
}

void Remesher::collapse_defects() {
    count_valences();
    for (const HalfEdge h : scattered(selected(mesh.half_edge_count(), cancel, [&](HalfEdge k) {
             return is_defect(k) && may_collapse(k, kAfterDefect);
         }))) {
        check_cancelled();
        if (!is_defect(h) || !may_collapse(h, kAfterDefect)) continue;
        --valence_[mesh.apex(h)];
        --valence_[mesh.apex(mesh.twin(h))];
        valence_[mesh.target(h)] += valence_[mesh.origin(h)] - 4;
        mesh.collapse(h);
    }
    compact();
}

int Remesher::flip_valence_excess(HalfEdge h) const {
    // Rims count like any vertex: three triangles on each side make six.
    const auto gap = [&](VertexId v, int change) {
        const int off = valence_[v] - 6;
        return (off + change) * (off + change) - off * off;
    };
    return gap(mesh.origin(h), -1) + gap(mesh.target(h), -1) + gap(mesh.apex(h), 1) +
           gap(mesh.apex(mesh.twin(h)), 1);
}

bool Remesher::flip_helps(HalfEdge h, FlipRule rule) const {
    if (mesh.origin(h) == EditMesh::kNone || h > mesh.twin(h)) return false;
    if (mesh.is_feature(h) || mesh.is_hole(mesh.patch_at(h)) || rests(h)) return false;
    if (rule == FlipRule::Valence) return flip_valence_excess(h) < 0;
    const Vec3 &a = mesh.points[mesh.origin(h)], &b = mesh.points[mesh.target(h)],
               &c = mesh.points[mesh.apex(h)], &d = mesh.points[mesh.apex(mesh.twin(h))];
    return cotangent(c, a, b) + cotangent(d, a, b) < -1e-9;
}

void Remesher::flip_edges(FlipRule rule) {
    count_valences();
    Touched touched(mesh.vertex_count());
    do {
        touched.begin_pass();
        const auto edges = selected(mesh.half_edge_count(), cancel, [&](HalfEdge h) {
            if (mesh.origin(h) == EditMesh::kNone) return false;
            return (touched[mesh.origin(h)] || touched[mesh.target(h)]) && flip_helps(h, rule) &&
                   mesh.can_flip(h) && flip_keeps_shape(h);
        });
        for (const HalfEdge h : edges) {
            check_cancelled();
            if (!flip_helps(h, rule) || !mesh.can_flip(h) || !flip_keeps_shape(h)) continue;
            const VertexId a = mesh.origin(h), b = mesh.target(h), c = mesh.apex(h),
                           d = mesh.apex(mesh.twin(h));
            mesh.flip(h);
            --valence_[a], --valence_[b], ++valence_[c], ++valence_[d];
            for (const VertexId v : {a, b, c, d}) touched.add(v);
        }
    } while (touched.any() && touched.passes() < kMostPasses);
}

/// The middle of its rim neighbours, measured in target lengths.
Vec3 Remesher::middle_on_rim(VertexId v) const {
    Vec3 sum = Vec3::Zero();
    double weights = 0.0;
    mesh.for_each_leaving(v, [&](HalfEdge h) {
        if (!mesh.is_feature(h)) return;
        const double weight = 1.0 / wanted(v, mesh.target(h));
        sum += weight * mesh.points[mesh.target(h)];
        weights += weight;
    });
    return sum / weights;
}

Vec3 Remesher::centroid_around(VertexId v) const {
    const Vec3& at = mesh.points[v];
    Vec3 sum = Vec3::Zero();
    double weights = 0.0;
    mesh.for_each_leaving(v, [&](HalfEdge h) {
        const VertexId u = mesh.target(h), w = mesh.apex(h);
        const double size = (sizes[v] + sizes[u] + sizes[w]) / 3.0;
        const double weight = mesh.area_normal_of(EditMesh::triangle_of(h)).norm() / (size * size);
        sum += weight / 3.0 * (at + mesh.points[u] + mesh.points[w]);
        weights += weight;
    });
    return weights > 0.0 ? Vec3(sum / weights) : at;
}

Vec3 Remesher::shapely_position(VertexId v) const {
    const double height = 0.5 * std::sqrt(3.0);
    Vec3 sum = Vec3::Zero();
    double count = 0.0;
    mesh.for_each_leaving(v, [&](HalfEdge h) {
        const Vec3 &u = mesh.points[mesh.target(h)], &w = mesh.points[mesh.apex(h)];
        const Vec3 inward = mesh.area_normal_of(EditMesh::triangle_of(h)).cross(w - u);
        const double length = inward.norm();
        if (!(length > 0.0)) return;
        sum += 0.5 * (u + w) + (height * (w - u).norm() / length) * inward;
        count += 1.0;
    });
    return count > 0.0 ? Vec3(sum / count) : mesh.points[v];
}

Vec3 Remesher::relaxed_position(VertexId v, const VertexKind& kind, const Vec3& normal,
                                RelaxRule rule) const {
    if (kind.features == 2) return middle_on_rim(v);
    const Vec3& at = mesh.points[v];
    const Vec3 step = (rule == RelaxRule::Size ? centroid_around(v) : shapely_position(v)) - at;
    return at + step - step.dot(normal) * normal;
}

void Remesher::relax(RelaxRule rule) {
    std::vector<std::optional<TargetPlace>> places(mesh.vertex_count());
    for_all(places.size(), cancel, [&](VertexId v) {
        if (mesh.leaving(v) == EditMesh::kNone || is_hub(v) || RemeshState::rests(v)) return;
        if (is_anchored(v)) return;
        const VertexKind kind = kind_of(v);
        if (kind.features != 0 && kind.features != 2) return;
        const Vec3 normal = normal_at(v);
        const TargetPlace place = place_for(v, kind, relaxed_position(v, kind, normal, rule));
        // Near another wall the closest place may be on that wall.
        if (!place.normal.isZero(0.0) && place.normal.dot(normal) < 0.0) return;
        places[v] = place;
    });
    for (VertexId v = 0; v < places.size(); ++v) {
        check_cancelled();
        if (places[v] && move_keeps_shape(v, places[v]->point)) move(v, *places[v]);
    }
}

void Remesher::keep_volume() {
    Positions lifted = mesh.points;
    for_all(lifted.size(), cancel, [&](VertexId v) {
        if (mesh.leaving(v) == EditMesh::kNone || is_hub(v) || is_anchored(v)) return;
        const VertexKind kind = kind_of(v);
        if (kind.features != 0 || target.plane_normal(kind.p)) return;
        const Vec3 normal = normal_at(v);
        double sum = 0.0, count = 0.0;
        mesh.for_each_leaving(v, [&](HalfEdge h) {
            const Vec3 middle = 0.5 * (mesh.points[v] + mesh.points[mesh.target(h)]);
            sum += (target.on_patch(kind.p, middle, hints[v]).point - middle).dot(normal);
            count += 1.0;
        });
        const double most = kMostLift * sizes[v];
        lifted[v] += std::clamp(sum / count, -most, most) * normal;
    });
    mesh.points = std::move(lifted);
}

}  // namespace vesselbench
