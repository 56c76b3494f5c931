#include <algorithm>
#include <limits>

#include <nlohmann/json.hpp>

#include "geometry/editing/hole_filling.h"
#include "geometry/kernel/errors.h"
#include "workbench/case/point_json.h"
#include "workbench/case/stated_change.h"
#include "workbench/operations/table.h"

namespace vesselbench {

namespace {

using nlohmann::ordered_json;

std::vector<VertexId> nearest_loop(const Surface& surface, const std::optional<Vec3>& near) {
    std::vector<VertexId> best;
    double nearest = std::numeric_limits<double>::infinity();
    for (auto& loop : surface.topology->boundary_loops()) {
        double distance = 0.0;
        if (near) {
            distance = (loop_centre(surface, loop) - *near).norm();
            for (const VertexId v : loop)
                distance = std::min(distance, (surface.points()[v] - *near).norm());
        }
        if (distance < nearest) {
            nearest = distance;
            best = std::move(loop);
        }
    }
    return best;
}

Outcome fill(const Scene& scene, const Arguments& arguments, Progress& progress) {
    Surface surface = surface_of(scene);
    const auto near = arguments.optional_point("near");
    const std::size_t holes = surface.topology->boundary_loops().size();
    if (holes == 0)
        throw AlgorithmFailure("fill-hole: the surface is closed: there is no hole to fill");
    ordered_json report = ordered_json::array();
    for (std::size_t done = 0; done < (near ? 1 : holes); ++done) {
        progress.report(static_cast<double>(done) / static_cast<double>(holes), "filling");
        const auto loop = nearest_loop(surface, near);
        if (loop.empty()) break;
        const Vec3 centre = loop_centre(surface, loop);
        const FilledHole filled =
            fill_hole(surface, loop, static_cast<int>(arguments.integer("continuity")));
        surface = filled.surface;
        report.push_back({{"centre_mm", point_json(centre)},
                          {"edges", loop.size()},
                          {"new_triangles", surface.triangle_count() - filled.first_new_triangle}});
    }
    Outcome outcome;
    outcome.resolved = arguments;
    outcome.report = std::make_shared<ordered_json>(ordered_json{{"holes", report}});
    outcome.scene = with_surface(scene, std::move(surface));
    return outcome;
}

constexpr double kDome = 3.0;  ///< new wall lies this near a hole's middle [radii of the hole]

/// Holes are closed, and the wall around them stays as it is.
StatedChange closed_holes(const Scene& before, const Outcome& outcome) {
    const Surface& surface = surface_of(before);
    StatedChange stated{.keeps_walls_apart = true};
    stated.zones.emplace();
    const auto near = outcome.resolved.optional_point("near");
    for (auto loops = surface.topology->boundary_loops(); const auto& loop : loops) {
        if (near && loop != nearest_loop(surface, near)) continue;
        const Vec3 centre = loop_centre(surface, loop);
        double radius = 0.0;
        for (const VertexId v : loop)
            radius = std::max(radius, (surface.points()[v] - centre).norm());
        stated.zones->push_back({centre, kDome * radius});
    }
    const auto holes = static_cast<int>(stated.zones->size());
    stated.rims = {-holes, -holes};
    if (outcome.resolved.integer("continuity") > 0)
        stated.remedies = {{.arguments = {{"continuity", "0"}}}};
    return stated;
}

}  // namespace

Operation fill_hole_operation() {
    using enum ParameterType;
    return {
        .name = "fill-hole",
        .usual_step = Step::LocalRepair,
        .allowed = {Step::Source, Step::Branches, Step::LocalRepair, Step::Openings,
                    Step::Smoothing, Step::Deformation, Step::Remeshing},
        .summary = "close holes in the wall so that it continues smoothly",
        .parameters =
            {{.name = "near",
              .type = Point,
              .unit = "mm",
              .help = "a point near the hole's border; default: every hole, including open vessel "
                      "ends",
              .meaning = Meaning::Place},
             {.name = "continuity",
              .type = Integer,
              .unit = "-",
              .default_value = std::int64_t{1},
              .help = "how the new wall joins the old one: 0 without a gap, 1 without a crease, 2 "
                      "with the same curvature",
              .minimum = 0,
              .maximum = 2}},
        .run = &fill,
        .may_change = &closed_holes,
        .thesis = "4.2.6",
        .example = {.scene = ExampleScene::Holes, .changed = {{"continuity", std::int64_t{0}}}}};
}

}  // namespace vesselbench
