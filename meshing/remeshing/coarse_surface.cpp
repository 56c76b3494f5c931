#include "meshing/remeshing/coarse_surface.h"

#include <algorithm>
#include <unordered_map>

#include "geometry/kernel/measure.h"

namespace vesselbench {

namespace {

/// Cells of a surface are about as many as the pixels that they are drawn in: with fewer vertices
/// than these, nothing is gained.
constexpr std::size_t kFew = 5000;

constexpr std::uint64_t kMostCells = 1U << 20U;  ///< a side's, so that three indices fit a key

class Grid {
public:
    Grid(const Positions& positions, int cells) : box_(bounds(positions)) {
        const double side = (box_.max - box_.min).maxCoeff();
        cell_ = std::max(side / cells, 1e-12);
    }

    [[nodiscard]] std::uint64_t key(const Vec3& point) const {
        std::uint64_t key = 0;
        for (int i = 0; i < 3; ++i) {
            const auto at = static_cast<std::uint64_t>((point[i] - box_.min[i]) / cell_);
            key = key * kMostCells + std::min(at, kMostCells - 1);
        }
        return key;
    }

private:
    Bounds box_;
    double cell_;
};

struct Clusters {
    std::vector<VertexId> of;  ///< #V
    Positions means;
};

Clusters clusters_of(const Positions& positions, int cells) {
    const Grid grid(positions, cells);
    std::unordered_map<std::uint64_t, VertexId> numbers;
    std::vector<double> counts;
    Clusters clusters;
    for (const Vec3& point : positions) {
        const auto next = static_cast<VertexId>(clusters.means.size());
        const auto [entry, added] = numbers.try_emplace(grid.key(point), next);
        if (added) {
            clusters.means.emplace_back(Vec3::Zero());
            counts.push_back(0.0);
        }
        clusters.of.push_back(entry->second);
        clusters.means[entry->second] += point;
        counts[entry->second] += 1.0;
    }
    for (std::size_t i = 0; i < counts.size(); ++i) clusters.means[i] /= counts[i];
    return clusters;
}

}  // namespace

Surface coarse_surface(const Surface& surface, int cells) {
    if (surface.vertex_count() <= kFew) return surface;
    Clusters clusters = clusters_of(surface.points(), cells);
    std::vector<Triangle> triangles;
    PatchLabels labels;
    for (std::size_t t = 0; t < surface.triangle_count(); ++t) {
        const Triangle& old = surface.triangles()[t];
        const Triangle corners = {clusters.of[old[0]], clusters.of[old[1]], clusters.of[old[2]]};
        if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0])
            continue;
        triangles.push_back(corners);
        labels.push_back((*surface.patch_labels)[t]);
    }
    if (triangles.empty()) return surface;
    return make_surface(std::move(clusters.means), std::move(triangles), std::move(labels),
                        surface.patches);
}

}  // namespace vesselbench
