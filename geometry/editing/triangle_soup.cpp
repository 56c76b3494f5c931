#include "geometry/editing/triangle_soup.h"

#include <utility>

namespace vesselbench {

VertexId TriangleSoup::add_vertex(const Vec3& point, std::span<const VertexId> sources,
                                  std::span<const double> weights) {
    for (auto& [name, values] : attributes) {
        double sum = 0.0;
        for (std::size_t i = 0; i < sources.size(); ++i) sum += weights[i] * values[sources[i]];
        values.push_back(sum);
    }
    points.push_back(Vec3(point));
    marks.push_back(0);
    return static_cast<VertexId>(points.size() - 1);
}

VertexId TriangleSoup::add_vertex_between(const Vec3& point, std::span<const VertexId> around) {
    for (auto& [name, values] : attributes) {
        double sum = 0.0;
        for (const VertexId v : around) sum += values[v];
        values.push_back(around.empty() ? 0.0 : sum / static_cast<double>(around.size()));
    }
    points.push_back(Vec3(point));
    marks.push_back(0);
    return static_cast<VertexId>(points.size() - 1);
}

VertexId TriangleSoup::add_copy(VertexId of) {
    const VertexId copy = add_vertex_between(points[of], std::span(&of, 1));
    marks[copy] = marks[of];
    return copy;
}

void TriangleSoup::add_triangle(const Triangle& triangle, std::uint16_t label) {
    triangles.push_back(triangle);
    labels.push_back(label);
}

void TriangleSoup::remove_triangles(const std::vector<std::uint8_t>& marked) {
    std::size_t kept = 0;
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        if (marked[t]) continue;
        triangles[kept] = triangles[t];
        labels[kept++] = labels[t];
    }
    triangles.resize(kept);
    labels.resize(kept);
}

std::size_t TriangleSoup::remove_unused_vertices(std::vector<VertexId>* new_ids) {
    std::vector<VertexId> number(points.size(), kRemovedVertex);
    for (const Triangle& t : triangles)
        for (const VertexId v : t) number[v] = 0;
    VertexId kept = 0;
    for (VertexId v = 0; v < number.size(); ++v) {
        if (number[v] == kRemovedVertex) continue;
        points[kept] = points[v];
        marks[kept] = marks[v];
        for (auto& [name, values] : attributes) values[kept] = values[v];
        number[v] = kept++;
    }
    const std::size_t removed = points.size() - kept;
    points.resize(kept);
    marks.resize(kept);
    for (auto& [name, values] : attributes) values.resize(kept);
    if (removed > 0) renumber(number);
    if (new_ids != nullptr) *new_ids = std::move(number);
    return removed;
}

void TriangleSoup::remove_unused_patches() {
    std::vector<std::uint8_t> used(patches.size(), 0);
    used.at(0) = 1;
    for (const std::uint16_t label : labels) used[label] = 1;
    std::vector<Patch> kept;
    std::vector<std::uint16_t> number(patches.size(), 0);
    for (std::size_t p = 0; p < patches.size(); ++p) {
        if (!used[p]) continue;
        number[p] = static_cast<std::uint16_t>(kept.size());
        kept.push_back(patches[p]);
    }
    for (std::uint16_t& label : labels) label = number[label];
    patches = std::move(kept);
}

void TriangleSoup::renumber(const std::vector<VertexId>& target) {
    for (Triangle& t : triangles)
        for (VertexId& v : t) v = target[v];
}

TriangleSoup soup_from(const Surface& surface) {
    TriangleSoup soup{.points = surface.points(),
                      .triangles = {surface.triangles().begin(), surface.triangles().end()},
                      .labels = *surface.patch_labels,
                      .patches = surface.patches,
                      .attributes = {},
                      .marks = std::vector<std::uint8_t>(surface.vertex_count(), 0)};
    for (const auto& [name, values] : surface.attributes) soup.attributes[name] = *values;
    return soup;
}

Surface surface_from(TriangleSoup soup) {
    Surface surface = make_surface(std::move(soup.points), std::move(soup.triangles),
                                   std::move(soup.labels), std::move(soup.patches));
    for (auto& [name, values] : soup.attributes)
        surface.attributes[name] = std::make_shared<const std::vector<double>>(std::move(values));
    return surface;
}

}  // namespace vesselbench
