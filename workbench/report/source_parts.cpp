#include "workbench/report/source_parts.h"

#include <algorithm>

#include "geometry/kernel/measure.h"
#include "geometry/kernel/surface_distance.h"
#include "gpu/role_colours.h"

namespace vesselbench {

namespace {

/// Smoothing and remeshing move the wall by less than this [mean edges].
constexpr double kFarthestMove = 2.0;

}  // namespace

std::vector<SourceFate> source_fates(const Surface& source, const Surface& model,
                                     const std::vector<ClosedEnd>& closed) {
    const auto nearest = distance_to(model).closest_points(source.points());
    const double farthest =
        kFarthestMove * std::max(mean_edge_length(source), mean_edge_length(model));
    std::vector<SourceFate> fates;
    for (std::size_t v = 0; v < source.vertex_count(); ++v) {
        const auto ends_here = [&](const ClosedEnd& end) {
            return (source.points()[v] - end.place).norm() <= end.diameter;
        };
        fates.push_back(nearest[v].distance > farthest           ? SourceFate::Lost
                        : std::ranges::any_of(closed, ends_here) ? SourceFate::Closed
                                                                 : SourceFate::Kept);
    }
    return fates;
}

Colour fate_colour(SourceFate fate) {
    switch (fate) {
        case SourceFate::Closed:
            return role_colour(ShownRole::Closed);
        case SourceFate::Lost:
            return {0.02F, 0.25F, 0.95F};
        case SourceFate::Kept:
            break;
    }
    return kWallColour;
}

}  // namespace vesselbench
