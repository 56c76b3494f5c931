#include "workbench/window/model/colourings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/mean_curvature.h"
#include "geometry/kernel/statistics.h"
#include "geometry/kernel/surface_distance.h"
#include "geometry/kernel/triangle_shape.h"
#include "geometry/vessel/centerlines/centerlines.h"
#include "meshing/tetrahedra/quality.h"
#include "smoothing/context/context_finder.h"
#include "smoothing/context/stack_orientation.h"

namespace vesselbench {

namespace {

using enum ColouringKind;

constexpr std::array<ColouringInfo, 8> kColourings = {
    {{Patches, "patches", "Patches", "", "Wall, inlet and outlets in colours of their own"},
     {Deviation, "deviation", "Deviation", "mm",
      "Distance from the source, or of a preview from the surface before it: blue inside, red "
      "outside"},
     {MeanCurvature, "mean-curvature", "Mean curvature", "1/mm",
      "1/r on a sphere of radius r, 1/(2r) on a tube; negative in hollows"},
     {StaircaseWeight, "staircase-weight", "Staircase weight", "-",
      "Where Smooth with staircase awareness acts: 1 at steps between image slices, with its "
      "default thresholds"},
     {NeighbourDistance, "neighbour-distance", "Distance to neighbours", "mm",
      "Distance to the nearest of the loaded neighbour structures"},
     {TriangleQuality, "triangle-quality", "Triangle quality", "-",
      "2 r_in / r_out of the worst triangle at each vertex: 1 is equilateral, 0 degenerate"},
     {LocalRadius, "local-radius", "Local radius", "mm",
      "Radius of the largest sphere inside the vessel, along its centerline"},
     {TetrahedraQuality, "tetrahedra-quality", "Tetrahedron quality", "deg",
      "Smallest dihedral angle of the tetrahedra that the section plane cuts: 70.5 is the best"}}};

constexpr double kLowest = 0.02, kHighest = 0.98;  ///< percentiles of the automatic range [-]
constexpr double kLeastSpread = 0.02;              ///< of a range, relative to its values [-]

Vec3 stack_axis(const Scene& scene) {
    if (scene.sampling && scene.sampling->confidence > 0.0) return scene.sampling->axes.col(2);
    const StackOrientation estimate = estimate_stack_orientation(*scene.surface);
    if (!estimate.certain)
        throw AlgorithmFailure(
            "the direction of the image stack is uncertain: the surface has no image and too few "
            "staircases");
    return estimate.direction;
}

std::vector<double> staircase_values(const Scene& scene) {
    const auto finder = make_cpu_finder(*scene.surface);
    const auto caps = cap_vertices(finder->caps(), scene.surface->vertex_count());
    return finder->staircases(stack_axis(scene), {.caps = caps}).weights;
}

std::vector<double> neighbour_values(const Scene& scene) {
    std::vector<Surface> neighbours;
    for (const auto& [name, surface] : scene.neighbours)
        if (!surface.empty()) neighbours.push_back(surface);
    return neighbour_distances(scene.surface->points(), neighbours);
}

std::vector<double> triangle_values(const Surface& surface) {
    std::vector<double> worst(surface.vertex_count(), std::numeric_limits<double>::quiet_NaN());
    const Positions& x = surface.points();
    for (const Triangle& t : surface.triangles()) {
        const double ratio = radius_ratio(x[t[0]], x[t[1]], x[t[2]]);
        for (const VertexId v : t) worst[v] = std::fmin(worst[v], ratio);
    }
    return worst;
}

std::vector<double> tetrahedra_values(const VolumeMesh& mesh, const Progress& progress) {
    constexpr std::size_t kBetweenChecks = 1 << 14;
    std::vector<double> values(mesh.tetrahedra.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (i % kBetweenChecks == 0) progress.check_cancelled();
        const Tetrahedron& t = mesh.tetrahedra[i];
        values[i] = std::ranges::min(dihedral_angles(mesh.points[t[0]], mesh.points[t[1]],
                                                     mesh.points[t[2]], mesh.points[t[3]]));
    }
    return values;
}

std::vector<double> values_of(ColouringKind kind, const Scene& scene, const Progress& progress) {
    switch (kind) {
        case MeanCurvature:
            return mean_curvature_of(*scene.surface)->values;
        case StaircaseWeight:
            return staircase_values(scene);
        case NeighbourDistance:
            return neighbour_values(scene);
        case TriangleQuality:
            return triangle_values(*scene.surface);
        case LocalRadius:
            return local_radii(*centerlines_of(*scene.surface, {}, progress),
                               scene.surface->points());
        case TetrahedraQuality:
            return tetrahedra_values(*scene.volume_mesh, progress);
        default:
            throw InvalidInput(std::string("'") + colouring_info(kind).name +
                               "' has no values of its own: choose another colouring");
    }
}

}  // namespace

std::span<const ColouringInfo> colourings() {
    return kColourings;
}

const ColouringInfo& colouring_info(ColouringKind kind) {
    return *std::ranges::find(kColourings, kind, &ColouringInfo::kind);
}

ValueRange shown_range(std::vector<double> values) {
    std::erase_if(values, [](double value) { return !std::isfinite(value); });
    if (values.empty()) return {};
    ValueRange range{percentile(values, kLowest), percentile(values, kHighest)};
    const double size = std::max({std::abs(range.least), std::abs(range.most), 1e-9});
    const double missing = kLeastSpread * size - (range.most - range.least);
    if (missing > 0.0) {
        range.least -= missing / 2;
        range.most += missing / 2;
    }
    return range;
}

std::string why_no_colours(ColouringKind kind, const Scene& scene) {
    if (!scene.surface || scene.surface->empty()) return "There is no surface yet";
    if (kind == NeighbourDistance && std::ranges::all_of(scene.neighbours, [](const auto& entry) {
            return entry.second.empty();
        }))
        return "No neighbouring structure: run Load neighbour";
    if (kind == TetrahedraQuality && (!scene.volume_mesh || scene.volume_mesh->tetrahedra.empty()))
        return "No volume mesh yet: run Tetrahedralize";
    return "";
}

ColourValues colour_values(ColouringKind kind, const Scene& scene, const Progress& progress) {
    if (const std::string reason = why_no_colours(kind, scene); !reason.empty())
        throw InvalidInput(reason);
    ColourValues found{.kind = kind, .values = values_of(kind, scene, progress)};
    found.range = shown_range(found.values);
    return found;
}

std::vector<double> local_radii(const CenterlineGraph& graph, std::span<const Vec3> positions) {
    // Segments as triangles without area, so that the surface's search tree finds the nearest.
    Positions points;
    std::vector<double> radii;
    std::vector<Triangle> segments;
    for (const CenterlineBranch& branch : graph.branches) {
        const auto first = static_cast<VertexId>(points.size());
        points.insert(points.end(), branch.points.begin(), branch.points.end());
        radii.insert(radii.end(), branch.radii.begin(), branch.radii.end());
        for (VertexId i = first; i + 1 < points.size(); ++i) segments.push_back({i, i + 1, i + 1});
    }
    const auto nearest = SurfaceDistance(points, segments).closest_points(positions);
    std::vector<double> found(positions.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
        const auto& [from, to, again] = segments[nearest[i].triangle];
        const double length = (points[to] - points[from]).norm();
        const double share = length > 0.0 ? (nearest[i].point - points[from]).norm() / length : 0.0;
        found[i] = radii[from] + share * (radii[to] - radii[from]);
    }
    return found;
}

}  // namespace vesselbench
