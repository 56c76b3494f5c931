#include "workbench/prepare/model_figures.h"

#include <algorithm>
#include <cmath>

#include "geometry/kernel/statistics.h"
#include "geometry/kernel/surface_distance.h"
#include "workbench/operations/shared/context_weights.h"

namespace vesselbench {

namespace {

constexpr const char* kPrintResolution = "print_resolution";  // of remesh

std::optional<double> print_resolution(const std::vector<LogEntry>& edits) {
    std::optional<double> resolution;
    for (const LogEntry& entry : edits)
        if (entry.result && entry.result->resolved.has(kPrintResolution))
            resolution = entry.result->resolved.real(kPrintResolution);
    return resolution && *resolution > 0.0 ? resolution : std::nullopt;
}

/// A point of the source that lies inside the model says that the wall moved outward.
void add_distances(const Positions& source, const Surface& model, ModelFigures& figures) {
    if (source.empty()) return;
    const std::vector<double> inside_negative = distance_to(model).signed_distances(source);
    figures.offset = -mean(inside_negative);
    std::vector<double> distances;
    for (const double distance : inside_negative) distances.push_back(std::abs(distance));
    const auto largest = std::ranges::max_element(distances);
    figures.mean_lost = mean(distances);
    figures.largest_lost = *largest;
    figures.lost_place = source[static_cast<std::size_t>(largest - distances.begin())];
}

/// The wall away from the ends that were made.
Positions compared_points(const Surface& surface, const std::vector<MadeEnd>& ends) {
    return comparable_points(surface, comparable_vertices(surface, ends));
}

double smallest(const Surface& neighbour, const Positions& points) {
    return std::ranges::min(signed_distances_from_neighbour(neighbour, points));
}

/// Of points that both have: a stump that was cut off, or an end that was extended, may be nearest
/// to a neighbour although the wall has not moved.
void add_neighbours(const Positions& before, const Positions& after, const Scene& model,
                    ModelFigures& figures) {
    if (before.empty() || after.empty()) return;
    for (const auto& [name, neighbour] : model.neighbours)
        figures.neighbours[name] = smallest(neighbour, after) - smallest(neighbour, before);
}

}  // namespace

ModelFigures model_figures(const Scene& source, const Scene& model,
                           const std::vector<MadeEnd>& ends, const std::vector<LogEntry>& edits) {
    const Surface& surface = surface_of(model);
    ModelFigures figures = shape_figures(surface);
    figures.print_resolution = print_resolution(edits);
    if (!source.surface) return figures;
    if (source.sampling && source.sampling->confidence >= 1.0)
        figures.voxel_diagonal = source.sampling->spacing.norm();
    const Positions compared = compared_points(*source.surface, ends);
    add_distances(compared, surface, figures);
    add_neighbours(compared, compared_points(surface, ends), model, figures);
    return figures;
}

}  // namespace vesselbench
