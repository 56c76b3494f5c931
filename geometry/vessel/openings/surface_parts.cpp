#include "geometry/vessel/openings/surface_parts.h"

#include <utility>

namespace vesselbench {

VertexId SurfaceParts::add_vertex(const Vec3& position, std::span<const VertexId> sources,
                                  std::span<const double> weights) {
    for (auto& [name, values] : attributes) {
        double sum = 0.0;
        for (std::size_t i = 0; i < sources.size(); ++i) sum += weights[i] * values[sources[i]];
        values.push_back(sum);
    }
    positions.push_back(position);
    return static_cast<VertexId>(positions.size() - 1);
}

std::uint16_t SurfaceParts::add_patch(Patch patch) {
    patches.push_back(std::move(patch));
    return static_cast<std::uint16_t>(patches.size() - 1);
}

SurfaceParts take_apart(const Surface& surface) {
    SurfaceParts parts{.positions = surface.points(),
                       .triangles = {surface.triangles().begin(), surface.triangles().end()},
                       .labels = *surface.patch_labels,
                       .patches = surface.patches,
                       .attributes = {}};
    for (const auto& [name, values] : surface.attributes) parts.attributes[name] = *values;
    return parts;
}

Surface put_together(const SurfaceParts& parts, const std::vector<std::uint8_t>& removed,
                     std::vector<VertexId>* new_ids) {
    std::vector<VertexId> ids(parts.positions.size(), kRemovedVertex);
    std::vector<std::uint8_t> patch_used(parts.patches.size(), 0);
    patch_used.at(0) = 1;
    const auto stays = [&](std::size_t t) { return removed.empty() || !removed[t]; };
    for (std::size_t t = 0; t < parts.triangles.size(); ++t) {
        if (!stays(t)) continue;
        for (const VertexId v : parts.triangles[t]) ids[v] = 0;
        patch_used[parts.labels[t]] = 1;
    }
    Positions positions;
    std::vector<std::size_t> kept;
    for (std::size_t v = 0; v < ids.size(); ++v) {
        if (ids[v] == kRemovedVertex) continue;
        ids[v] = static_cast<VertexId>(positions.size());
        positions.push_back(parts.positions[v]);
        kept.push_back(v);
    }
    std::vector<Patch> patches;
    std::vector<std::uint16_t> label_of(parts.patches.size(), 0);
    for (std::size_t p = 0; p < parts.patches.size(); ++p) {
        if (!patch_used[p]) continue;
        label_of[p] = static_cast<std::uint16_t>(patches.size());
        patches.push_back(parts.patches[p]);
    }
    std::vector<Triangle> triangles;
    PatchLabels labels;
    for (std::size_t t = 0; t < parts.triangles.size(); ++t) {
        if (!stays(t)) continue;
        const auto& [a, b, c] = parts.triangles[t];
        triangles.push_back({ids[a], ids[b], ids[c]});
        labels.push_back(label_of[parts.labels[t]]);
    }
    Surface result = make_surface(std::move(positions), std::move(triangles), std::move(labels),
                                  std::move(patches));
    for (const auto& [name, values] : parts.attributes) {
        std::vector<double> values_kept;
        values_kept.reserve(kept.size());
        for (const std::size_t v : kept) values_kept.push_back(values[v]);
        result.attributes[name] = std::make_shared<const std::vector<double>>(values_kept);
    }
    if (new_ids != nullptr) *new_ids = std::move(ids);
    return result;
}

double mean_edge(const Positions& positions, std::span<const VertexId> loop) {
    double sum = 0.0;
    for (std::size_t i = 0; i < loop.size(); ++i)
        sum += (positions[loop[(i + 1) % loop.size()]] - positions[loop[i]]).norm();
    return loop.empty() ? 0.0 : sum / static_cast<double>(loop.size());
}

}  // namespace vesselbench
