#include "geometry/vessel/repair/repair_mesh.h"

#include <limits>

namespace vesselbench {

VertexId RepairMesh::add_copy(VertexId of) {
    return add_vertex(points[of], {of});
}

VertexId RepairMesh::add_vertex(const Vec3& point, const std::vector<VertexId>& around) {
    points.push_back(Vec3(point));
    for (auto& [name, values] : columns) {
        double sum = 0.0;
        for (const VertexId v : around) sum += values[v];
        values.push_back(around.empty() ? 0.0 : sum / static_cast<double>(around.size()));
    }
    cut.push_back(around.size() == 1 ? cut[around[0]] : 0);
    return static_cast<VertexId>(points.size() - 1);
}

void RepairMesh::add_triangle(const Triangle& triangle, std::uint16_t label) {
    triangles.push_back(triangle);
    labels.push_back(label);
}

void RepairMesh::remove_triangles(const std::vector<std::uint8_t>& marked) {
    std::size_t kept = 0;
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        if (marked[t]) continue;
        triangles[kept] = triangles[t];
        labels[kept++] = labels[t];
    }
    triangles.resize(kept);
    labels.resize(kept);
}

std::size_t RepairMesh::remove_unused_vertices() {
    constexpr VertexId kUnused = std::numeric_limits<VertexId>::max();
    std::vector<VertexId> number(points.size(), kUnused);
    for (const Triangle& t : triangles)
        for (const VertexId v : t) number[v] = 0;
    VertexId kept = 0;
    for (VertexId v = 0; v < number.size(); ++v) {
        if (number[v] == kUnused) continue;
        points[kept] = points[v];
        cut[kept] = cut[v];
        for (auto& [name, values] : columns) values[kept] = values[v];
        number[v] = kept++;
    }
    const std::size_t removed = points.size() - kept;
    points.resize(kept);
    cut.resize(kept);
    for (auto& [name, values] : columns) values.resize(kept);
    if (removed > 0) renumber(number);
    return removed;
}

void RepairMesh::renumber(const std::vector<VertexId>& target) {
    for (Triangle& t : triangles)
        for (VertexId& v : t) v = target[v];
}

RepairMesh repair_mesh_from(const Surface& surface) {
    RepairMesh mesh;
    mesh.points = surface.points();
    mesh.triangles.assign(surface.triangles().begin(), surface.triangles().end());
    mesh.labels = *surface.patch_labels;
    for (const auto& [name, values] : surface.attributes) mesh.columns[name] = *values;
    mesh.cut.assign(mesh.points.size(), 0);
    return mesh;
}

Surface surface_from(RepairMesh mesh, const std::vector<Patch>& patches) {
    Surface surface = make_surface(std::move(mesh.points), std::move(mesh.triangles),
                                   std::move(mesh.labels), patches);
    for (auto& [name, values] : mesh.columns)
        surface.attributes[name] = std::make_shared<const std::vector<double>>(std::move(values));
    return surface;
}

double mean_side(const RepairMesh& mesh) {
    double sum = 0.0;
    for (const Triangle& t : mesh.triangles)
        for (int k = 0; k < 3; ++k) sum += (mesh.points[t[k]] - mesh.points[t[(k + 1) % 3]]).norm();
    return mesh.triangles.empty() ? 0.0 : sum / (3.0 * static_cast<double>(mesh.triangles.size()));
}

Vec3 centroid(const RepairMesh& mesh, const Triangle& triangle) {
    return (mesh.points[triangle[0]] + mesh.points[triangle[1]] + mesh.points[triangle[2]]) / 3.0;
}

}  // namespace vesselbench
