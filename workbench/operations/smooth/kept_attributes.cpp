#include "workbench/operations/smooth/kept_attributes.h"

#include <algorithm>
#include <memory>
#include <sstream>
#include <utility>

#include "geometry/kernel/mean_curvature.h"
#include "smoothing/context/distance_weights.h"
#include "workbench/operations/smooth/context.h"

namespace vesselbench {

namespace {

void keep(Surface& surface, const char* name, std::vector<double> values) {
    surface.attributes[name] = std::make_shared<const std::vector<double>>(std::move(values));
}

/// The weights of staircases alone: 1 at their vertices and below elsewhere, 0 on caps.
std::vector<double> staircase_weights_alone(const Scene& scene, ContextFinder& finder,
                                            Arguments arguments) {
    arguments.set("distance", std::string("none"));
    arguments.set("beta_min", 0.0);
    arguments.remove("painted");
    return smoothing_context(scene, finder, arguments).weights;
}

/// The neighbours that the weights considered, or all that are loaded.
std::vector<Surface> considered_neighbours(const Scene& scene, const Arguments& resolved) {
    std::vector<Surface> found;
    const auto add = [&](const std::string& name) {
        const auto at = scene.neighbours.find(name);
        if (at != scene.neighbours.end() && !at->second.empty()) found.push_back(at->second);
    };
    if (const auto names = resolved.optional_text("neighbours")) {
        std::istringstream list(*names);
        for (std::string name; std::getline(list, name, ',');) add(name);
    } else {
        for (const auto& [name, surface] : scene.neighbours) add(name);
    }
    return found;
}

}  // namespace

Surface with_kept_attributes(const Scene& before, const Surface& after, const Arguments& resolved,
                             std::vector<double> local_error) {
    Surface kept = after;
    const auto finder = make_cpu_finder(surface_of(before));
    Arguments arguments = resolved;
    SmoothingContext context = smoothing_context(before, *finder, arguments);
    if (resolved.flag("staircase")) {
        std::vector<double> weights = staircase_weights_alone(before, *finder, resolved);
        std::vector<double> staircases(weights.size());
        for (std::size_t v = 0; v < weights.size(); ++v)
            staircases[v] = weights[v] == 1.0 && context.caps[v] == 0 ? 1.0 : 0.0;
        keep(kept, kStaircaseWeight, std::move(weights));
        keep(kept, kStaircase, std::move(staircases));
    }
    if (context.weights.empty()) {
        context.weights.assign(after.vertex_count(), 1.0);
        for (std::size_t v = 0; v < context.fixed.size(); ++v)
            if (context.fixed[v] != 0) context.weights[v] = 0.0;
    }
    keep(kept, kSmoothingWeight, std::move(context.weights));
    keep(kept, kCap, std::vector<double>(context.caps.begin(), context.caps.end()));
    if (const auto neighbours = considered_neighbours(before, resolved); !neighbours.empty())
        keep(kept, kNeighbourDistance, neighbour_distances(after.points(), neighbours));
    keep(kept, kLocalError, std::move(local_error));
    keep(kept, kMeanCurvature, mean_curvature_of(after)->values);
    return kept;
}

}  // namespace vesselbench
