// What the wall's shape shows of the image and of its segmentation.

#include <algorithm>
#include <cmath>

#include "geometry/kernel/measure.h"
#include "geometry/kernel/wording.h"
#include "geometry/vessel/artefacts/wall_relief.h"
#include "smoothing/context/context_finder.h"
#include "smoothing/context/staircases.h"
#include "smoothing/context/voxel_grid.h"
#include "workbench/findings/detectors.h"
#include "workbench/operations/shared/stack_axis.h"

namespace vesselbench {

namespace {

constexpr std::size_t kMostSpots = 20;

/// Radius of a brush that reaches beyond a spot [radii of the spot].
constexpr double kBrush = 1.6;
constexpr double kLeastBrush = 3.0;  ///< [mean edges]

/// Bumps and dents are told from noise by their height, in standard deviations of the wall around
/// and in radii of the vessel: by the one that says less.
double certainty_of_spot(const WallSpot& spot, double least_height) {
    constexpr double kEvenScatter = 4.5, kSureScatter = 7.0;
    constexpr double kEvenHeight = 0.12, kSureHeight = 0.18;
    const double height = std::abs(spot.height);
    if (height < least_height) return certainty_of(0.0, 1.0, 2.0);
    return std::min(certainty_of(height / spot.scatter, kEvenScatter, kSureScatter),
                    certainty_of(height / spot.radius, kEvenHeight, kSureHeight));
}

/// A brush's pass moves a vertex by part of an edge: as many passes as edges lie across the spot,
/// squared, as diffusion takes.
std::string passes_for(double size, double edge) {
    const double across = size / edge;
    return std::to_string(std::clamp(static_cast<int>(std::lround(2.0 * across * across)), 4, 100));
}

Finding finding_of(const WallSpot& spot, FindingSubject& subject, const char* kind,
                   const char* code) {
    const double edge = subject.mean_edge();
    const double brush = std::max(kBrush * spot.size, kLeastBrush * edge);
    return {.kind = kind,
            .place = spot.place,
            .size = std::max(spot.size, edge),
            .certainty = certainty_of_spot(spot, edge * 0.25),
            .evidence = {.code = code,
                         .figures = {{"height_mm", std::abs(spot.height)},
                                     {"width_mm", 2.0 * spot.size},
                                     {"radius_mm", spot.radius},
                                     {"scatter_mm", spot.scatter}},
                         .remedies = {{.operation = "brush-smooth",
                                       .arguments = {{"at", coordinates_argument(spot.place)},
                                                     {"radius", formatted(brush)},
                                                     {"strength", "1"},
                                                     {"passes", passes_for(spot.size, edge)}}}}}};
}

/// \param side 1: bumps, -1: dents
std::vector<Finding> spots_on(FindingSubject& subject, double side, const char* kind,
                              const char* code, const Progress& progress) {
    std::vector<Finding> findings;
    for (const WallSpot& spot : subject.spots(progress)) {
        if (spot.height * side <= 0.0) continue;
        findings.push_back(finding_of(spot, subject, kind, code));
        if (findings.size() == kMostSpots) break;
    }
    return findings;
}

/// Intensities of nearly cubic voxels have no steps across one axis.
bool has_no_stack(const Scene& scene) {
    if (!scene.sampling) return false;
    const Vec3& spacing = scene.sampling->spacing;
    return spacing.maxCoeff() < VoxelGrid::kCubic * spacing.minCoeff();
}

/// Of the wall, without what lies flat on caps.
struct WallBends {
    std::size_t vertices = 0, on_steps = 0;
    VertexId sharpest = 0;
    double change = 0.0;  ///< there [-]

    [[nodiscard]] double share() const {
        return vertices > 0 ? static_cast<double>(on_steps) / static_cast<double>(vertices) : 0.0;
    }
};

WallBends bends_of(const Surface& surface, ContextFinder& finder, const StaircaseChoice& choice) {
    const std::vector<std::uint8_t> caps = cap_vertices(finder.caps(), surface.vertex_count());
    const std::vector<double> change =
        orientation_change(*surface.topology, surface.points(), choice.axes);
    WallBends bends;
    for (VertexId v = 0; v < change.size(); ++v) {
        if (caps[v] != 0) continue;
        ++bends.vertices;
        if (change[v] > choice.tau_theta) ++bends.on_steps;
        if (change[v] > bends.change) {
            bends.change = change[v];
            bends.sharpest = v;
        }
    }
    return bends;
}

}  // namespace

std::vector<Finding> find_bumps(FindingSubject& subject, const Progress& progress) {
    return spots_on(subject, 1.0, "bump", "found-bump", progress);
}

std::vector<Finding> find_dents(FindingSubject& subject, const Progress& progress) {
    return spots_on(subject, -1.0, "dent", "found-dent", progress);
}

std::vector<Finding> find_staircases(FindingSubject& subject, const Progress& progress) {
    // Shares of the wall's vertices. Blur leaves gentle steps of thick slices; creases of
    // furcations bend as sharply, on a hundredth of the wall.
    constexpr double kLeast = 0.01, kEven = 0.025, kSure = 0.04;
    const Surface& surface = subject.surface();
    const auto finder = make_cpu_finder(surface);
    const auto choice = staircase_choice(subject.scene(), *finder, {});
    progress.check_cancelled();
    if (!choice) return {};  // nothing shows where the slices were
    if (has_no_stack(subject.scene()) && choice->axes.size() == 1) return {};
    const WallBends bends = bends_of(surface, *finder, *choice);
    if (bends.share() < kLeast) return {};
    return {{.kind = "staircases",
             .place = surface.points()[bends.sharpest],
             .size = 0.5 * bounds(surface).diagonal(),
             .certainty = certainty_of(bends.share(), kEven, kSure),
             .evidence = {
                 .code = "found-staircases",
                 .figures = {{"share_percent", 100.0 * bends.share()},
                             {"tau_theta", choice->tau_theta},
                             {"sharpest", bends.change}},
                 .remedies = {{.operation = "smooth", .arguments = {{"staircase", "true"}}}}}}};
}

}  // namespace vesselbench
