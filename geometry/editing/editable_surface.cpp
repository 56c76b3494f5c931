#include "geometry/editing/editable_surface.h"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/System/omstream.hh>

namespace vesselbench {

namespace {

struct Traits : OpenMesh::DefaultTraits {
    using Point = OpenMesh::Vec3d;
    using Normal = OpenMesh::Vec3d;
    VertexAttributes(OpenMesh::Attributes::Status);
    EdgeAttributes(OpenMesh::Attributes::Status);
    FaceAttributes(OpenMesh::Attributes::Status);
};

using HalfEdges = OpenMesh::TriMesh_ArrayKernelT<Traits>;
using VertexHandle = OpenMesh::VertexHandle;
using HalfEdge = OpenMesh::HalfedgeHandle;
using FaceHandle = OpenMesh::FaceHandle;

VertexHandle vertex(VertexId v) {
    return VertexHandle(static_cast<int>(v));
}

FaceHandle face(TriangleId t) {
    return FaceHandle(static_cast<int>(t));
}

template <class Handle>
std::uint32_t id(const Handle& handle) {
    return static_cast<std::uint32_t>(handle.idx());
}

OpenMesh::Vec3d to_openmesh(const Vec3& p) {
    return {p.x(), p.y(), p.z()};
}

template <class T>
void sort_unique(std::vector<T>& values) {
    std::sort(values.begin(), values.end());
    values.erase(std::unique(values.begin(), values.end()), values.end());
}

/// OpenMesh reports every triangle that it cannot link on stderr; here they are expected.
void silence_openmesh() {
    static const bool silent = [] {
        omerr().disable();
        return true;
    }();
    (void)silent;
}

/// Mean length of a closed loop's sides. \param point of a vertex
template <class Point>
double mean_loop_edge(std::span<const VertexId> loop, const Point& point) {
    double sum = 0.0;
    for (std::size_t i = 0; i < loop.size(); ++i)
        sum += (point(loop[(i + 1) % loop.size()]) - point(loop[i])).norm();
    return loop.empty() ? 0.0 : sum / static_cast<double>(loop.size());
}

}  // namespace

/// The half-edges and their properties.
struct EditableSurface::Mesh {
    using Edge = std::pair<VertexId, VertexId>;  ///< low, high

    HalfEdges half_edges;
    OpenMesh::FPropHandleT<std::uint16_t> label;
    OpenMesh::VPropHandleT<std::uint8_t> mark;
    std::map<std::string, OpenMesh::VPropHandleT<double>> attributes;
    std::vector<Patch> patches;

    std::map<VertexId, VertexId> original;             ///< of a copy
    std::map<VertexId, std::vector<VertexId>> copies;  ///< of an original
    std::map<Edge, std::vector<TriangleId>> apart;     ///< triangles on copies, by original edge

    Mesh() {
        silence_openmesh();
        half_edges.add_property(label);
        half_edges.add_property(mark);
    }

    [[nodiscard]] VertexId origin_of(VertexId v) const {
        if (original.empty()) return v;
        const auto found = original.find(v);
        return found == original.end() ? v : found->second;
    }

    /// The vertex and its copies.
    [[nodiscard]] std::vector<VertexId> places_of(VertexId v) const {
        std::vector<VertexId> places{v};
        if (const auto found = copies.find(v); found != copies.end())
            places.insert(places.end(), found->second.begin(), found->second.end());
        return places;
    }

    /// Takes the point by value: it may be one of the mesh's own, which move as their array grows.
    VertexId add_vertex(OpenMesh::Vec3d point) {
        const VertexHandle v = half_edges.add_vertex(point);
        half_edges.property(mark, v) = 0;
        for (const auto& [name, values] : attributes) half_edges.property(values, v) = 0.0;
        return id(v);
    }

    VertexId add_copy(VertexId of) {
        const VertexId copy = add_vertex(half_edges.point(vertex(of)));
        original[copy] = of;
        copies[of].push_back(copy);
        return copy;
    }

    TriangleId add_triangle(const Triangle& t, std::uint16_t its_label) {
        FaceHandle added;
        if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0])
            added = half_edges.add_face(vertex(t[0]), vertex(t[1]), vertex(t[2]));
        if (!added.is_valid()) added = add_apart(t);
        half_edges.property(label, added) = its_label;
        return id(added);
    }

    FaceHandle add_apart(const Triangle& t) {
        const VertexId a = add_copy(t[0]), b = add_copy(t[1]), c = add_copy(t[2]);
        const FaceHandle added = half_edges.add_face(vertex(a), vertex(b), vertex(c));
        for (int k = 0; k < 3; ++k) apart[std::minmax(t[k], t[(k + 1) % 3])].push_back(id(added));
        return added;
    }

    /// The half-edge that starts at the first corner.
    [[nodiscard]] HalfEdge first_side(TriangleId t) const {
        return half_edges.next_halfedge_handle(half_edges.halfedge_handle(face(t)));
    }

    [[nodiscard]] HalfEdge side(TriangleId t, int k) const {
        HalfEdge h = first_side(t);
        for (; k > 0; --k) h = half_edges.next_halfedge_handle(h);
        return h;
    }

    void set_first_corner(TriangleId t, VertexId v) {
        HalfEdge h = first_side(t);
        while (id(half_edges.to_vertex_handle(h)) != v) h = half_edges.next_halfedge_handle(h);
        half_edges.set_halfedge_handle(face(t), h);
    }

    [[nodiscard]] Triangle corners(TriangleId t) const {
        const HalfEdge last = half_edges.halfedge_handle(face(t));
        const HalfEdge first = half_edges.next_halfedge_handle(last);
        return {id(half_edges.to_vertex_handle(last)), id(half_edges.to_vertex_handle(first)),
                id(half_edges.to_vertex_handle(half_edges.next_halfedge_handle(first)))};
    }

    /// Adds the triangle on the half-edge from a to b, if there is one.
    void add_triangle_at(VertexId a, VertexId b, std::vector<TriangleId>& found) const {
        const HalfEdge h = half_edges.find_halfedge(vertex(a), vertex(b));
        if (h.is_valid() && !half_edges.is_boundary(h))
            found.push_back(id(half_edges.face_handle(h)));
    }

    void add_apart_at(VertexId a, VertexId b, std::vector<TriangleId>& found) const {
        if (apart.empty()) return;
        const auto at = apart.find(std::minmax(a, b));
        if (at == apart.end()) return;
        for (const TriangleId t : at->second)
            if (!half_edges.status(face(t)).deleted()) found.push_back(t);
    }

    /// Only the edges of a tetrahedron have three neighbours at both ends. OpenMesh would collapse
    /// it to two triangles back to back.
    [[nodiscard]] bool is_on_tetrahedron(HalfEdge h) const {
        const auto is_peak = [&](VertexHandle v) {
            return !half_edges.is_boundary(v) && half_edges.valence(v) == 3;
        };
        return is_peak(half_edges.from_vertex_handle(h)) && is_peak(half_edges.to_vertex_handle(h));
    }

    /// True if vertex v has copies.
    [[nodiscard]] bool is_split(VertexId v) const { return copies.contains(v); }

    void fill_from(const TriangleSoup& soup);
};

void EditableSurface::Mesh::fill_from(const TriangleSoup& soup) {
    patches = soup.patches;
    half_edges.reserve(soup.points.size(), soup.triangles.size() * 3 / 2, soup.triangles.size());
    for (const auto& [name, values] : soup.attributes) half_edges.add_property(attributes[name]);
    for (VertexId v = 0; v < soup.points.size(); ++v) {
        const VertexHandle added = half_edges.add_vertex(to_openmesh(soup.points[v]));
        half_edges.property(mark, added) = soup.marks[v];
        for (const auto& [name, values] : soup.attributes)
            half_edges.property(attributes[name], added) = values[v];
    }
    for (TriangleId t = 0; t < soup.triangles.size(); ++t)
        add_triangle(soup.triangles[t], soup.labels[t]);
}

EditableSurface::EditableSurface(const Surface& surface) : EditableSurface(soup_from(surface)) {}

EditableSurface::EditableSurface(const TriangleSoup& soup) : mesh_(std::make_unique<Mesh>()) {
    mesh_->fill_from(soup);
}

EditableSurface::EditableSurface(EditableSurface&&) noexcept = default;
EditableSurface& EditableSurface::operator=(EditableSurface&&) noexcept = default;
EditableSurface::~EditableSurface() = default;

std::size_t EditableSurface::vertex_count() const {
    return mesh_->half_edges.n_vertices();
}

std::size_t EditableSurface::triangle_count() const {
    return mesh_->half_edges.n_faces();
}

Vec3 EditableSurface::point(VertexId v) const {
    const auto& p = mesh_->half_edges.point(vertex(v));
    return {p[0], p[1], p[2]};
}

Positions EditableSurface::points_of(std::span<const VertexId> loop) const {
    Positions points;
    for (const VertexId v : loop) points.push_back(point(v));
    return points;
}

Triangle EditableSurface::triangle(TriangleId t) const {
    Triangle corners = mesh_->corners(t);
    for (VertexId& v : corners) v = mesh_->origin_of(v);
    return corners;
}

Vec3 EditableSurface::area_normal_of(TriangleId t) const {
    const Triangle corners = mesh_->corners(t);
    const Vec3 a = point(corners[0]);
    return (point(corners[1]) - a).cross(point(corners[2]) - a);
}

std::uint16_t EditableSurface::label(TriangleId t) const {
    return mesh_->half_edges.property(mesh_->label, face(t));
}

bool EditableSurface::is_removed(TriangleId t) const {
    return mesh_->half_edges.status(face(t)).deleted();
}

std::vector<TriangleId> EditableSurface::triangles_at(VertexId v) const {
    std::vector<TriangleId> found;
    for (const VertexId place : mesh_->places_of(v))
        for (auto at = mesh_->half_edges.cvf_iter(vertex(place)); at.is_valid(); ++at)
            found.push_back(id(*at));
    sort_unique(found);
    return found;
}

std::vector<VertexId> EditableSurface::ring(VertexId v) const {
    std::vector<VertexId> around;
    for (const VertexId place : mesh_->places_of(v))
        for (auto at = mesh_->half_edges.cvv_iter(vertex(place)); at.is_valid(); ++at)
            around.push_back(mesh_->origin_of(id(*at)));
    sort_unique(around);
    return around;
}

std::vector<TriangleId> EditableSurface::across(TriangleId t, int side) const {
    const HalfEdges& mesh = mesh_->half_edges;
    const HalfEdge twin = mesh.opposite_halfedge_handle(mesh_->side(t, side));
    if (mesh_->apart.empty()) {
        if (mesh.is_boundary(twin)) return {};
        return {id(mesh.face_handle(twin))};
    }
    const Triangle corners = triangle(t);
    std::vector<TriangleId> found = triangles_on(corners[side], corners[(side + 1) % 3]);
    std::erase(found, t);
    return found;
}

std::vector<TriangleId> EditableSurface::triangles_on(VertexId a, VertexId b) const {
    std::vector<TriangleId> found;
    mesh_->add_triangle_at(a, b, found);
    mesh_->add_triangle_at(b, a, found);
    mesh_->add_apart_at(a, b, found);
    sort_unique(found);
    return found;
}

bool EditableSurface::on_rim(VertexId v) const {
    if (!mesh_->is_split(v)) return mesh_->half_edges.is_boundary(vertex(v));
    const std::vector<VertexId> around = ring(v);
    return std::any_of(around.begin(), around.end(),
                       [&](VertexId u) { return triangles_on(v, u).size() == 1; });
}

std::vector<std::vector<VertexId>> EditableSurface::rims() const {
    const HalfEdges& mesh = mesh_->half_edges;
    std::vector<std::uint8_t> seen(mesh.n_halfedges(), 0);
    std::vector<std::vector<VertexId>> found;
    for (TriangleId t = 0; t < triangle_count(); ++t) {
        if (is_removed(t)) continue;
        for (int k = 0; k < 3; ++k) {
            const HalfEdge start = mesh.opposite_halfedge_handle(mesh_->side(t, k));
            if (!mesh.is_boundary(start) || seen[id(start)]) continue;
            // Along the border, against the triangles: the loop is reversed.
            std::vector<VertexId> rim;
            for (HalfEdge h = start; !std::exchange(seen[id(h)], 1);
                 h = mesh.prev_halfedge_handle(h))
                rim.push_back(mesh_->origin_of(id(mesh.to_vertex_handle(h))));
            found.push_back(std::move(rim));
        }
    }
    return found;
}

void EditableSurface::move(VertexId v, const Vec3& to) {
    for (const VertexId place : mesh_->places_of(v))
        mesh_->half_edges.set_point(vertex(place), to_openmesh(to));
}

void EditableSurface::blend_attributes(VertexId v, std::span<const VertexId> sources,
                                       std::span<const double> weights) {
    for (const auto& [name, values] : mesh_->attributes) {
        double sum = 0.0;
        for (std::size_t i = 0; i < sources.size(); ++i)
            sum += weights[i] * mesh_->half_edges.property(values, vertex(sources[i]));
        mesh_->half_edges.property(values, vertex(v)) = sum;
    }
}

VertexId EditableSurface::add_vertex(const Vec3& point, std::span<const VertexId> sources,
                                     std::span<const double> weights) {
    const VertexId v = mesh_->add_vertex(to_openmesh(point));
    blend_attributes(v, sources, weights);
    return v;
}

TriangleId EditableSurface::add_triangle(const Triangle& triangle, std::uint16_t label) {
    return mesh_->add_triangle(triangle, label);
}

std::uint16_t EditableSurface::add_patch(Patch patch) {
    mesh_->patches.push_back(std::move(patch));
    return static_cast<std::uint16_t>(mesh_->patches.size() - 1);
}

const std::vector<Patch>& EditableSurface::patches() const {
    return mesh_->patches;
}

VertexId EditableSurface::append(const Surface& other) {
    const auto first = static_cast<VertexId>(vertex_count());
    for (const Vec3& p : other.points()) mesh_->add_vertex(to_openmesh(p));
    for (const auto& [name, values] : other.attributes) {
        const auto [known, fresh] = mesh_->attributes.try_emplace(name);
        if (fresh) {
            mesh_->half_edges.add_property(known->second);
            for (VertexId v = 0; v < first; ++v)
                mesh_->half_edges.property(known->second, vertex(v)) = 0.0;
        }
        for (VertexId v = 0; v < values->size(); ++v)
            mesh_->half_edges.property(known->second, vertex(first + v)) = (*values)[v];
    }
    std::vector<std::uint16_t> label_of;
    for (const Patch& patch : other.patches) {
        const auto same = std::find(patches().begin(), patches().end(), patch);
        label_of.push_back(same != patches().end()
                               ? static_cast<std::uint16_t>(same - patches().begin())
                               : add_patch(patch));
    }
    for (TriangleId t = 0; t < other.triangle_count(); ++t) {
        const auto& [a, b, c] = other.triangles()[t];
        add_triangle({first + a, first + b, first + c}, label_of[(*other.patch_labels)[t]]);
    }
    return first;
}

void EditableSurface::remove(TriangleId t) {
    mesh_->half_edges.delete_face(face(t), false);
}

void EditableSurface::remove(const std::vector<std::uint8_t>& marked) {
    for (TriangleId t = 0; t < marked.size(); ++t)
        if (marked[t] && !is_removed(t)) remove(t);
}

bool EditableSurface::collapse(VertexId gone, VertexId kept) {
    if (mesh_->is_split(gone) || mesh_->is_split(kept)) return false;
    const HalfEdge h = mesh_->half_edges.find_halfedge(vertex(gone), vertex(kept));
    if (!h.is_valid() || mesh_->is_on_tetrahedron(h)) return false;
    if (!mesh_->half_edges.is_collapse_ok(h)) return false;
    mesh_->half_edges.collapse(h);
    return true;
}

bool EditableSurface::flip(TriangleId t, int side) {
    HalfEdges& mesh = mesh_->half_edges;
    const HalfEdge h = mesh_->side(t, side);
    const auto edge = mesh.edge_handle(h);
    if (mesh.is_boundary(edge) || !mesh.is_flip_ok(edge)) return false;
    const TriangleId other = id(mesh.face_handle(mesh.opposite_halfedge_handle(h)));
    const VertexId c = id(mesh.to_vertex_handle(mesh.next_halfedge_handle(h)));
    mesh.flip(edge);
    mesh_->set_first_corner(t, c);
    mesh_->set_first_corner(other, c);
    return true;
}

void EditableSurface::set_label(TriangleId t, std::uint16_t label) {
    mesh_->half_edges.property(mesh_->label, face(t)) = label;
}

TriangleSoup EditableSurface::to_soup() const {
    const HalfEdges& mesh = mesh_->half_edges;
    TriangleSoup soup;
    soup.patches = mesh_->patches;
    for (const auto& [name, values] : mesh_->attributes) soup.attributes[name];
    std::vector<VertexId> number(vertex_count());
    for (VertexId v = 0; v < number.size(); ++v) {
        if (mesh_->origin_of(v) != v) continue;
        number[v] = static_cast<VertexId>(soup.points.size());
        soup.points.push_back(point(v));
        soup.marks.push_back(mesh.property(mesh_->mark, vertex(v)));
        for (const auto& [name, values] : mesh_->attributes)
            soup.attributes[name].push_back(mesh.property(values, vertex(v)));
    }
    for (TriangleId t = 0; t < triangle_count(); ++t) {
        if (is_removed(t)) continue;
        const auto& [a, b, c] = triangle(t);
        soup.add_triangle({number[a], number[b], number[c]}, label(t));
    }
    return soup;
}

Surface EditableSurface::to_surface(std::vector<VertexId>* new_ids) const {
    TriangleSoup soup = to_soup();
    std::vector<VertexId> kept;
    soup.remove_unused_vertices(&kept);
    soup.remove_unused_patches();
    if (new_ids != nullptr) {
        new_ids->clear();
        std::size_t next = 0;  // to_soup leaves out copies only
        for (VertexId v = 0; v < vertex_count(); ++v)
            new_ids->push_back(mesh_->origin_of(v) == v ? kept[next++] : kRemovedVertex);
    }
    return surface_from(std::move(soup));
}

double mean_edge(const EditableSurface& surface, std::span<const VertexId> loop) {
    return mean_loop_edge(loop, [&](VertexId v) { return surface.point(v); });
}

double mean_edge(const Positions& points, std::span<const VertexId> loop) {
    return mean_loop_edge(loop, [&](VertexId v) { return points[v]; });
}

}  // namespace vesselbench
