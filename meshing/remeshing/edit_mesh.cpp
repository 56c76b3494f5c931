#include "meshing/remeshing/edit_mesh.h"

#include <algorithm>
#include <utility>

#include <tbb/parallel_sort.h>

#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/space_order.h"

namespace vesselbench {

namespace {

[[noreturn]] void refuse(const char* code, const Vec3& at) {
    throw DiagnosedInput({.code = code, .place = at, .remedies = {{.operation = "repair"}}});
}

}  // namespace

EditMesh::EditMesh(const Surface& surface)
    : points(surface.points()),
      leaving_(surface.vertex_count(), kNone),
      first_hole_(static_cast<std::uint32_t>(surface.patches.size())) {
    for (TriangleId t = 0; t < surface.triangle_count(); ++t) {
        const auto& [a, b, c] = surface.triangles()[t];
        if (a == b || b == c || c == a) refuse("triangle-uses-vertex-twice", points[a]);
        add_triangle(a, b, c, (*surface.patch_labels)[t]);
    }
    find_twins(surface);
    fill_holes();
    require_single_fans();
}

void EditMesh::add_triangle(VertexId a, VertexId b, VertexId c, std::uint32_t patch) {
    const auto h = static_cast<HalfEdge>(origin_.size());
    origin_.insert(origin_.end(), {a, b, c});
    twin_.insert(twin_.end(), 3, kNone);
    patch_.push_back(patch);
    leaving_[a] = h;
    leaving_[b] = h + 1;
    leaving_[c] = h + 2;
}

void EditMesh::glue(HalfEdge g, HalfEdge h) {
    twin_[g] = h;
    twin_[h] = g;
}

void EditMesh::find_twins(const Surface& surface) {
    const CompressedRows& fans = surface.topology->triangles_at();
    for (HalfEdge h = 0; h < origin_.size(); ++h) {
        const VertexId a = origin(h), b = target(h);
        for (const TriangleId t : fans.row(b))
            for (HalfEdge g = 3 * t; g < 3 * t + 3; ++g) {
                if (g != h && origin(g) == a && target(g) == b)
                    refuse("triangles-overlap", points[a]);
                if (origin(g) != b || target(g) != a) continue;
                if (twin_[h] != kNone && twin_[h] != g) refuse("edge-not-manifold", points[a]);
                twin_[h] = g;
            }
    }
}

void EditMesh::fill_holes() {
    const std::size_t count = origin_.size();
    std::vector<HalfEdge> open_at(points.size(), kNone);  // boundary half-edge leaving a vertex
    for (HalfEdge h = 0; h < count; ++h) {
        if (twin_[h] != kNone) continue;
        if (open_at[origin(h)] != kNone) refuse("borders-touch", points[origin(h)]);
        open_at[origin(h)] = h;
    }
    std::uint32_t patch = first_hole_;
    for (HalfEdge start = 0; start < count; ++start) {
        if (twin_[start] != kNone) continue;
        const auto hub = static_cast<VertexId>(points.size());
        points.push_back(points[origin(start)]);
        leaving_.push_back(kNone);
        const auto first = static_cast<HalfEdge>(origin_.size());
        for (HalfEdge h = start; twin_[h] == kNone; h = open_at[target(h)]) {
            const auto g = static_cast<HalfEdge>(origin_.size());
            add_triangle(target(h), origin(h), hub, patch);
            glue(h, g);
            if (g != first) glue(g + 1, g - 1);  // origin -> hub beside hub -> origin of the last
        }
        glue(first + 1, static_cast<HalfEdge>(origin_.size()) - 1);
        ++patch;
    }
}

void EditMesh::require_single_fans() const {
    std::vector<int> corners(points.size(), 0);
    for (const VertexId v : origin_) ++corners[v];
    for (VertexId v = 0; v < points.size(); ++v)
        if (leaving_[v] != kNone && valence(v) != corners[v])
            refuse("vertex-not-manifold", points[v]);
}

int EditMesh::valence(VertexId v) const {
    int count = 0;
    for_each_leaving(v, [&](HalfEdge) { ++count; });
    return count;
}

bool EditMesh::closes_within_three(HalfEdge h) const {
    HalfEdge k = h;
    for (int turn = 0; turn < 3; ++turn)
        if ((k = around(k)) == h) return true;
    return false;
}

bool EditMesh::are_neighbours(VertexId a, VertexId b) const {
    const HalfEdge start = leaving_[a];
    HalfEdge h = start;
    do {
        if (target(h) == b) return true;
        h = around(h);
    } while (h != start);
    return false;
}

int EditMesh::feature_edges_at(VertexId v) const {
    int count = 0;
    for_each_leaving(v, [&](HalfEdge h) { count += is_feature(h); });
    return count;
}

VertexId EditMesh::split(HalfEdge h, const Vec3& point) {
    const HalfEdge g = twin(h), h_next = next(h), g_prev = prev(g);
    const VertexId b = target(h), c = apex(h), d = apex(g);
    const HalfEdge beyond_bc = twin(h_next), beyond_db = twin(g_prev);
    const auto m = static_cast<VertexId>(points.size());
    points.push_back(point);
    leaving_.push_back(kNone);
    origin_[h_next] = m;  // (a, b, c) becomes (a, m, c)
    origin_[g] = m;       // (b, a, d) becomes (m, a, d)
    leaving_[c] = prev(h);
    leaving_[d] = g_prev;
    const auto k = static_cast<HalfEdge>(origin_.size());
    add_triangle(m, b, c, patch_at(h));
    const HalfEdge j = k + 3;
    add_triangle(b, m, d, patch_at(g));
    glue(h_next, k + 2);
    glue(k + 1, beyond_bc);
    glue(g_prev, j + 1);
    glue(j + 2, beyond_db);
    glue(k, j);
    return m;
}

bool EditMesh::can_flip(HalfEdge h) const {
    if (is_feature(h) || is_hole(patch_at(h))) return false;
    const VertexId c = apex(h), d = apex(twin(h));
    if (closes_within_three(h) || closes_within_three(twin(h))) return false;
    return c != d && !are_neighbours(c, d);
}

void EditMesh::flip(HalfEdge h) {
    const HalfEdge g = twin(h), h_next = next(h), h_prev = prev(h), g_next = next(g),
                   g_prev = prev(g);
    const VertexId a = origin(h), b = target(h), c = apex(h), d = apex(g);
    const HalfEdge bc = twin(h_next), ca = twin(h_prev), ad = twin(g_next), db = twin(g_prev);
    origin_[h] = d, origin_[h_next] = c, origin_[h_prev] = a;  // (d, c, a)
    origin_[g] = c, origin_[g_next] = d, origin_[g_prev] = b;  // (c, d, b)
    glue(h_next, ca);
    glue(h_prev, ad);
    glue(g_next, db);
    glue(g_prev, bc);
    leaving_[a] = h_prev, leaving_[b] = g_prev, leaving_[c] = h_next, leaving_[d] = g_next;
}

int EditMesh::common_neighbours(VertexId a, VertexId b) const {
    thread_local std::vector<VertexId> around_a, around_b;
    around_a.clear(), around_b.clear();
    for_each_leaving(a, [&](HalfEdge k) { around_a.push_back(target(k)); });
    for_each_leaving(b, [&](HalfEdge k) { around_b.push_back(target(k)); });
    std::sort(around_b.begin(), around_b.end());  // hubs of fans have hundreds of neighbours
    return static_cast<int>(std::count_if(around_a.begin(), around_a.end(), [&](VertexId v) {
        return std::binary_search(around_b.begin(), around_b.end(), v);
    }));
}

bool EditMesh::can_collapse(HalfEdge h) const {
    const HalfEdge g = twin(h);
    if (is_hole(patch_at(h)) && is_hole(patch_at(g))) return false;
    const int features = feature_edges_at(origin(h));
    if (features > 2 || (features > 0 && !is_feature(h))) return false;
    const VertexId c = apex(h), d = apex(g);
    if (c == d || closes_within_three(prev(h)) || closes_within_three(prev(g))) return false;
    return common_neighbours(origin(h), target(h)) == 2;  // c and d
}

void EditMesh::collapse(HalfEdge h) {
    const HalfEdge g = twin(h);
    const VertexId a = origin(h), b = target(h), c = apex(h), d = apex(g);
    const HalfEdge bc = twin(next(h)), ca = twin(prev(h)), ad = twin(next(g)), db = twin(prev(g));
    std::vector<HalfEdge> fan;
    for_each_leaving(a, [&](HalfEdge k) { fan.push_back(k); });
    for (const HalfEdge k : fan) origin_[k] = b;
    glue(bc, ca);
    glue(ad, db);
    leaving_[b] = ca, leaving_[c] = bc, leaving_[d] = ad;
    leaving_[a] = kNone;
    for (const TriangleId t : {triangle_of(h), triangle_of(g)})
        for (HalfEdge k = 3 * t; k < 3 * t + 3; ++k) origin_[k] = kNone;
}

std::vector<VertexId> EditMesh::compact() {
    std::vector<VertexId> former = compact_vertices();
    compact_triangles();
    return former;
}

std::vector<VertexId> EditMesh::compact_vertices() {
    std::vector<VertexId> alive;
    Positions places;
    for (VertexId v = 0; v < points.size(); ++v) {
        if (leaving_[v] == kNone) continue;
        alive.push_back(v);
        places.push_back(points[v]);
    }
    std::vector<VertexId> former(alive.size()), number(points.size(), kNone);
    const std::vector<VertexId> order = space_order(places);
    for (VertexId v = 0; v < order.size(); ++v) {
        former[v] = alive[order[v]];
        number[former[v]] = v;
        points[v] = places[order[v]];
    }
    points.resize(former.size());
    leaving_.resize(former.size());
    for (VertexId& v : origin_)
        if (v != kNone) v = number[v];
    return former;
}

void EditMesh::compact_triangles() {
    std::vector<std::pair<VertexId, TriangleId>> order;  // lowest vertex, former number
    for (TriangleId t = 0; t < patch_.size(); ++t)
        if (is_alive(t))
            order.emplace_back(std::min({origin_[3 * t], origin_[3 * t + 1], origin_[3 * t + 2]}),
                               t);
    tbb::parallel_sort(order.begin(), order.end());
    std::vector<TriangleId> number(patch_.size(), kNone);
    for (TriangleId t = 0; t < order.size(); ++t) number[order[t].second] = t;
    std::vector<VertexId> origin(3 * order.size());
    std::vector<HalfEdge> twin(3 * order.size());
    std::vector<std::uint32_t> patch(order.size());
    for (TriangleId t = 0; t < order.size(); ++t) {
        const TriangleId s = order[t].second;
        patch[t] = patch_[s];
        for (HalfEdge i = 0; i < 3; ++i) {
            const HalfEdge g = twin_[3 * s + i];
            origin[3 * t + i] = origin_[3 * s + i];
            twin[3 * t + i] = 3 * number[triangle_of(g)] + g % 3;
            leaving_[origin[3 * t + i]] = 3 * t + i;
        }
    }
    origin_ = std::move(origin);
    twin_ = std::move(twin);
    patch_ = std::move(patch);
}

Surface EditMesh::to_surface(const std::vector<Patch>& patches, std::vector<VertexId>& kept) const {
    std::vector<VertexId> number(points.size(), kNone);
    const auto is_real = [&](TriangleId t) { return is_alive(t) && !is_hole(patch_[t]); };
    for (TriangleId t = 0; t < patch_.size(); ++t)
        if (is_real(t))
            for (HalfEdge h = 3 * t; h < 3 * t + 3; ++h) number[origin_[h]] = 0;
    Positions moved;
    kept.clear();
    for (VertexId v = 0; v < points.size(); ++v) {
        if (number[v] == kNone) continue;
        number[v] = static_cast<VertexId>(kept.size());
        kept.push_back(v);
        moved.push_back(points[v]);
    }
    std::vector<Triangle> triangles;
    PatchLabels labels;
    for (TriangleId t = 0; t < patch_.size(); ++t) {
        if (!is_real(t)) continue;
        triangles.push_back(
            {number[origin_[3 * t]], number[origin_[3 * t + 1]], number[origin_[3 * t + 2]]});
        labels.push_back(static_cast<std::uint16_t>(patch_[t]));
    }
    return make_surface(std::move(moved), std::move(triangles), std::move(labels), patches);
}

}  // namespace vesselbench
