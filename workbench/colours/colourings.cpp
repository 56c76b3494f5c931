#include "workbench/colours/colourings.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/mean_curvature.h"
#include "geometry/kernel/statistics.h"
#include "geometry/kernel/triangle_quality.h"
#include "geometry/vessel/centerlines/centerlines.h"
#include "geometry/vessel/centerlines/line_radii.h"
#include "meshing/tetrahedra/quality.h"
#include "smoothing/context/context_finder.h"
#include "smoothing/context/distance_weights.h"
#include "smoothing/context/staircases.h"
#include "workbench/operations/shared/stack_axis.h"

namespace vesselbench {

namespace {

using enum ColouringKind;

constexpr std::array<ColouringInfo, 8> kColourings = {
    {{Patches, "patches", "Patches", "", "Wall, inlet and outlets in colours of their own"},
     {Deviation, "deviation", "Deviation", "mm",
      "Distance from the source, or of a preview from the surface before it: blue inside, red "
      "outside",
      WorstEnd::FarthestFromZero},
     {MeanCurvature, "mean-curvature", "Mean curvature", "1/mm",
      "1/r on a sphere of radius r, 1/(2r) on a tube; negative in hollows",
      WorstEnd::FarthestFromZero},
     {StaircaseWeight, "staircase-weight", "Staircase weight", "-",
      "Where Smooth with staircase awareness acts: 1 at steps between image slices, with its "
      "default thresholds"},
     {NeighbourDistance, "neighbour-distance", "Distance to neighbours", "mm",
      "Distance to the nearest of the loaded neighbour structures", WorstEnd::Least},
     {TriangleQuality, "triangle-quality", "Triangle quality", "-",
      "2 r_in / r_out of the worst triangle at each vertex: 1 is equilateral, 0 degenerate",
      WorstEnd::Least},
     {LocalRadius, "local-radius", "Local radius", "mm",
      "Radius of the largest sphere inside the vessel, along its centerline", WorstEnd::Least},
     {TetrahedraQuality, "tetrahedra-quality", "Tetrahedron quality", "deg",
      "Smallest dihedral angle of the cells that the section plane cuts: 70.5 is a tetrahedron's "
      "best, 60 a prism's",
      WorstEnd::Least}}};

constexpr double kLowest = 0.02, kHighest = 0.98;  ///< percentiles of the automatic range [-]
constexpr double kLeastSpread = 0.02;              ///< of a range, relative to its values [-]

void find_staircases(const Scene& scene, ColourValues& found) {
    const auto finder = make_cpu_finder(*scene.surface);
    const auto choice = staircase_choice(scene, *finder, {});
    if (!choice)
        throw AlgorithmFailure(
            "the direction of the image stack is uncertain: the surface has no image and too few "
            "staircases");
    const auto caps = cap_vertices(finder->caps(), scene.surface->vertex_count());
    found.values =
        finder
            ->staircases(choice->axes,
                         {.tau_theta = choice->tau_theta, .tau_max = choice->tau_max, .caps = caps})
            .weights;
    found.sharpness =
        orientation_change(*scene.surface->topology, scene.surface->points(), choice->axes);
}

std::vector<double> neighbour_values(const Scene& scene) {
    std::vector<Surface> neighbours;
    for (const auto& [name, surface] : scene.neighbours)
        if (!surface.empty()) neighbours.push_back(surface);
    return neighbour_distances(scene.surface->points(), neighbours);
}

std::vector<double> values_of(ColouringKind kind, const Scene& scene, const Progress& progress) {
    switch (kind) {
        case MeanCurvature:
            return mean_curvature_of(*scene.surface)->values;
        case NeighbourDistance:
            return neighbour_values(scene);
        case TriangleQuality:
            return worst_triangle_quality(*scene.surface);
        case LocalRadius:
            return radii_of_nearest_lines(*centerlines_of(*scene.surface, {}, progress),
                                          scene.surface->points());
        case TetrahedraQuality:
            return smallest_dihedral_angles(*scene.volume_mesh, progress);
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
    ColourValues found{.kind = kind};
    if (kind == StaircaseWeight)
        find_staircases(scene, found);
    else
        found.values = values_of(kind, scene, progress);
    found.range = shown_range(found.values);
    return found;
}

}  // namespace vesselbench
