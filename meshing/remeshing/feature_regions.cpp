#include "meshing/remeshing/feature_regions.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <numeric>
#include <utility>

#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/edges.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/measure.h"

namespace vesselbench {

namespace {

constexpr std::size_t kMostRegions = 60000;  ///< patch labels are 16-bit

/// Sets of triangles that are joined step by step.
class Regions {
public:
    explicit Regions(std::size_t count) : parent_(count) {
        std::iota(parent_.begin(), parent_.end(), TriangleId{0});
    }

    TriangleId of(TriangleId t) {
        while (parent_[t] != t) t = parent_[t] = parent_[parent_[t]];
        return t;
    }

    void join(TriangleId a, TriangleId b) {
        a = of(a);
        b = of(b);
        parent_[std::max(a, b)] = std::min(a, b);
    }

private:
    std::vector<TriangleId> parent_;
};

/// The edges between two triangles of the same patch, with their bend [deg].
struct InnerEdge {
    TriangleId s = 0, t = 0;
    double length = 0.0;
    double bend = 0.0;
};

double degrees_between(const Vec3& a, const Vec3& b) {
    return std::atan2(a.cross(b).norm(), a.dot(b)) * 180.0 / std::numbers::pi;
}

std::vector<InnerEdge> inner_edges(const Surface& surface) {
    const EdgeTable table = edge_table(*surface.topology);
    std::vector<InnerEdge> inner;
    for (std::size_t e = 0; e < table.edges.size(); ++e) {
        const auto halves = table.half_edges.row(e);
        if (halves.size() != 2) continue;
        const TriangleId s = halves[0] / 3, t = halves[1] / 3;
        if ((*surface.patch_labels)[s] != (*surface.patch_labels)[t]) continue;
        const auto& [a, b] = table.edges[e];
        inner.push_back({s, t, (surface.points()[a] - surface.points()[b]).norm(),
                         degrees_between(area_normal(surface.points(), surface.triangles()[s]),
                                         area_normal(surface.points(), surface.triangles()[t]))});
    }
    return inner;
}

std::map<TriangleId, double> areas_of(const Surface& surface, Regions& regions) {
    std::map<TriangleId, double> areas;
    for (TriangleId t = 0; t < surface.triangle_count(); ++t)
        areas[regions.of(t)] += triangle_area(surface.points(), surface.triangles()[t]);
    return areas;
}

/// Joins each small region with the neighbour of the longest common border, until none is left that
/// has a neighbour.
void join_small(const Surface& surface, const std::vector<InnerEdge>& edges, double least_area,
                Regions& regions) {
    for (bool joined = least_area > 0.0; joined;) {
        joined = false;
        const auto areas = areas_of(surface, regions);
        std::map<TriangleId, std::map<TriangleId, double>> borders;
        for (const InnerEdge& edge : edges) {
            const TriangleId a = regions.of(edge.s), b = regions.of(edge.t);
            if (a == b) continue;
            borders[a][b] += edge.length;
            borders[b][a] += edge.length;
        }
        for (const auto& [region, neighbours] : borders) {
            if (areas.at(region) >= least_area || regions.of(region) != region) continue;
            const auto longest = std::ranges::max_element(
                neighbours, {}, [](const auto& border) { return border.second; });
            regions.join(region, longest->first);
            joined = true;
        }
    }
}

/// Every region becomes a patch of its original's kind; the wall's largest region comes first.
FeatureRegions labelled(const Surface& surface, Regions& regions) {
    const PatchLabels& labels = *surface.patch_labels;
    const auto areas = areas_of(surface, regions);
    if (areas.size() > kMostRegions)
        throw DiagnosedFailure({.code = "too-many-features",
                                .operation = "remesh",
                                .figures = {{"regions", static_cast<double>(areas.size())}},
                                .remedies = {{.arguments = {{"feature_angle", ""}}},
                                             {.arguments = {{"feature_size", ""}}}}});
    FeatureRegions found;
    found.patches = surface.patches;
    std::map<TriangleId, std::uint16_t> row;
    double largest = 0.0;
    for (const auto& [region, area] : areas)  // a region is named after its first triangle
        if (labels[region] == 0 && area > largest) {
            largest = area;
            row = {{region, 0}};
        }
    std::vector<Patch> patches = {surface.patches.front()};
    found.patch_of = {0};
    PatchLabels fresh;
    for (TriangleId t = 0; t < surface.triangle_count(); ++t) {
        const auto [at, is_new] =
            row.try_emplace(regions.of(t), static_cast<std::uint16_t>(patches.size()));
        if (is_new) {
            patches.push_back(
                {"region_" + std::to_string(patches.size()), surface.patches[labels[t]].kind});
            found.patch_of.push_back(labels[t]);
        }
        fresh.push_back(at->second);
    }
    found.surface = surface.with_patches(std::move(fresh), std::move(patches));
    return found;
}

}  // namespace

Surface FeatureRegions::restored(const Surface& remeshed) const {
    PatchLabels labels;
    for (const std::uint16_t label : *remeshed.patch_labels) labels.push_back(patch_of.at(label));
    return remeshed.with_patches(std::move(labels), patches);
}

FeatureRegions split_at_features(const Surface& surface, double angle_deg, double least_area) {
    if (!(angle_deg > 0.0 && angle_deg <= 180.0))
        throw InvalidInput("a feature angle must be above 0 and at most 180 degrees");
    if (!(least_area >= 0.0)) throw InvalidInput("a feature size must not be negative");
    const std::vector<InnerEdge> edges = inner_edges(surface);
    Regions regions(surface.triangle_count());
    for (const InnerEdge& edge : edges)
        if (edge.bend <= angle_deg) regions.join(edge.s, edge.t);
    join_small(surface, edges, least_area, regions);
    FeatureRegions found = labelled(surface, regions);
    for (const InnerEdge& edge : edges)
        found.edges += regions.of(edge.s) != regions.of(edge.t) ? 1 : 0;
    return found;
}

}  // namespace vesselbench
