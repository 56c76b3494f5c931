#include "meshing/stamp/corefinement.h"

#include <algorithm>
#include <array>
#include <map>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Polygon_mesh_processing/fair.h>
#include <CGAL/Side_of_triangle_mesh.h>
#include <CGAL/Surface_mesh.h>

#include "geometry/editing/local_part.h"

namespace vesselbench {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Face = Mesh::Face_index;
using Labels = Mesh::Property_map<Face, std::uint16_t>;
using Seam = Mesh::Property_map<Mesh::Edge_index, bool>;
namespace PMP = CGAL::Polygon_mesh_processing;

/// Hands the label of a divided face to its pieces.
struct LabelKeeper : PMP::Corefinement::Default_visitor<Mesh> {
    const Mesh* labelled = nullptr;
    Labels labels;
    std::uint16_t current = 0;

    void before_subface_creations(Face face, Mesh& mesh) {
        if (&mesh == labelled) current = labels[face];
    }

    void after_subface_created(Face face, Mesh& mesh) {
        if (&mesh == labelled) labels[face] = current;
    }
};

/// False if the triangles do not form a manifold.
bool fill(Mesh& mesh, const Surface& surface) {
    for (const Vec3& p : surface.points()) mesh.add_vertex({p.x(), p.y(), p.z()});
    for (const auto& [a, b, c] : surface.triangles())
        if (mesh.add_face(Mesh::Vertex_index(a), Mesh::Vertex_index(b), Mesh::Vertex_index(c)) ==
            Mesh::null_face())
            return false;
    return true;
}

std::array<Mesh::Vertex_index, 3> corners_of(const Mesh& mesh, Face face) {
    std::array<Mesh::Vertex_index, 3> corners;
    std::size_t k = 0;
    for (const auto v : mesh.vertices_around_face(mesh.halfedge(face))) corners[k++] = v;
    return corners;
}

Vec3 place_of(const Mesh& mesh, Mesh::Vertex_index v) {
    const auto& p = mesh.point(v);
    return {p.x(), p.y(), p.z()};
}

/// A mesh divided by the seam.
struct Side {
    Mesh mesh;
    Seam seam;
    Mesh::Property_map<Face, std::size_t> region;
    std::size_t regions = 0;

    void begin() { seam = mesh.add_property_map<Mesh::Edge_index, bool>("e:seam", false).first; }

    void find_regions() {
        region = mesh.add_property_map<Face, std::size_t>("f:region", 0).first;
        regions =
            PMP::connected_components(mesh, region, PMP::parameters::edge_is_constrained_map(seam));
    }

    /// The middle of the largest face of each region: the farthest from the seam's roundings.
    [[nodiscard]] std::vector<Vec3> middles() const {
        std::vector<double> largest(regions, -1.0);
        std::vector<Vec3> middle(regions, Vec3::Zero());
        for (const Face face : mesh.faces()) {
            const auto [a, b, c] = corners_of(mesh, face);
            const Vec3 p = place_of(mesh, a), q = place_of(mesh, b), r = place_of(mesh, c);
            const double area = (q - p).cross(r - p).norm();
            if (!(area > largest[region[face]])) continue;
            largest[region[face]] = area;
            middle[region[face]] = (p + q + r) / 3.0;
        }
        return middle;
    }

    [[nodiscard]] bool has_seam() const {
        return std::ranges::any_of(mesh.edges(), [&](const auto& e) { return seam[e]; });
    }
};

using PointKey = std::array<double, 3>;

PointKey key_of(const Vec3& p) {
    return {p.x(), p.y(), p.z()};
}

/// What is kept of both sides, as one surface.
class Assembly {
public:
    explicit Assembly(std::size_t part_vertices) : part_vertices_(part_vertices) {}

    void add(const Side& side, const std::vector<std::uint8_t>& kept, bool turned, bool is_part,
             const Labels* labels) {
        std::map<Mesh::Vertex_index, VertexId> number;
        for (const auto e : side.mesh.edges())
            if (side.seam[e])
                for (const auto h :
                     {side.mesh.halfedge(e), side.mesh.opposite(side.mesh.halfedge(e))})
                    add_seam_vertex(side.mesh, side.mesh.target(h), is_part, number);
        for (const Face face : side.mesh.faces()) {
            if (!kept[side.region[face]]) continue;
            Triangle triangle{};
            const auto corners = corners_of(side.mesh, face);
            for (std::size_t k = 0; k < 3; ++k) {
                const auto [at, fresh] = number.try_emplace(corners[k], 0);
                if (fresh) at->second = add_vertex(side.mesh, corners[k], is_part);
                triangle[k] = at->second;
            }
            if (turned) std::swap(triangle[1], triangle[2]);
            triangles_.push_back(triangle);
            labels_.push_back(labels ? (*labels)[face] : std::uint16_t{0});
        }
        if (is_part)
            for (const auto e : side.mesh.edges())
                if (side.seam[e])
                    seam_.emplace_back(number.at(side.mesh.vertex(e, 0)),
                                       number.at(side.mesh.vertex(e, 1)));
    }

    [[nodiscard]] Corefined result(const std::vector<Patch>& patches) {
        return {
            make_surface(std::move(points_), std::move(triangles_), std::move(labels_), patches),
            std::move(former_), std::move(seam_)};
    }

private:
    VertexId add_vertex(const Mesh& mesh, Mesh::Vertex_index v, bool is_part) {
        points_.push_back(place_of(mesh, v));
        const bool old = is_part && static_cast<std::size_t>(v) < part_vertices_;
        former_.push_back(old ? static_cast<VertexId>(v) : kNewVertex);
        return static_cast<VertexId>(points_.size() - 1);
    }

    /// Both sides have the seam's vertices, at the same places to the last bit.
    void add_seam_vertex(const Mesh& mesh, Mesh::Vertex_index v, bool is_part,
                         std::map<Mesh::Vertex_index, VertexId>& number) {
        if (number.contains(v)) return;
        const auto [at, fresh] = on_seam_.try_emplace(key_of(place_of(mesh, v)), 0);
        if (fresh) at->second = add_vertex(mesh, v, is_part);
        number[v] = at->second;
    }

    std::size_t part_vertices_;
    Positions points_;
    std::vector<VertexId> former_;
    std::vector<Triangle> triangles_;
    PatchLabels labels_;
    std::vector<std::pair<VertexId, VertexId>> seam_;
    std::map<PointKey, VertexId> on_seam_;
};

/// 1 at regions of the part that are outside the tool. None if one of them cannot be decided.
std::optional<std::vector<std::uint8_t>> outside_tool(const Side& part, const Mesh& tool) {
    const CGAL::Side_of_triangle_mesh<Mesh, Kernel> side(tool);
    std::vector<std::uint8_t> outside;
    for (const Vec3& p : part.middles()) {
        const auto where = side(Kernel::Point_3(p.x(), p.y(), p.z()));
        if (where == CGAL::ON_BOUNDARY) return std::nullopt;
        outside.push_back(where == CGAL::ON_UNBOUNDED_SIDE ? 1 : 0);
    }
    return outside;
}

/// Whether a region that goes reaches the rim at which the part was cut out.
bool loses_rim(const Side& part, const std::vector<std::uint8_t>& kept) {
    return std::ranges::any_of(part.mesh.halfedges(), [&](const auto& h) {
        return part.mesh.is_border(h) && !kept[part.region[part.mesh.face(part.mesh.opposite(h))]];
    });
}

/// False if the two cannot be resolved.
bool corefine(Side& part, Side& tool, const LabelKeeper& keeper) {
    try {
        PMP::corefine(part.mesh, tool.mesh,
                      PMP::parameters::edge_is_constrained_map(part.seam)
                          .visitor(keeper)
                          .throw_on_self_intersection(true),
                      PMP::parameters::edge_is_constrained_map(tool.seam));
        return true;
    } catch (const PMP::Corefinement::Self_intersection_exception&) {
        return false;
    }
}

}  // namespace

std::optional<Corefined> corefined(const Surface& part, const Surface& tool, StampMode mode,
                                   const std::function<bool(const Vec3&)>& inside_vessel,
                                   CorefinementProblem& problem) {
    problem = CorefinementProblem::Degenerate;
    Side wall, body;
    if (!fill(wall.mesh, part) || !fill(body.mesh, tool)) return std::nullopt;
    wall.begin();
    body.begin();
    LabelKeeper keeper;
    keeper.labelled = &wall.mesh;
    keeper.labels = wall.mesh.add_property_map<Face, std::uint16_t>("f:label", 0).first;
    for (TriangleId t = 0; t < part.triangle_count(); ++t)
        keeper.labels[Face(t)] = (*part.patch_labels)[t];
    Mesh uncut = body.mesh;
    if (!corefine(wall, body, keeper)) return std::nullopt;
    wall.find_regions();
    body.find_regions();
    const auto kept_wall = outside_tool(wall, uncut);
    if (!kept_wall) return std::nullopt;
    const bool all_gone = std::ranges::count(*kept_wall, 1) == 0;
    if (!wall.has_seam() || all_gone) {
        problem = all_gone ? CorefinementProblem::Swallowed : CorefinementProblem::Apart;
        return std::nullopt;
    }
    if (loses_rim(wall, *kept_wall)) {
        problem = CorefinementProblem::Beyond;
        return std::nullopt;
    }
    std::vector<std::uint8_t> kept_body;
    for (const Vec3& p : body.middles())
        kept_body.push_back(inside_vessel(p) == (mode == StampMode::Subtract) ? 1 : 0);
    Assembly assembly(part.vertex_count());
    assembly.add(wall, *kept_wall, false, true, &keeper.labels);
    assembly.add(body, kept_body, mode == StampMode::Subtract, false, nullptr);
    return assembly.result(part.patches);
}

std::optional<Positions> faired(const Surface& surface, std::span<const VertexId> vertices,
                                int continuity) {
    Mesh mesh;
    if (!fill(mesh, surface)) return std::nullopt;
    std::vector<Mesh::Vertex_index> chosen;
    for (const VertexId v : vertices) chosen.emplace_back(v);
    if (!PMP::fair(mesh, chosen,
                   PMP::parameters::fairing_continuity(static_cast<unsigned>(continuity))))
        return std::nullopt;
    Positions points;
    for (const auto v : mesh.vertices()) points.push_back(place_of(mesh, v));
    return points;
}

}  // namespace vesselbench
