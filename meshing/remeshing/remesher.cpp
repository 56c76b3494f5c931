#include "meshing/remeshing/remesher.h"

#include <algorithm>
#include <cmath>

namespace vesselbench {

namespace {

// Botsch & Kobbelt's limits: splitting and collapsing then do not undo each other.
constexpr double kLong = Remesher::kLong, kShort = 4.0 / 5.0;

// Edges that may go for better valences, and the edges that this may leave: twice the height of an
// equilateral triangle, and a little. Flips and moves shorten those.
constexpr double kDefect = 1.2, kAfterDefect = 1.8;

/// A prime above any number of half-edges: i * kScatter mod count visits each edge once in a
/// scattered order. In the order of their numbers every second row of a regular grid would go, and
/// the rows that stay would be too far apart in one direction for ever.
constexpr std::uint64_t kScatter = 4294967311ULL;

constexpr double kMostLift = 0.05;  // in wanted edges: twice what 14 edges around ask for

constexpr int kMostPasses = 12;  // of splits or collapses in one step; each halves what is left

/// Edges this often too long belong to a coarse source; they go in steps of this factor.
constexpr double kCoarse = 8.0, kCoarseStep = 1.3;

/// Cosine of the largest turn of a triangle's normal that an edit may make.
constexpr double kTurn = 0.3;

/// Vertices around which the last pass changed something: the next one looks at those only.
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

bool turns_too_far(const Vec3& before, const Vec3& after) {
    const double scale = before.norm() * after.norm();
    return before.dot(after) <= kTurn * scale;
}

double cotangent(const Vec3& at, const Vec3& p, const Vec3& q) {
    const Vec3 u = p - at, w = q - at;
    return u.dot(w) / std::max(u.cross(w).norm(), 1e-300);
}

}  // namespace

Remesher::Remesher(const Surface& source, const std::vector<double>& sizes, const Surface& start)
    : target_(source, sizes),
      mesh_(start),
      patches_(source.patches),
      size_(mesh_.vertex_count(), *std::min_element(sizes.begin(), sizes.end())),
      near_(mesh_.vertex_count(), 0) {
    for (VertexId v = 0; v < mesh_.vertex_count(); ++v) {
        if (mesh_.leaving(v) == EditMesh::kNone || is_hub(v)) continue;
        const VertexKind kind = kind_of(v);
        if (kind.features == 0 || kind.features == 2) move(v, place_for(v, kind, mesh_.points[v]));
    }
}

Remesher::VertexKind Remesher::kind_of(VertexId v) const {
    VertexKind kind;
    kind.p = kind.q = mesh_.patch_at(mesh_.leaving(v));
    mesh_.for_each_leaving(v, [&](HalfEdge h) {
        kind.features += mesh_.is_feature(h);
        if (mesh_.patch_at(h) != kind.p) kind.q = mesh_.patch_at(h);
    });
    return kind;
}

bool Remesher::is_hub(VertexId v) const {
    const HalfEdge h = mesh_.leaving(v);
    return mesh_.is_hole(mesh_.patch_at(h)) && kind_of(v).features == 0;
}

TargetPlace Remesher::place_for(VertexId v, const VertexKind& kind, const Vec3& x) const {
    return kind.features == 0 ? target_.on_patch(kind.p, x, near_[v])
                              : target_.on_rim(kind.p, kind.q, x, near_[v]);
}

void Remesher::move(VertexId v, const TargetPlace& place) {
    mesh_.points[v] = place.point;
    size_[v] = place.size;
    near_[v] = place.near;
}

bool Remesher::is_long(HalfEdge h, double limit) const {
    if (mesh_.origin(h) == EditMesh::kNone || mesh_.origin(h) > mesh_.target(h)) return false;
    if (mesh_.is_hole(mesh_.patch_at(h)) && mesh_.is_hole(mesh_.patch_at(mesh_.twin(h))))
        return false;
    return length(h) > limit * wanted(mesh_.origin(h), mesh_.target(h));
}

double Remesher::longest_share() const {
    double longest = 0.0;
    for (HalfEdge h = 0; h < mesh_.half_edge_count(); ++h)
        if (is_long(h, longest)) longest = length(h) / wanted(mesh_.origin(h), mesh_.target(h));
    return longest;
}

void Remesher::split_long_edges(double limit) {
    // A coarse source loses its longest edges first: halved in any order, its triangles would
    // become slivers of slivers, millions out of fifty.
    for (double coarse = longest_share() / kCoarseStep; coarse > kCoarse * limit;
         coarse /= kCoarseStep)
        split_edges_above(coarse);
    split_edges_above(limit);
}

void Remesher::split_edges_above(double limit) {
    for (int pass = 0; pass < kMostPasses; ++pass) {
        const std::size_t count = mesh_.half_edge_count();
        for (HalfEdge h = 0; h < count; ++h) {
            if (!is_long(h, limit)) continue;
            const VertexId a = mesh_.origin(h), b = mesh_.target(h);
            const VertexId near = mesh_.is_feature(h) && kind_of(a).features != 2 ? b : a;
            const VertexId m = mesh_.split(h, 0.5 * (mesh_.points[a] + mesh_.points[b]));
            size_.push_back(wanted(a, b));
            near_.push_back(near_[near]);
            const TargetPlace place = place_for(m, kind_of(m), mesh_.points[m]);
            if (move_keeps_shape(m, place.point)) move(m, place);
        }
        if (mesh_.half_edge_count() == count) return;
    }
}

bool Remesher::may_collapse(HalfEdge h, double limit) {
    if (!mesh_.can_collapse(h)) return false;
    const VertexId a = mesh_.origin(h), b = mesh_.target(h);
    constexpr double kSlack = 1.01;  // edges that are long already may stay so: needles go first
    const Vec3& pa = mesh_.points[a];
    bool allowed = true;
    mesh_.for_each_leaving(a, [&](HalfEdge k) {
        if (!allowed || mesh_.is_hole(mesh_.patch_at(k))) return;
        const VertexId u = mesh_.target(k), w = mesh_.apex(k);
        if (u == b || w == b) return;
        const Vec3 &pu = mesh_.points[u], &pw = mesh_.points[w], &pb = mesh_.points[b];
        const auto grows_long = [&](const Vec3& p, VertexId x) {
            const double after = (p - pb).norm();
            return after > limit * wanted(x, b) && after > kSlack * (p - pa).norm();
        };
        if (grows_long(pu, u) || grows_long(pw, w)) allowed = false;
        const Vec3 before = mesh_.area_normal_of(EditMesh::triangle_of(k));
        const Vec3 after = (pu - pb).cross(pw - pb);
        if (!before.isZero(0.0) && turns_too_far(before, after)) allowed = false;
    });
    return allowed;
}

void Remesher::collapse_short_edges() {
    const std::uint64_t count = mesh_.half_edge_count();
    Touched touched(mesh_.vertex_count());
    do {
        touched.begin_pass();
        for (std::uint64_t i = 0; i < count; ++i) {
            const auto h = static_cast<HalfEdge>(i * kScatter % count);
            if (mesh_.origin(h) == EditMesh::kNone) continue;
            const VertexId a = mesh_.origin(h), b = mesh_.target(h);
            if (a > b || !(touched[a] || touched[b])) continue;
            if (is_hub(a) || is_hub(b) || length(h) >= kShort * wanted(a, b)) continue;
            const HalfEdge g = mesh_.twin(h);
            const bool to_b = may_collapse(h, kLong);
            if (!to_b && !may_collapse(g, kLong)) continue;
            mesh_.collapse(to_b ? h : g);
            mesh_.for_each_leaving(to_b ? b : a, [&](HalfEdge k) { touched.add(mesh_.target(k)); });
        }
    } while (touched.any() && touched.passes() < kMostPasses);
    mesh_.compact();
}

void Remesher::count_valences() {
    valence_.assign(mesh_.vertex_count(), 0);
    for (HalfEdge h = 0; h < mesh_.half_edge_count(); ++h)
        if (mesh_.origin(h) != EditMesh::kNone) ++valence_[mesh_.origin(h)];
}

int Remesher::collapse_valence_excess(HalfEdge h) const {
    const auto square = [](int off) { return off * off; };
    const int a = valence_[mesh_.origin(h)] - 6, b = valence_[mesh_.target(h)] - 6,
              c = valence_[mesh_.apex(h)] - 6, d = valence_[mesh_.apex(mesh_.twin(h))] - 6;
    return square(a + b + 2) + square(c - 1) + square(d - 1) - square(a) - square(b) - square(c) -
           square(d);
}

void Remesher::collapse_defects() {
    count_valences();
    const std::uint64_t count = mesh_.half_edge_count();
    for (std::uint64_t i = 0; i < count; ++i) {
        const auto h = static_cast<HalfEdge>(i * kScatter % count);
        if (mesh_.origin(h) == EditMesh::kNone) continue;
        const VertexId a = mesh_.origin(h), b = mesh_.target(h);
        if (is_hub(a) || is_hub(b) || length(h) > kDefect * wanted(a, b)) continue;
        if (collapse_valence_excess(h) > 0 || !may_collapse(h, kAfterDefect)) continue;
        --valence_[mesh_.apex(h)];
        --valence_[mesh_.apex(mesh_.twin(h))];
        valence_[b] += valence_[a] - 4;
        mesh_.collapse(h);
    }
    mesh_.compact();
}

bool Remesher::flip_keeps_shape(HalfEdge h) const {
    const HalfEdge g = mesh_.twin(h);
    const Vec3 &a = mesh_.points[mesh_.origin(h)], &b = mesh_.points[mesh_.target(h)],
               &c = mesh_.points[mesh_.apex(h)], &d = mesh_.points[mesh_.apex(g)];
    const Vec3 before = (b - a).cross(c - a) + (a - b).cross(d - b);
    const Vec3 first = (d - a).cross(c - a), second = (c - b).cross(d - b);
    return !turns_too_far(before, first) && !turns_too_far(before, second) &&
           first.dot(second) > kTurn * first.norm() * second.norm();
}

int Remesher::flip_valence_excess(HalfEdge h) const {
    // Rims count like any vertex: three triangles on either side are six.
    const auto gap = [&](VertexId v, int change) {
        const int off = valence_[v] - 6;
        return (off + change) * (off + change) - off * off;
    };
    return gap(mesh_.origin(h), -1) + gap(mesh_.target(h), -1) + gap(mesh_.apex(h), 1) +
           gap(mesh_.apex(mesh_.twin(h)), 1);
}

bool Remesher::flip_helps(HalfEdge h, FlipRule rule) const {
    const Vec3 &a = mesh_.points[mesh_.origin(h)], &b = mesh_.points[mesh_.target(h)],
               &c = mesh_.points[mesh_.apex(h)], &d = mesh_.points[mesh_.apex(mesh_.twin(h))];
    if (rule == FlipRule::Angle) return cotangent(c, a, b) + cotangent(d, a, b) < -1e-9;
    return flip_valence_excess(h) < 0;
}

void Remesher::flip_edges(FlipRule rule) {
    count_valences();
    Touched touched(mesh_.vertex_count());
    do {
        touched.begin_pass();
        for (HalfEdge h = 0; h < mesh_.half_edge_count(); ++h) {
            if (mesh_.origin(h) == EditMesh::kNone || h > mesh_.twin(h)) continue;
            const VertexId a = mesh_.origin(h), b = mesh_.target(h);
            if (!(touched[a] || touched[b])) continue;
            if (mesh_.is_feature(h) || mesh_.is_hole(mesh_.patch_at(h))) continue;
            if (!flip_helps(h, rule) || !mesh_.can_flip(h) || !flip_keeps_shape(h)) continue;
            const VertexId c = mesh_.apex(h), d = mesh_.apex(mesh_.twin(h));
            mesh_.flip(h);
            --valence_[a], --valence_[b], ++valence_[c], ++valence_[d];
            for (const VertexId v : {a, b, c, d}) touched.add(v);
        }
    } while (touched.any() && touched.passes() < kMostPasses);
}

Vec3 Remesher::normal_at(VertexId v) const {
    Vec3 normal = Vec3::Zero();
    mesh_.for_each_leaving(v, [&](HalfEdge h) {
        if (!mesh_.is_hole(mesh_.patch_at(h)))
            normal += mesh_.area_normal_of(EditMesh::triangle_of(h));
    });
    return normal.normalized();
}

/// The middle of its rim neighbours, measured in wanted lengths.
Vec3 Remesher::middle_on_rim(VertexId v) const {
    Vec3 sum = Vec3::Zero();
    double weights = 0.0;
    mesh_.for_each_leaving(v, [&](HalfEdge h) {
        if (!mesh_.is_feature(h)) return;
        const double weight = 1.0 / wanted(v, mesh_.target(h));
        sum += weight * mesh_.points[mesh_.target(h)];
        weights += weight;
    });
    return sum / weights;
}

Vec3 Remesher::centroid_around(VertexId v) const {
    const Vec3& at = mesh_.points[v];
    Vec3 sum = Vec3::Zero();
    double weights = 0.0;
    mesh_.for_each_leaving(v, [&](HalfEdge h) {
        const VertexId u = mesh_.target(h), w = mesh_.apex(h);
        const double size = (size_[v] + size_[u] + size_[w]) / 3.0;
        const double weight = mesh_.area_normal_of(EditMesh::triangle_of(h)).norm() / (size * size);
        sum += weight / 3.0 * (at + mesh_.points[u] + mesh_.points[w]);
        weights += weight;
    });
    return weights > 0.0 ? Vec3(sum / weights) : at;
}

Vec3 Remesher::shapely_position(VertexId v) const {
    const double height = 0.5 * std::sqrt(3.0);
    Vec3 sum = Vec3::Zero();
    double count = 0.0;
    mesh_.for_each_leaving(v, [&](HalfEdge h) {
        const Vec3 &u = mesh_.points[mesh_.target(h)], &w = mesh_.points[mesh_.apex(h)];
        const Vec3 inward = mesh_.area_normal_of(EditMesh::triangle_of(h)).cross(w - u);
        const double length = inward.norm();
        if (!(length > 0.0)) return;
        sum += 0.5 * (u + w) + (height * (w - u).norm() / length) * inward;
        count += 1.0;
    });
    return count > 0.0 ? Vec3(sum / count) : mesh_.points[v];
}

Vec3 Remesher::relaxed_position(VertexId v, const VertexKind& kind, RelaxRule rule) const {
    if (kind.features == 2) return middle_on_rim(v);
    const Vec3& at = mesh_.points[v];
    const Vec3 step = (rule == RelaxRule::Size ? centroid_around(v) : shapely_position(v)) - at;
    const Vec3 normal = normal_at(v);
    return at + step - step.dot(normal) * normal;
}

bool Remesher::move_keeps_shape(VertexId v, const Vec3& x) const {
    bool keeps = true;
    mesh_.for_each_leaving(v, [&](HalfEdge h) {
        if (!keeps || mesh_.is_hole(mesh_.patch_at(h))) return;
        const Vec3 before = mesh_.area_normal_of(EditMesh::triangle_of(h));
        const Vec3 after =
            (mesh_.points[mesh_.target(h)] - x).cross(mesh_.points[mesh_.apex(h)] - x);
        const auto plane = target_.plane_normal(mesh_.patch_at(h));
        if (plane ? after.dot(*plane) <= 0.0 : !before.isZero(0.0) && turns_too_far(before, after))
            keeps = false;
    });
    return keeps;
}

void Remesher::relax(RelaxRule rule) {
    for (VertexId v = 0; v < mesh_.vertex_count(); ++v) {
        if (mesh_.leaving(v) == EditMesh::kNone || is_hub(v)) continue;
        const VertexKind kind = kind_of(v);
        if (kind.features != 0 && kind.features != 2) continue;
        const TargetPlace place = place_for(v, kind, relaxed_position(v, kind, rule));
        // Near another wall the closest place may lie on that one.
        if (!place.normal.isZero(0.0) && place.normal.dot(normal_at(v)) < 0.0) continue;
        if (move_keeps_shape(v, place.point)) move(v, place);
    }
}

void Remesher::keep_volume() {
    Positions lifted = mesh_.points;
    for (VertexId v = 0; v < mesh_.vertex_count(); ++v) {
        if (mesh_.leaving(v) == EditMesh::kNone || is_hub(v)) continue;
        const VertexKind kind = kind_of(v);
        if (kind.features != 0 || target_.plane_normal(kind.p)) continue;
        const Vec3 normal = normal_at(v);
        double sum = 0.0, count = 0.0;
        mesh_.for_each_leaving(v, [&](HalfEdge h) {
            const Vec3 middle = 0.5 * (mesh_.points[v] + mesh_.points[mesh_.target(h)]);
            sum += (target_.on_patch(kind.p, middle, near_[v]).point - middle).dot(normal);
            count += 1.0;
        });
        const double most = kMostLift * size_[v];
        lifted[v] += std::clamp(sum / count, -most, most) * normal;
    }
    mesh_.points = std::move(lifted);
}

Surface Remesher::result() const {
    std::vector<VertexId> kept;
    return mesh_.to_surface(patches_, kept);
}

}  // namespace vesselbench
