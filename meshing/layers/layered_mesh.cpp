#include "meshing/layers/layered_mesh.h"

#include <algorithm>

#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/edges.h"
#include "geometry/kernel/point_welder.h"
#include "meshing/tetrahedra/mesh_check.h"

namespace vesselbench {

namespace {

// Fewer tetrahedra than this fraction of the cells cannot fill the lumen evenly.
constexpr double kLeastInside = 0.1;

std::vector<Remedy> without_layers() {
    return {{.arguments = {{"layers", "0"}}}};
}

TetrahedralizeParameters inside(TetrahedralizeParameters parameters, std::size_t prisms,
                                int layers) {
    parameters.may_divide = false;
    if (!parameters.cells) return parameters;
    const double wanted = *parameters.cells;
    parameters.cells = wanted - static_cast<double>(prisms);
    if (*parameters.cells < kLeastInside * wanted)
        throw DiagnosedFailure({.code = "layers-exceed-cells",
                                .figures = {{"wanted", wanted},
                                            {"layers", static_cast<double>(layers)},
                                            {"prisms", static_cast<double>(prisms)}},
                                .remedies = {{.operation = "remesh", .before = true}}});
    return parameters;
}

// On more of the wall than this, layers of less than half their thickness are not those asked for.
constexpr double kMostHalf = 0.5;

void require_room(const LayerReport& layers) {
    if (layers.half <= kMostHalf) return;
    throw DiagnosedFailure({.code = "layers-beyond-lumen",
                            .place = layers.places.front().place,
                            .figures = {{"wished", layers.wished}, {"thickness", layers.thickness}},
                            .remedies = without_layers()});
}

// The layers' sides lie in an opening's mean plane, from which it may be off a little.
constexpr double kTolerance = 1e-4;

TetrahedralizeResult filled_inside(const WallLayers& layers,
                                   const TetrahedralizeParameters& parameters,
                                   const Progress& progress) {
    try {
        return fill_lumen(layers.inner, parameters, progress);
    } catch (const DiagnosedFailure& failure) {
        throw DiagnosedFailure({.code = "layers-not-filled",
                                .place = failure.diagnostics().front().place,
                                .words = {{"reason", failure.what()}},
                                .remedies = without_layers()});
    }
}

// Puts prisms between a wall and the mesh inside.
class Joining {
public:
    Joining(const WallLayers& layers, VolumeMesh inside)
        : layers_(layers), mesh_(std::move(inside)), numbers_(numbers_inside()) {
        const std::size_t columns = layers_.wall.origins.size();
        first_ = static_cast<VertexId>(mesh_.points.size());
        mesh_.points.reserve(mesh_.points.size() + (layers_.levels.size() - 1) * columns);
        for (std::size_t k = 0; k + 1 < layers_.levels.size(); ++k)
            for (VertexId v = 0; v < columns; ++v)
                mesh_.points.push_back(layers_.at(v, layers_.levels[k]));
    }

    VolumeMesh take() {
        put_prisms();
        put_boundary();
        put_sides();
        return std::move(mesh_);
    }

private:
    // TetGen keeps a surface's points to the bit, and orders them anew.
    std::vector<VertexId> numbers_inside() const {
        PointWelder welder(mesh_.points.size());
        for (const Vec3& p : mesh_.points) welder.add(p);
        std::vector<VertexId> numbers;
        for (const Vec3& p : layers_.inner.points()) numbers.push_back(welder.add(p));
        if (welder.points().size() != mesh_.points.size())
            throw AlgorithmFailure("layers: points of the inner surface were lost");
        return numbers;
    }

    // The mesh's point in a column at the end of the k-th layer; k = 0: on the wall.
    [[nodiscard]] VertexId at(VertexId v, std::size_t k) const {
        const auto columns = static_cast<VertexId>(layers_.wall.origins.size());
        return k + 1 < layers_.levels.size() ? first_ + static_cast<VertexId>(k) * columns + v
                                             : numbers_[layers_.wall.origins[v]];
    }

    void put_prisms() {
        for (const auto& [a, b, c] : layers_.wall.wall.triangles())
            for (std::size_t k = 0; k + 1 < layers_.levels.size(); ++k)
                mesh_.prisms.push_back(
                    {at(a, k), at(b, k), at(c, k), at(a, k + 1), at(b, k + 1), at(c, k + 1)});
    }

    // The wall's triangles in its order, then those of openings, which the mesh inside has.
    void put_boundary() {
        std::vector<Triangle> boundary;
        PatchLabels labels = *layers_.wall.wall.patch_labels;
        for (const auto& [a, b, c] : layers_.wall.wall.triangles())
            boundary.push_back({at(a, 0), at(b, 0), at(c, 0)});
        for (std::size_t t = 0; t < mesh_.boundary.size(); ++t) {
            const std::uint16_t patch = mesh_.boundary_patches[t];
            if (!LayeredWall::is_opening(mesh_.patches[patch])) continue;
            boundary.push_back(mesh_.boundary[t]);
            labels.push_back(patch);
        }
        mesh_.boundary = std::move(boundary);
        mesh_.boundary_patches = std::move(labels);
    }

    // At the rims of openings, whose edges have one triangle of the wall.
    void put_sides() {
        const EdgeTable edges = edge_table(*layers_.wall.wall.topology);
        for (std::size_t e = 0; e < edges.edges.size(); ++e) {
            const auto half_edges = edges.half_edges.row(e);
            if (half_edges.size() != 1) continue;
            const Triangle& triangle = layers_.wall.wall.triangles()[half_edges[0] / 3];
            const VertexId a = triangle[half_edges[0] % 3], b = triangle[(half_edges[0] + 1) % 3];
            for (std::size_t k = 0; k + 1 < layers_.levels.size(); ++k) {
                mesh_.boundary_sides.push_back({at(a, k), at(a, k + 1), at(b, k + 1), at(b, k)});
                mesh_.side_patches.push_back(layers_.wall.opening[a]);
            }
        }
    }

    const WallLayers& layers_;
    VolumeMesh mesh_;
    std::vector<VertexId> numbers_;  ///< inside, by vertex of the surface
    VertexId first_ = 0;             ///< of the layers' own points
};

// Share of the area below the layers at which the cells on both sides differ too much in volume.
double steep_share(const VolumeMesh& mesh, std::span<const MeshFace> faces) {
    constexpr double kSteepVolumes = 2.0;
    double steep = 0.0, whole = 0.0;
    for (const MeshFace& face : faces) {
        if (face.neighbour == MeshFace::kOutside || face.owner >= mesh.tetrahedra.size() ||
            face.neighbour < mesh.tetrahedra.size())
            continue;
        const auto& [a, b, c, d] = mesh.tetrahedra[face.owner];
        const auto& p = mesh.points;
        const double tetrahedron = (p[b] - p[a]).cross(p[c] - p[a]).dot(p[d] - p[a]) / 6.0;
        const double prism = prism_volume(p, mesh.prisms[face.neighbour - mesh.tetrahedra.size()]);
        const double area = face_normal(p, face.corners).norm();
        whole += area;
        if (std::max(tetrahedron, prism) > kSteepVolumes * std::min(tetrahedron, prism))
            steep += area;
    }
    return steep / std::max(whole, 1e-300);
}

}  // namespace

LayeredMesh layered_mesh(const Surface& given, const TetrahedralizeParameters& parameters,
                         const LayerParameters& asked, const Progress& progress) {
    LayeredMesh result;
    const Surface surface =
        fillable_surface(given, result.report.warnings, progress.part(0.0, 0.1));
    const WallLayers layers = wall_layers(surface, asked, progress.part(0.1, 0.25));
    result.layers = layer_report(layers);
    require_room(result.layers);
    TetrahedralizeResult core = filled_inside(
        layers, inside(parameters, result.layers.prisms, asked.layers), progress.part(0.25, 0.95));
    core.report.warnings.insert(core.report.warnings.begin(), result.report.warnings.begin(),
                                result.report.warnings.end());
    result.report = std::move(core.report);
    progress.report(0.95, "checking the cells");
    result.mesh = Joining(layers, std::move(core.mesh)).take();
    const std::vector<MeshFace> faces = mesh_faces(result.mesh);
    const std::string lost = mesh_loss(result.mesh, faces, surface, true, kTolerance);
    if (!lost.empty())
        throw DiagnosedFailure(
            {.code = "layers-invalid", .words = {{"reason", lost}}, .remedies = without_layers()});
    result.report.quality = volume_quality(result.mesh, faces);
    result.layers.steep = steep_share(result.mesh, faces);
    if (parameters.cells) warn_of_cell_count(*parameters.cells, result.report);
    return result;
}

}  // namespace vesselbench
