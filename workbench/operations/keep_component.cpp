#include <algorithm>

#include <nlohmann/json.hpp>

#include "geometry/kernel/edges.h"
#include "geometry/kernel/surface_distance.h"
#include "workbench/operations/table.h"

namespace vesselbench {

namespace {

using nlohmann::ordered_json;

/// Component numbers by descending number of triangles; equal ones in file order.
std::vector<std::size_t> by_size(const Components& parts) {
    std::vector<std::size_t> order(parts.count());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return parts.triangle_counts[a] > parts.triangle_counts[b];
    });
    return order;
}

std::vector<bool> wanted_parts(const Surface& surface, const Components& parts,
                               const Arguments& arguments) {
    std::vector<bool> wanted(parts.count(), false);
    if (const auto seed = arguments.optional_point("seed")) {
        wanted[parts.of_triangle[distance_to(surface).closest_point(*seed).triangle]] = true;
        return wanted;
    }
    const auto order = by_size(parts);
    const auto count = static_cast<std::size_t>(arguments.integer("count"));
    for (std::size_t i = 0; i < std::min(count, order.size()); ++i) wanted[order[i]] = true;
    return wanted;
}

Outcome keep(const Scene& scene, const Arguments& arguments, Progress&) {
    const Surface& surface = surface_of(scene);
    const Components parts = connected_components(*surface.topology);
    const std::vector<bool> wanted = wanted_parts(surface, parts, arguments);
    std::vector<bool> chosen(surface.triangle_count());
    for (TriangleId t = 0; t < chosen.size(); ++t) chosen[t] = wanted[parts.of_triangle[t]];
    Surface kept = select_triangles(surface, chosen);
    Outcome outcome;
    outcome.resolved = arguments;
    outcome.report = std::make_shared<ordered_json>(
        ordered_json{{"components_before", parts.count()},
                     {"components_after", std::count(wanted.begin(), wanted.end(), true)}});
    outcome.scene = with_surface(scene, std::move(kept));
    return outcome;
}

}  // namespace

Operation keep_component_operation() {
    using enum ParameterType;
    return {.name = "keep-component",
            .usual_step = Step::Source,
            .allowed = {Step::Source},
            .summary = "keep one connected part of the surface, or the largest ones",
            .parameters = {{.name = "seed",
                            .type = Point,
                            .unit = "mm",
                            .help = "keep the part nearest to this point; default: the parts with "
                                    "the most triangles",
                            .meaning = Meaning::Place},
                           {.name = "count",
                            .type = Integer,
                            .unit = "-",
                            .default_value = std::int64_t{1},
                            .help = "number of the largest parts to keep, without seed",
                            .minimum = 1}},
            .run = &keep,
            .thesis = "3.2",
            .example = {.changed = {{"count", std::int64_t{2}}}}};
}

}  // namespace vesselbench
