#include "meshing/remeshing/remesh.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "geometry/kernel/argument_checks.h"
#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/edges.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/measure.h"
#include "geometry/kernel/self_intersections.h"
#include "geometry/kernel/statistics.h"
#include "geometry/kernel/triangle_shape.h"
#include "geometry/kernel/wording.h"
#include "geometry/vessel/repair/repair.h"
#include "meshing/remeshing/carried_attributes.h"
#include "meshing/remeshing/cell_estimate.h"
#include "meshing/remeshing/local_radius.h"
#include "meshing/remeshing/remesh_rounds.h"
#include "meshing/remeshing/sizing_field.h"

namespace vesselbench {

namespace {

constexpr int kMendRounds = 5;          // of the same around bad places
constexpr int kMostAttempts = 3;        // to remove bad places, finer there each time
constexpr int kMostToHold = 6;          // to come near enough to the source
constexpr double kLeastQuality = 0.36;  // of 1 - skewness and radius ratio; solvers want 0.35
constexpr double kFiner = 0.6;

constexpr double kEdgePerRadius = 0.28;              // 22 triangles around
constexpr double kLeastEdge = 0.2, kMostEdge = 2.0;  // in edges
constexpr double kThin = 0.01;                       // of the wall's vertices

constexpr double kMostVolumeChange = 0.2;  // [-]

/// Fewer edges around a vessel do not show its section.
constexpr double kFewestAround = 12.0;
constexpr int kMostFits = 4;

/// The most triangles that are made without being asked for: a tetrahedral mesh has ten times as
/// many.
constexpr double kMostChosen = 1e6;

/// Triangles that target edges would make, by the surface's area.
double expected_count(const Surface& surface, const std::vector<double>& sizes) {
    double count = 0.0;
    for (const auto& [a, b, c] : surface.triangles()) {
        const double size = (sizes[a] + sizes[b] + sizes[c]) / 3.0;
        count += 0.5 * area_normal(surface.points(), {a, b, c}).norm() /
                 (std::sqrt(3.0) / 4.0 * size * size);
    }
    return count;
}

/// A count far beyond what can be made is known before.
void check_count(const Surface& surface, const std::vector<double>& sizes, double edge) {
    const double count = expected_count(surface, sizes);
    const auto most = static_cast<double>(Remesher::kMostTriangles);
    if (count <= most) return;
    const double finest = 1.1 * edge * std::sqrt(count / most);
    throw DiagnosedFailure(
        {.code = "edges-too-fine",
         .operation = "remesh",
         .figures = {{"edge_mm", edge}, {"millions", count / 1e6}, {"most_millions", most / 1e6}},
         .remedies = {{.arguments = {{"edge", formatted(finest, "%.2g")}}}}});
}

/// Edges that were not asked for become longer where they would make too many triangles.
void limit_count(const Surface& surface, std::vector<double>& sizes, RemeshReport& report) {
    const double factor = std::sqrt(expected_count(surface, sizes) / kMostChosen);
    if (factor <= 1.0) return;
    for (double& size : sizes) size *= factor;
    for (double* edge : {&report.edge, &report.min_edge, &report.max_edge}) *edge *= factor;
    report.limited = true;
}

std::vector<double> target_lengths(std::vector<double> sizes) {
    for (double& size : sizes) size /= Remesher::kStretch;
    return sizes;
}

bool is_ill_shaped(const Surface& surface, TriangleId t) {
    const auto& [a, b, c] = surface.triangles()[t];
    const Positions& points = surface.points();
    return 1.0 - equiangle_skewness(points[a], points[b], points[c]) < kLeastQuality ||
           radius_ratio(points[a], points[b], points[c]) < kLeastQuality;
}

/// The places where the result crosses itself, or a triangle could not be made well-shaped.
Positions bad_places(const Surface& result, const Progress& cancel) {
    Positions places;
    const auto add = [&](TriangleId t) {
        places.push_back(triangle_centre(result.points(), result.triangles()[t]));
    };
    for (const auto& [s, t] : self_intersections(result, cancel)) {
        add(s);
        add(t);
    }
    for (TriangleId t = 0; t < result.triangle_count(); ++t)
        if (is_ill_shaped(result, t)) add(t);
    return places;
}

/// Shortens the target edges of the source within two edges of the places.
void refine(const Surface& source, const Positions& places, double gradation,
            std::vector<double>& sizes) {
    for (std::size_t v = 0; v < sizes.size(); ++v)
        if (std::any_of(places.begin(), places.end(), [&](const Vec3& place) {
                return (place - source.points()[v]).norm() < 2.0 * sizes[v];
            }))
            sizes[v] *= kFiner;
    limit_slope(source, slope_of(gradation), sizes);
}

[[noreturn]] void refuse_crossing(const Surface& source, const Surface& result) {
    const auto old = self_intersections(source);
    const Surface& crossing = old.empty() ? result : source;
    const TriangleId t = old.empty() ? self_intersections(result).front().first : old.front().first;
    throw DiagnosedFailure({.code = old.empty() ? "would-cross-itself" : "crosses-itself",
                            .operation = "remesh",
                            .place = crossing.points()[crossing.triangles()[t][0]],
                            .words = {{"advice",
                                       "edges a fifth as long do not help, nor does cutting the "
                                       "crossing out: part the walls in the segmentation, or take "
                                       "one of the vessels away before"}},
                            .remedies = old.empty() ? std::vector<Remedy>()
                                                    : std::vector{Remedy{.operation = "repair"}}});
}

/// Cutting crossings out may leave crumbs, which are dropped; a vessel would be larger than this
/// fraction of the area.
constexpr double kCrumb = 1e-3;

std::size_t ill_shaped_count(const Surface& surface) {
    std::size_t count = 0;
    for (TriangleId t = 0; t < surface.triangle_count(); ++t)
        count += is_ill_shaped(surface, t) ? 1 : 0;
    return count;
}

/// 0 at the corners of ill-shaped triangles, else 1; by vertex.
std::vector<std::uint8_t> well_shaped_vertices(const Surface& surface) {
    std::vector<std::uint8_t> well_shaped(surface.vertex_count(), 1);
    for (TriangleId t = 0; t < surface.triangle_count(); ++t)
        if (is_ill_shaped(surface, t))
            for (const VertexId v : surface.triangles()[t]) well_shaped[v] = 0;
    return well_shaped;
}

/// Cutting and filling leaves slivers: around them the surface is remeshed once more, as it is now.
/// \param before gives the sizes
/// \return the surface as it was if that brings nothing, or crossings
Surface mended(const Remesher& before, const Surface& cut, const Progress& progress) {
    constexpr int kRings = 4;
    const std::size_t ill_shaped = ill_shaped_count(cut);
    if (ill_shaped == 0) return cut;
    std::vector<double> sizes(cut.vertex_count());
    for (TriangleId t = 0; t < cut.triangle_count(); ++t)
        for (const VertexId v : cut.triangles()[t])
            sizes[v] = before.target
                           .on_patch((*cut.patch_labels)[t], cut.points()[v], TargetPlace::kNowhere)
                           .size;
    Remesher remesher(cut, sizes, cut, progress);
    remesher.rest_beyond(well_shaped_vertices(cut), kRings);
    Surface result = remeshed(remesher, kRemeshRounds - kMendRounds, progress);
    const bool better = ill_shaped_count(result) < ill_shaped && self_intersections(result).empty();
    return better ? result : cut;
}

/// Walls that almost touch may cross however fine their edges are: crossings there are smoothed, or
/// cut out and filled again.
Surface parted(const Surface& source, const Remesher& remesher, const Surface& result,
               RemeshReport& report, const Progress& progress) {
    const auto crossings = self_intersections(result);
    if (crossings.empty()) return result;
    report.crossings_parted = crossings.size();
    report.crossing = result.points()[result.triangles()[crossings.front().first][0]];
    try {
        progress.report(0.0, "separating walls that cross");
        Repaired repaired =
            repair(result, {.keep_components = connected_components(*source.topology).count()},
                   progress.part(0.0, 0.3));
        const double lost = 1.0 - area(repaired.surface) / area(result);
        // repair turns every component outward, which would fill a cavity
        if (!repaired.report.turned_inside_out && lost < kCrumb)
            return mended(remesher, repaired.surface, progress.part(0.3, 1.0));
    } catch (const AlgorithmFailure&) {
        // reported below, in terms of this operation
    }
    refuse_crossing(source, result);
}

/// \param sizes target edges [mm], #V; those of the result afterwards
Surface remeshed_until_sound(const Surface& surface, Remesher& remesher, std::vector<double>& sizes,
                             double gradation, RemeshReport& report, const Progress& progress) {
    constexpr double kFirst = 0.7, kLast = 0.95, kMore = (kLast - kFirst) / kMostAttempts;
    Surface result = remeshed(remesher, 0, progress.part(0.0, kFirst));
    for (int attempt = 0; attempt < kMostAttempts; ++attempt) {
        const Positions places = bad_places(result, progress.silent());
        if (places.empty()) return result;
        refine(surface, places, gradation, sizes);
        remesher.set_sizes(target_lengths(sizes));
        const double from = kFirst + attempt * kMore;
        result = remeshed(remesher, kRemeshRounds - kMendRounds, progress.part(from, from + kMore));
    }
    return parted(surface, remesher, result, report, progress.part(kLast, 1.0));
}

void report_deviation(const Deviations& off, double resolution, RemeshReport& report) {
    report.beyond_resolution.reset();
    if (off.largest.distance > resolution) report.beyond_resolution = off.largest;
}

/// Remeshes a result with shorter edges as long as it is off its source by more than is held. One
/// that crosses itself, or is worse shaped, is not taken: shorter edges show crossings of the
/// source that longer ones bridge.
/// \param first without crossings
/// \return the last one taken; the report says where it is off
Surface held(const Surface& source, Remesher& remesher, Surface first, std::vector<double> sizes,
             const RemeshParameters& parameters, RemeshReport& report, const Progress& progress) {
    const std::size_t most_ill_shaped = ill_shaped_count(first);
    Surface taken = first, result = std::move(first);
    for (int attempt = 0;; ++attempt) {
        const Deviations off = deviations_from(source, result, progress.silent());
        const Positions places = bad_places(result, progress.silent());
        const std::size_t ill_shaped = ill_shaped_count(result);
        if (ill_shaped <= most_ill_shaped && places.size() == ill_shaped) {
            taken = result;
            report_deviation(off, parameters.resolution, report);
            if (!report.beyond_resolution) return taken;
        }
        if (attempt == kMostToHold) return taken;
        shorten_where_off(off, parameters.resolution, sizes);
        limit_slope(source, slope_of(parameters.gradation), sizes, progress.silent());
        if (!places.empty()) refine(source, places, parameters.gradation, sizes);
        if (expected_count(source, sizes) > kMostChosen) return taken;
        remesher.set_sizes(target_lengths(sizes));
        const double from = static_cast<double>(attempt) / kMostToHold;
        result = remeshed(remesher, kRemeshRounds - kMendRounds,
                          progress.part(from, from + 1.0 / kMostToHold));
    }
}

/// \param sizes target edges [mm], #V
/// \param hold whether the parameters' resolution is held
Surface remeshed_by(const Surface& surface, std::vector<double> sizes,
                    const RemeshParameters& parameters, bool hold, RemeshReport& report,
                    const Progress& progress) {
    check_count(surface, sizes, report.edge);
    const double sound = hold ? 0.5 : 1.0;
    Remesher remesher(surface, target_lengths(sizes), surface, progress);
    Surface result = remeshed_until_sound(surface, remesher, sizes, parameters.gradation, report,
                                          progress.part(0.0, sound));
    if (!hold) return result;
    if (report.crossings_parted > 0) {
        // Finer edges would cross again.
        report_deviation(deviations_from(surface, result, progress.silent()), parameters.resolution,
                         report);
        return result;
    }
    return held(surface, remesher, std::move(result), std::move(sizes), parameters, report,
                progress.part(sound, 1.0));
}

/// Radii of the circles of the caps' areas [mm], by patch; 0: it is none.
std::vector<double> opening_radii(const Surface& surface) {
    std::vector<double> radii(surface.patches.size(), 0.0);
    for (TriangleId t = 0; t < surface.triangle_count(); ++t)
        if (surface.patch_of(t).kind != PatchKind::Wall)
            radii[(*surface.patch_labels)[t]] +=
                0.5 * area_normal(surface.points(), surface.triangles()[t]).norm();
    for (double& radius : radii) radius = std::sqrt(radius / std::numbers::pi);
    return radii;
}

/// An opening is no wider than its cap, however wide the vessel is that its line comes from.
std::vector<double> limited_at_openings(const Surface& surface, std::vector<double> radii,
                                        const std::vector<double>& openings) {
    for (TriangleId t = 0; t < surface.triangle_count(); ++t)
        if (const double opening = openings[(*surface.patch_labels)[t]]; opening > 0.0)
            for (const VertexId v : surface.triangles()[t]) radii[v] = std::min(radii[v], opening);
    return radii;
}

/// Radius of the thinnest vessels, or of the narrowest opening [mm].
double thin_radius(std::vector<double> radii, const std::vector<double>& openings) {
    double thin = percentile(radii, kThin);
    for (const double opening : openings)
        if (opening > 0.0) thin = std::min(thin, opening);
    return thin;
}

/// Targets below this fraction of the model's extent overflow where triangles are counted [-].
constexpr double kShortestGiven = 1e-6;

/// \throw AlgorithmFailure that names an edge length out of proportion to the model
void check_extent(const Surface& surface, const RemeshParameters& parameters, double usual_radius) {
    const double least = kShortestGiven * bounds(surface).diagonal();
    for (const auto& [name, edge] : {std::pair("edge", parameters.edge),
                                     {"min_edge", parameters.min_edge},
                                     {"max_edge", parameters.max_edge}})
        if (edge && *edge < least)
            throw DiagnosedFailure(
                {.code = "edge-out-of-proportion",
                 .operation = "remesh",
                 .figures = {{"edge_mm", *edge}},
                 .words = {{"name", name}},
                 .remedies = {
                     {.arguments = {{"edge", formatted(kEdgePerRadius * usual_radius, "%.2g")}}}}});
    // A max_edge longer than the model limits nothing.
    if (parameters.edge) require_in_proportion("edge", *parameters.edge, surface, 1.0);
    if (parameters.min_edge) require_in_proportion("min_edge", *parameters.min_edge, surface, 1.0);
}

struct Decided {
    std::vector<double> radii;  ///< #V [mm]
    double thin;                ///< radius of the thinnest vessels [mm]
    RemeshReport report;
};

/// The edges that belong to an edge length at the typical radius.
void decide_range(double edge, double thin, const RemeshParameters& parameters,
                  RemeshReport& report) {
    report.edge = edge;
    // A tree may have twigs far thinner than its trunk: they need edges of their own size.
    report.min_edge =
        parameters.min_edge.value_or(edge * std::min(kLeastEdge, thin / report.usual_radius));
    report.max_edge = parameters.max_edge.value_or(kMostEdge * edge);
}

Decided decided(const Surface& surface, const RemeshParameters& parameters,
                const CenterlineGraph* lines, const Progress& progress) {
    if (surface.empty()) throw InvalidInput("there is no surface to remesh");
    if (parameters.edge && !(*parameters.edge > 0.0 && std::isfinite(*parameters.edge)))
        throw InvalidInput("edge = " + std::to_string(*parameters.edge) + " must be above 0 mm");
    const std::vector<double> openings = opening_radii(surface);
    std::vector<double> radii =
        limited_at_openings(surface, local_radii(surface, lines, progress), openings);
    RemeshReport report;
    report.usual_radius = usual_radius(surface, radii);
    check_extent(surface, parameters, report.usual_radius);
    const double thin = thin_radius(radii, openings);
    decide_range(parameters.edge.value_or(kEdgePerRadius * report.usual_radius), thin, parameters,
                 report);
    report.triangles_before = surface.triangle_count();
    return {std::move(radii), thin, report};
}

/// Target edges of the vertices for the edges in the report [mm].
std::vector<double> sizes_for(const Surface& surface, const Decided& decided,
                              const RemeshParameters& parameters, const Progress& progress) {
    return sizing_field(surface, decided.radii,
                        {.edge = decided.report.edge,
                         .min_edge = decided.report.min_edge,
                         .max_edge = decided.report.max_edge,
                         .gradation = parameters.gradation,
                         .resolution = parameters.resolution},
                        progress);
}

/// Lengthens the edges until no more cells than asked for fill the lumen, or the fewest edges that
/// still show a vessel go around it. The edges that are decided make the same sizes when given.
void fit_cells(const Surface& surface, const RemeshParameters& parameters, Decided& decided,
               std::vector<double>& sizes, const Progress& progress) {
    constexpr double kClose = 1.03, kCubes = 1.0 / 2.5;  // the cells go with the edge's power
    const double longest = 2.0 * std::numbers::pi / kFewestAround * decided.report.usual_radius;
    RemeshReport& report = decided.report;
    double cells = expected_cells(surface, sizes, decided.radii);
    for (int fits = 0; fits < kMostFits; ++fits) {
        if (cells <= kClose * *parameters.cells || report.edge >= longest) return;
        const double fitting = report.edge * std::pow(cells / *parameters.cells, kCubes);
        decide_range(std::min(longest, three_digits(fitting)), decided.thin, parameters, report);
        sizes = sizes_for(surface, decided, parameters, progress);
        report.cells = cells = expected_cells(surface, sizes, decided.radii);
    }
}

/// Target edges of the vertices [mm].
std::vector<double> graded_sizes(const Surface& surface, const RemeshParameters& parameters,
                                 Decided& decided, const Progress& progress) {
    std::vector<double> sizes = sizes_for(surface, decided, parameters, progress);
    if (parameters.edge) return sizes;
    if (parameters.cells) fit_cells(surface, parameters, decided, sizes, progress);
    limit_count(surface, sizes, decided.report);
    return sizes;
}

Surface graded(const Surface& surface, const RemeshParameters& parameters, Decided& decided,
               const Progress& progress) {
    std::vector<double> sizes = graded_sizes(surface, parameters, decided, progress.part(0.0, 0.2));
    const bool hold = parameters.hold_resolution && parameters.resolution > 0.0;
    return remeshed_by(surface, std::move(sizes), parameters, hold, decided.report,
                       progress.part(0.2, 1.0));
}

Surface uniform(const Surface& surface, const RemeshParameters& parameters, RemeshReport& report,
                const Progress& progress) {
    return remeshed_by(surface, std::vector<double>(surface.vertex_count(), report.edge),
                       parameters, false, report, progress);
}

/// What is left of a vessel that is as thin as its edges is no vessel.
void check_volume(const Surface& before, const Surface& after, RemeshReport& report) {
    const double was = volume(before), is = volume(after);
    report.volume_change = was > 0.0 ? is / was - 1.0 : 0.0;
    if (std::abs(report.volume_change) <= kMostVolumeChange) return;
    const double suitable = kEdgePerRadius * report.usual_radius;
    throw DiagnosedFailure(
        {.code = "edges-too-coarse",
         .operation = "remesh",
         .figures = {{"edge_mm", report.edge}, {"before_mm3", was}, {"after_mm3", is}},
         .remedies = {{.arguments = {{"edge", formatted(suitable, "%.2g")}}}}});
}

}  // namespace

RemeshReport decided_edges(const Surface& surface, const RemeshParameters& parameters,
                           const CenterlineGraph* lines, const Progress& progress) {
    Decided edges = decided(surface, parameters, lines, progress.part(0.0, 0.5));
    if (parameters.mode == RemeshMode::Graded)
        static_cast<void>(graded_sizes(surface, parameters, edges, progress.part(0.5, 1.0)));
    return edges.report;
}

Remeshed remesh(const Surface& surface, const RemeshParameters& parameters,
                const CenterlineGraph* lines, const Progress& progress) {
    Decided edges = decided(surface, parameters, lines, progress.part(0.0, 0.1));
    RemeshReport& report = edges.report;
    Surface result = parameters.mode == RemeshMode::Uniform
                         ? uniform(surface, parameters, report, progress.part(0.1, 1.0))
                         : graded(surface, parameters, edges, progress.part(0.1, 1.0));
    check_volume(surface, result, report);
    result = with_attributes_of(surface, std::move(result));
    report.triangles_after = result.triangle_count();
    report.wall = wall_shape(result);
    report.caps = openings_shape(result);
    return {std::move(result), std::move(report)};
}

}  // namespace vesselbench
