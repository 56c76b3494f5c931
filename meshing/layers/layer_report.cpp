#include "meshing/layers/layer_report.h"

#include <algorithm>
#include <numeric>

#include "geometry/kernel/measure.h"
#include "geometry/kernel/statistics.h"

namespace vesselbench {

namespace {

constexpr double kReached = 0.98, kHalf = 0.5;  // of the thickness wished [-]
constexpr std::size_t kMostPlaces = 5;

// A third of the triangles at each vertex [mm^2]. #V
std::vector<double> vertex_areas(const Surface& wall) {
    std::vector<double> areas(wall.vertex_count(), 0.0);
    for (const Triangle& triangle : wall.triangles())
        for (const VertexId v : triangle) areas[v] += triangle_area(wall.points(), triangle) / 3.0;
    return areas;
}

// The thinnest columns, each a vessel's radius or so away from the others.
std::vector<ThinPlace> thin_places(const WallLayers& layers, const std::vector<double>& thicknesses,
                                   const std::vector<double>& shares) {
    constexpr double kApart = 5.0;  // in thicknesses wished, which are a fifth of it as a rule
    std::vector<VertexId> thin;
    for (VertexId v = 0; v < shares.size(); ++v)
        if (shares[v] < kHalf) thin.push_back(v);
    std::ranges::stable_sort(thin, {}, [&](VertexId v) { return shares[v]; });
    std::vector<ThinPlace> places;
    for (const VertexId v : thin) {
        if (places.size() == kMostPlaces) break;
        const Vec3& at = layers.wall.wall.points()[v];
        if (std::ranges::any_of(places, [&](const ThinPlace& other) {
                return (other.place - at).norm() < kApart * layers.wished[v];
            }))
            continue;
        places.push_back({.place = at, .thickness = thicknesses[v], .share = shares[v]});
    }
    return places;
}

}  // namespace

LayerReport layer_report(const WallLayers& layers) {
    LayerReport report{.layers = static_cast<int>(layers.levels.size()) - 1};
    report.prisms = layers.wall.wall.triangle_count() * static_cast<std::size_t>(report.layers);
    const std::vector<double> areas = vertex_areas(layers.wall.wall);
    const double whole = std::accumulate(areas.begin(), areas.end(), 0.0);
    std::vector<double> thicknesses(areas.size()), wished(areas.size()), shares(areas.size());
    for (std::size_t v = 0; v < areas.size(); ++v) {
        const double cosine = -layers.directions[v].dot(layers.wall.normals[v]);
        thicknesses[v] = layers.lengths[v] * cosine;
        wished[v] = layers.wished[v] * cosine;
        shares[v] = layers.lengths[v] / layers.wished[v];
        if (layers.lengths[v] <= 0.0) report.covered -= areas[v] / whole;
        if (shares[v] < kReached) report.limited += areas[v] / whole;
        if (shares[v] < kHalf) report.half += areas[v] / whole;
    }
    report.wished = weighted_percentile(wished, areas, 0.5);
    report.thickness = weighted_percentile(thicknesses, areas, 0.5);
    report.thinnest = std::ranges::min(thicknesses);
    report.first = report.thickness * layers.levels[1];
    report.places = thin_places(layers, thicknesses, shares);
    return report;
}

}  // namespace vesselbench
