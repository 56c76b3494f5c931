#include "geometry/vessel/openings/vessel_check.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/edges.h"
#include "geometry/kernel/measure.h"
#include "geometry/vessel/centerlines/branch_queries.h"

namespace vesselbench {

namespace {

/// Extent over typical radius (twice the volume over the area): a lung's arteries have about 300.
constexpr double kSlimmest = 1000.0;
/// Noise has a loop for every 40 triangles; a tree with loops has one for thousands.
constexpr std::size_t kMostLoops = 100;
constexpr std::size_t kTrianglesPerLoop = 500;
constexpr double kShortestTube = 1.5;  // diameters
/// All chambers of a heart with the great vessels hold about one litre [mm^3].
constexpr double kLargestLumen = 2e6;
constexpr double kLitre = 1e6;  // [mm^3]

/// True if a branch is a tube without the furcations at its ends.
bool is_tube(const CenterlineGraph& graph, std::size_t index) {
    const CenterlineBranch& branch = graph.branches[index];
    const double from = furcation_zone_end(graph, index, branch.start_node);
    const double to = branch_length(branch) - furcation_zone_end(graph, index, branch.end_node);
    const std::vector<double> s = abscissas(branch);
    double widest = 0.0;
    for (std::size_t i = 0; i < s.size(); ++i)
        if (s[i] >= from && s[i] <= to) widest = std::max(widest, branch.radii[i]);
    return widest > 0.0 && to - from > kShortestTube * 2.0 * widest;
}

Diagnostic noise(double loops, SurfaceOrigin source) {
    switch (source) {
        case SurfaceOrigin::Mask:
            return {.code = "mask-within-noise", .figures = {{"loops", loops}}};
        case SurfaceOrigin::File:
            return {.code = "surface-within-noise", .figures = {{"loops", loops}}};
        case SurfaceOrigin::Intensities:
            break;
    }
    return {.code = "vessel-within-noise",
            .figures = {{"loops", loops}},
            .remedies = {{.operation = "extract-surface", .arguments = {{"threshold", ""}}},
                         {.operation = "load-image", .arguments = {{"mask", ""}}}}};
}

/// What makes a vessel of such a source.
std::string way_to_vessel(SurfaceOrigin source) {
    switch (source) {
        case SurfaceOrigin::Mask:
            return "choose the vessel among the labels, or segment it";
        case SurfaceOrigin::File:
            return "export the vessel alone, and check the file's unit";
        case SurfaceOrigin::Intensities:
            break;
    }
    return "no threshold separates a vessel from all else in such an image: segment it, for "
           "instance in 3D Slicer, and give the segmentation with --mask";
}

}  // namespace

void require_lumen(const Surface& surface, SurfaceOrigin source) {
    if (surface.empty()) return;
    const double extent = bounds(surface).diagonal();
    const double radius = 2.0 * std::abs(volume(surface)) / area(surface);
    if (!(extent < kSlimmest * radius))
        throw DiagnosedInput({.code = "surface-is-sheet",
                              .figures = {{"width_mm", extent}, {"thickness_mm", radius}}});
    const auto loops = connectivity(*surface.topology).genus.value_or(0);
    if (loops > static_cast<int>(kMostLoops) &&
        static_cast<std::size_t>(loops) * kTrianglesPerLoop > surface.triangle_count())
        throw DiagnosedInput(noise(static_cast<double>(loops), source));
}

void require_vessel_size(const Surface& surface, SurfaceOrigin source) {
    if (surface.empty()) return;
    const double enclosed = std::abs(volume(surface));
    if (enclosed > kLargestLumen)
        throw DiagnosedInput({.code = "larger-than-vessels",
                              .figures = {{"litres", enclosed / kLitre}},
                              .words = {{"way", way_to_vessel(source)}}});
}

bool has_tube(const CenterlineGraph& graph) {
    for (std::size_t b = 0; b < graph.branches.size(); ++b)
        if (is_tube(graph, b)) return true;
    return false;
}

}  // namespace vesselbench
