#include <algorithm>
#include <sstream>

#include <nlohmann/json.hpp>

#include "geometry/errors.h"
#include "geometry/wording.h"
#include "smoothing/laplace.h"
#include "smoothing/laplace_hc.h"
#include "smoothing/new_crossings.h"
#include "smoothing/taubin.h"
#include "workbench/operations/table.h"

namespace vesselbench {

namespace {

std::vector<std::uint8_t> cap_vertices(const Surface& surface) {
    std::vector<std::uint8_t> flags(surface.vertex_count(), 0);
    for (TriangleId t = 0; t < surface.triangle_count(); ++t)
        if (surface.patch_of(t).kind != PatchKind::Wall)
            for (const VertexId v : surface.triangles()[t]) flags[v] = 1;
    return flags;
}

/// Volume [mm^3] with every opening closed by a fan around its centroid.
double enclosed_volume(const Surface& surface, const Positions& points) {
    const Vec3 origin = points.front();
    const auto six_fold = [&](const Vec3& a, const Vec3& b, const Vec3& c) {
        return (a - origin).dot((b - origin).cross(c - origin));
    };
    double sum = 0.0;
    for (const auto& [a, b, c] : surface.triangles())
        sum += six_fold(points[a], points[b], points[c]);
    for (const auto& loop : surface.topology->boundary_loops()) {
        Vec3 centroid = Vec3::Zero();
        for (const VertexId v : loop) centroid += points[v] / static_cast<double>(loop.size());
        for (std::size_t i = 0; i < loop.size(); ++i)
            sum += six_fold(points[loop[(i + 1) % loop.size()]], points[loop[i]], centroid);
    }
    return sum / 6.0;
}

struct Request {
    double lambda = 0.5;
    int iterations = 20;
    std::vector<std::uint8_t> fixed;
};

Request request_from(const Surface& surface, const Arguments& arguments) {
    return {arguments.real("lambda"), static_cast<int>(arguments.integer("iterations")),
            cap_vertices(surface)};
}

Positions run_laplace(const Surface& surface, const Request& request, const Progress& progress) {
    return laplace(*surface.topology, surface.points(), {.lambda = request.lambda},
                   {.iterations = request.iterations, .fixed = request.fixed}, progress);
}

Positions run_laplace_hc(const Surface& surface, const Request& request, Outcome& outcome,
                         const Progress& progress) {
    const LaplaceHcParameters parameters{.lambda = request.lambda,
                                         .alpha = outcome.resolved.real("alpha"),
                                         .beta = outcome.resolved.real("beta")};
    if (amplifies(parameters))
        outcome.warnings.push_back(
            "Laplace+HC with these values roughens the surface instead of smoothing it: keep "
            "(1 - beta) * lambda at or below 0.5");
    return laplace_hc(*surface.topology, surface.points(), parameters,
                      {.iterations = request.iterations, .fixed = request.fixed}, progress);
}

Positions run_taubin(const Surface& surface, const Request& request, Outcome& outcome,
                     const Progress& progress) {
    TaubinParameters parameters{.lambda = request.lambda,
                                .mu = outcome.resolved.optional_real("mu")};
    if (parameters.used_mu() > -parameters.lambda) {
        std::ostringstream text;
        text << "smooth: mu = " << parameters.used_mu()
             << " must be at most -lambda = " << -parameters.lambda
             << "; mu is negative, -1.02 * lambda when it is left out";
        throw UsageError(text.str());
    }
    outcome.resolved.set("mu", parameters.used_mu());
    if (amplifies(parameters))
        outcome.warnings.push_back(
            "Taubin with these values enlarges the finest bumps: use a smaller lambda (0.5 is "
            "safe)");
    return taubin(*surface.topology, surface.points(), parameters,
                  {.iterations = request.iterations, .fixed = request.fixed}, progress);
}

Report report_of(const Surface& before, const Surface& after, const Request& request) {
    double largest = 0.0, sum = 0.0;
    for (std::size_t v = 0; v < before.vertex_count(); ++v) {
        const double moved = (after.points()[v] - before.points()[v]).norm();
        largest = std::max(largest, moved);
        sum += moved;
    }
    const double volume_before = enclosed_volume(before, before.points());
    const double volume_after = enclosed_volume(after, after.points());
    return std::make_shared<nlohmann::ordered_json>(nlohmann::ordered_json{
        {"volume_before_mm3", volume_before},
        {"volume_after_mm3", volume_after},
        {"volume_change_percent", 100.0 * (volume_after - volume_before) / volume_before},
        {"largest_displacement_mm", largest},
        {"mean_displacement_mm", sum / static_cast<double>(before.vertex_count())},
        {"cap_vertices_kept", std::count(request.fixed.begin(), request.fixed.end(), 1)}});
}

/// No filter may make the surface pass through itself; what was held back is told.
void keep_walls_apart(const Surface& surface, Positions& moved, Outcome& outcome,
                      const Progress& progress) {
    const TakenBack taken = take_back_crossings(surface, moved, progress);
    if (taken.vertices == 0) return;
    std::ostringstream text;
    text << taken.vertices << " vertices moved less than the filter wanted, first near "
         << place_text(taken.place) << ": walls would have passed through each other";
    if (taken.crossings_left > 0)
        text << "; " << taken.crossings_left
             << " pairs of triangles still do: use fewer iterations, or repair";
    outcome.warnings.push_back(text.str());
}

Outcome smooth(const Scene& scene, const Arguments& arguments, Progress& progress) {
    const Surface& surface = surface_of(scene);
    const Request request = request_from(surface, arguments);
    Outcome outcome;
    outcome.resolved = arguments;
    const std::string& filter = arguments.text("filter");
    Positions moved = filter == "laplace"  ? run_laplace(surface, request, progress)
                      : filter == "taubin" ? run_taubin(surface, request, outcome, progress)
                                           : run_laplace_hc(surface, request, outcome, progress);
    keep_walls_apart(surface, moved, outcome, progress);
    Surface smoothed = surface.with_positions(std::move(moved));
    outcome.report = report_of(surface, smoothed, request);
    outcome.scene = with_surface(scene, std::move(smoothed));
    return outcome;
}

}  // namespace

Operation smooth_operation() {
    using enum ParameterType;
    return {
        .name = "smooth",
        .usual_step = Step::Smoothing,
        .allowed = {Step::Source, Step::Branches, Step::LocalRepair, Step::Openings,
                    Step::Smoothing, Step::Deformation, Step::Remeshing},
        .summary = "smooth the whole surface; caps, their rims and open boundaries stay",
        .parameters =
            {{.name = "filter",
              .type = Choice,
              .default_value = "laplace-hc",
              .help = "laplace shrinks the vessel, laplace-hc hardly does, taubin keeps the "
                      "volume and smooths most",
              .choices = {"laplace", "laplace-hc", "taubin"}},
             {.name = "iterations",
              .type = Integer,
              .default_value = std::int64_t{20},
              .help = "number of passes; more is smoother",
              .minimum = 0,
              .maximum = 10000},
             {.name = "lambda",
              .unit = "-",
              .default_value = 0.5,
              .help = "share of the way to the neighbours' mean that a vertex goes in one pass",
              .minimum = 0.0,
              .maximum = 1.0},
             {.name = "mu",
              .unit = "-",
              .help = "taubin only: the inflating step, negative, at most -lambda; -1.02 lambda "
                      "when left out",
              .minimum = -2.0,
              .maximum = 0.0},
             {.name = "alpha",
              .unit = "-",
              .default_value = 0.0,
              .help = "laplace-hc only: 1 pulls back to the original positions, 0 to those of "
                      "the last pass",
              .minimum = 0.0,
              .maximum = 1.0},
             {.name = "beta",
              .unit = "-",
              .default_value = 0.5,
              .help = "laplace-hc only: a vertex' own share of the back-correction; the rest "
                      "comes from its neighbours",
              .minimum = 0.0,
              .maximum = 1.0},
             {.name = "caps",
              .type = Choice,
              .default_value = "keep",
              .help = "keep: vertices of caps and their rims stay bit for bit",
              .choices = {"keep"}}},
        .run = &smooth,
        .thesis = "3.3.4"};
}

}  // namespace vesselbench
