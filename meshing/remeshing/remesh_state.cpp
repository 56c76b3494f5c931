#include "meshing/remeshing/remesh_state.h"

#include <algorithm>

#include "meshing/remeshing/selected.h"

namespace vesselbench {

namespace {

/// Cosine of the largest turn of a triangle's normal in one edit.
constexpr double kTurn = 0.3;

bool turns_too_far(const Vec3& before, const Vec3& after) {
    const double dot = before.dot(after);
    return dot <= 0.0 || dot * dot <= kTurn * kTurn * before.squaredNorm() * after.squaredNorm();
}

}  // namespace

RemeshState::RemeshState(const Surface& source, const std::vector<double>& source_sizes,
                         const Surface& start, const Progress& end)
    : target(source, source_sizes),
      mesh(start),
      patches(source.patches),
      sizes(mesh.vertex_count(), *std::min_element(source_sizes.begin(), source_sizes.end())),
      hints(mesh.vertex_count(), TargetPlace::kNowhere),
      inner_of(mesh.vertex_count(), EditMesh::kNone),
      cancel(end.silent()) {
    const bool from_source = start.topology == source.topology;
    for_all(mesh.vertex_count(), cancel, [&](VertexId v) {
        if (mesh.leaving(v) == EditMesh::kNone) return;
        const VertexKind kind = kind_of(v);
        if (kind.features == 0) inner_of[v] = kind.p;
        if (is_hub(v)) return;
        if (from_source && kind.features == 0) hints[v] = EditMesh::triangle_of(mesh.leaving(v));
        if (kind.features == 0 || kind.features == 2) move(v, place_for(v, kind, mesh.points[v]));
    });
}

RemeshState::VertexKind RemeshState::kind_of(VertexId v) const {
    if (inner_of[v] != EditMesh::kNone) return {0, inner_of[v], inner_of[v]};
    VertexKind kind;
    kind.p = kind.q = mesh.patch_at(mesh.leaving(v));
    mesh.for_each_leaving(v, [&](HalfEdge h) {
        kind.features += mesh.is_feature(h);
        if (mesh.patch_at(h) != kind.p) kind.q = mesh.patch_at(h);
    });
    return kind;
}

bool RemeshState::is_hub(VertexId v) const {
    return inner_of[v] != EditMesh::kNone && mesh.is_hole(inner_of[v]);
}

void RemeshState::anchor(std::span<const std::uint8_t> anchored) {
    anchors.assign(mesh.vertex_count(), EditMesh::kNone);
    for (VertexId v = 0; v < anchored.size(); ++v)
        if (anchored[v] != 0) anchors[v] = v;
}

VertexId RemeshState::split(HalfEdge h) {
    const VertexId a = mesh.origin(h), b = mesh.target(h);
    // Hints on rims are segments, within patches triangles.
    const bool is_rim = mesh.is_feature(h);
    const TriangleId near = hints[(kind_of(a).features == 0) == is_rim ? b : a];
    const VertexId m = mesh.split(h, 0.5 * (mesh.points[a] + mesh.points[b]));
    inner_of.push_back(is_rim ? EditMesh::kNone : mesh.patch_at(h));
    sizes.push_back(wanted(a, b));
    hints.push_back(near);
    if (!anchors.empty()) anchors.push_back(EditMesh::kNone);
    return m;
}

TargetPlace RemeshState::place_for(VertexId v, const VertexKind& kind, const Vec3& x) const {
    return kind.features == 0 ? target.on_patch(kind.p, x, hints[v])
                              : target.on_rim(kind.p, kind.q, x, hints[v]);
}

void RemeshState::move(VertexId v, const TargetPlace& place) {
    mesh.points[v] = place.point;
    sizes[v] = place.size;
    hints[v] = place.near;
}

bool RemeshState::may_collapse(HalfEdge h, double limit) const {
    const VertexId a = mesh.origin(h), b = mesh.target(h);
    if (is_anchored(a)) return false;
    // Edges that are already long may stay so: needles are collapsed first.
    constexpr double kSlack = 1.01 * 1.01;
    const Vec3 &pa = mesh.points[a], &pb = mesh.points[b];
    const auto grows_long = [&](VertexId x) {
        const Vec3& p = mesh.points[x];
        const double after = (p - pb).squaredNorm(), most = limit * wanted(x, b);
        return after > most * most && after > kSlack * (p - pa).squaredNorm();
    };
    HalfEdge k = h;
    do {
        const VertexId u = mesh.target(k), w = mesh.apex(k);
        if (u != b && w != b && !mesh.is_hole(mesh.patch_at(k))) {
            if (grows_long(u) || grows_long(w)) return false;
            const Vec3 before = mesh.area_normal_of(EditMesh::triangle_of(k));
            const Vec3 after = (mesh.points[u] - pb).cross(mesh.points[w] - pb);
            if (!before.isZero(0.0) && turns_too_far(before, after)) return false;
        }
        k = mesh.around(k);
    } while (k != h);
    return mesh.can_collapse(h);
}

bool RemeshState::flip_keeps_shape(HalfEdge h) const {
    const HalfEdge g = mesh.twin(h);
    const Vec3 &a = mesh.points[mesh.origin(h)], &b = mesh.points[mesh.target(h)],
               &c = mesh.points[mesh.apex(h)], &d = mesh.points[mesh.apex(g)];
    const Vec3 before = (b - a).cross(c - a) + (a - b).cross(d - b);
    const Vec3 first = (d - a).cross(c - a), second = (c - b).cross(d - b);
    return !turns_too_far(before, first) && !turns_too_far(before, second) &&
           first.dot(second) > kTurn * first.norm() * second.norm();
}

Vec3 RemeshState::normal_at(VertexId v) const {
    Vec3 normal = Vec3::Zero();
    mesh.for_each_leaving(v, [&](HalfEdge h) {
        if (!mesh.is_hole(mesh.patch_at(h)))
            normal += mesh.area_normal_of(EditMesh::triangle_of(h));
    });
    return normal.normalized();
}

bool RemeshState::move_keeps_shape(VertexId v, const Vec3& x) const {
    bool keeps = true;
    mesh.for_each_leaving(v, [&](HalfEdge h) {
        if (!keeps || mesh.is_hole(mesh.patch_at(h))) return;
        const Vec3 before = mesh.area_normal_of(EditMesh::triangle_of(h));
        const Vec3 after = (mesh.points[mesh.target(h)] - x).cross(mesh.points[mesh.apex(h)] - x);
        const auto plane = target.plane_normal(mesh.patch_at(h));
        if (plane ? after.dot(*plane) <= 0.0 : !before.isZero(0.0) && turns_too_far(before, after))
            keeps = false;
    });
    return keeps;
}

void RemeshState::compact() {
    if (!resting.empty()) resting.resize(mesh.vertex_count(), 0);
    const std::vector<VertexId> former = mesh.compact();
    const auto gather = [&](auto& values) {
        auto old = std::move(values);
        values = {};
        values.reserve(former.size());
        for (const VertexId v : former) values.push_back(old[v]);
    };
    gather(sizes);
    gather(hints);
    gather(inner_of);
    if (!anchors.empty()) gather(anchors);
    if (!resting.empty()) gather(resting);
}

Surface RemeshState::result() const {
    std::vector<VertexId> kept;
    return mesh.to_surface(patches, kept);
}

}  // namespace vesselbench
