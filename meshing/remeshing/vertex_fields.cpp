#include "meshing/remeshing/vertex_fields.h"

#include <algorithm>
#include <utility>

#include <tbb/parallel_for.h>

namespace vesselbench {

VertexCaps caps_of_vertices(const Surface& surface) {
    const std::size_t count = surface.vertex_count();
    VertexCaps caps{std::vector<std::uint16_t>(count, 0), std::vector<std::uint8_t>(count, 0)};
    std::vector<std::uint8_t> on_wall(count, 0);
    for (TriangleId t = 0; t < surface.triangle_count(); ++t) {
        const bool is_wall = surface.patch_of(t).kind == PatchKind::Wall;
        for (const VertexId v : surface.triangles()[t]) {
            if (is_wall)
                on_wall[v] = 1;
            else
                caps.patch[v] = (*surface.patch_labels)[t];
        }
    }
    for (std::size_t v = 0; v < count; ++v) caps.on_rim[v] = on_wall[v] && caps.patch[v] > 0;
    return caps;
}

Positions wall_normals(const Surface& surface) {
    const VertexCaps caps = caps_of_vertices(surface);
    Positions normals(surface.vertex_count(), Vec3::Zero());
    for (TriangleId t = 0; t < surface.triangle_count(); ++t) {
        const bool is_wall = surface.patch_of(t).kind == PatchKind::Wall;
        const Vec3 normal = area_normal(surface.points(), surface.triangles()[t]);
        for (const VertexId v : surface.triangles()[t])
            if (is_wall || !caps.on_rim[v]) normals[v] += normal;
    }
    for (Vec3& normal : normals) {
        const double length = normal.norm();
        if (length > 0.0) normal /= length;
    }
    return normals;
}

Vec3 barycentric(const Positions& points, const Triangle& triangle, const Vec3& at) {
    const Vec3 &a = points[triangle[0]], &b = points[triangle[1]], &c = points[triangle[2]];
    const Vec3 ab = b - a, ac = c - a, p = at - a, normal = ab.cross(ac);
    const double area = normal.squaredNorm(), flat = 1e-24;
    if (area > flat * ab.squaredNorm() * ac.squaredNorm()) {
        const double v = std::clamp(p.cross(ac).dot(normal) / area, 0.0, 1.0);
        const double w = std::clamp(ab.cross(p).dot(normal) / area, 0.0, 1.0 - v);
        return {1.0 - v - w, v, w};
    }
    const bool along_ab = ab.squaredNorm() >= ac.squaredNorm();
    const Vec3& along = along_ab ? ab : ac;
    const double length = along.squaredNorm();
    const double t = length > 0.0 ? std::clamp(p.dot(along) / length, 0.0, 1.0) : 0.0;
    return along_ab ? Vec3(1.0 - t, t, 0.0) : Vec3(1.0 - t, 0.0, t);
}

void fill_zeros(const Topology& topology, std::vector<double>& values) {
    const CompressedRows& rings = topology.rings();
    std::vector<VertexId> queue;
    for (VertexId v = 0; v < values.size(); ++v)
        if (values[v] > 0.0) queue.push_back(v);
    for (std::size_t i = 0; i < queue.size(); ++i)
        for (const VertexId u : rings.row(queue[i])) {
            if (values[u] > 0.0) continue;
            values[u] = values[queue[i]];
            queue.push_back(u);
        }
}

void average(const Topology& topology, int passes, std::vector<double>& values) {
    const CompressedRows& rings = topology.rings();
    std::vector<double> next = values;
    for (int pass = 0; pass < passes; ++pass) {
        tbb::parallel_for(std::size_t{0}, values.size(), [&](std::size_t v) {
            const auto ring = rings.row(v);
            if (ring.empty()) return;
            double sum = 0.0;
            for (const VertexId u : ring) sum += values[u];
            next[v] = 0.5 * (values[v] + sum / static_cast<double>(ring.size()));
        });
        std::swap(values, next);
    }
}

}  // namespace vesselbench
