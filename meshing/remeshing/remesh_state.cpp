#include "meshing/remeshing/remesh_state.h"

#include <algorithm>

namespace vesselbench {

namespace {

/// Cosine of the largest turn of a triangle's normal in one edit.
constexpr double kTurn = 0.3;

bool turns_too_far(const Vec3& before, const Vec3& after) {
    const double scale = before.norm() * after.norm();
    return before.dot(after) <= kTurn * scale;
}

}  // namespace

RemeshState::RemeshState(const Surface& source, const std::vector<double>& source_sizes,
                         const Surface& start, const Progress& end)
    : target(source, source_sizes),
      mesh(start),
      patches(source.patches),
      sizes(mesh.vertex_count(), *std::min_element(source_sizes.begin(), source_sizes.end())),
      hints(mesh.vertex_count(), 0),
      cancel(end.silent()) {
    for (VertexId v = 0; v < mesh.vertex_count(); ++v) {
        check_cancelled();
        if (mesh.leaving(v) == EditMesh::kNone || is_hub(v)) continue;
        const VertexKind kind = kind_of(v);
        if (kind.features == 0 || kind.features == 2) move(v, place_for(v, kind, mesh.points[v]));
    }
}

RemeshState::VertexKind RemeshState::kind_of(VertexId v) const {
    VertexKind kind;
    kind.p = kind.q = mesh.patch_at(mesh.leaving(v));
    mesh.for_each_leaving(v, [&](HalfEdge h) {
        kind.features += mesh.is_feature(h);
        if (mesh.patch_at(h) != kind.p) kind.q = mesh.patch_at(h);
    });
    return kind;
}

bool RemeshState::is_hub(VertexId v) const {
    const HalfEdge h = mesh.leaving(v);
    return mesh.is_hole(mesh.patch_at(h)) && kind_of(v).features == 0;
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

bool RemeshState::may_collapse(HalfEdge h, double limit) {
    if (!mesh.can_collapse(h)) return false;
    const VertexId a = mesh.origin(h), b = mesh.target(h);
    constexpr double kSlack =
        1.01;  // edges that are already long may stay so: needles are collapsed first
    const Vec3& pa = mesh.points[a];
    bool allowed = true;
    mesh.for_each_leaving(a, [&](HalfEdge k) {
        if (!allowed || mesh.is_hole(mesh.patch_at(k))) return;
        const VertexId u = mesh.target(k), w = mesh.apex(k);
        if (u == b || w == b) return;
        const Vec3 &pu = mesh.points[u], &pw = mesh.points[w], &pb = mesh.points[b];
        const auto grows_long = [&](const Vec3& p, VertexId x) {
            const double after = (p - pb).norm();
            return after > limit * wanted(x, b) && after > kSlack * (p - pa).norm();
        };
        if (grows_long(pu, u) || grows_long(pw, w)) allowed = false;
        const Vec3 before = mesh.area_normal_of(EditMesh::triangle_of(k));
        const Vec3 after = (pu - pb).cross(pw - pb);
        if (!before.isZero(0.0) && turns_too_far(before, after)) allowed = false;
    });
    return allowed;
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

Surface RemeshState::result() const {
    std::vector<VertexId> kept;
    return mesh.to_surface(patches, kept);
}

}  // namespace vesselbench
