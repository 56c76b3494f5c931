#include "meshing/remeshing/decimate.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/finite_positions.h"
#include "geometry/kernel/measure.h"
#include "geometry/kernel/reference_comparison.h"
#include "geometry/kernel/self_intersections.h"
#include "meshing/remeshing/carried_attributes.h"
#include "meshing/remeshing/decimater.h"
#include "meshing/remeshing/error_bound.h"

namespace vesselbench {

namespace {

constexpr int kMostAttempts = 6;  // to avoid new crossings

void require_sound(const Surface& surface, const DecimateParameters& parameters,
                   std::span<const double> weights) {
    if (surface.empty()) throw InvalidInput("there is no surface to decimate");
    require_finite(surface.points());
    if (!parameters.triangles && !parameters.max_error)
        throw InvalidInput("decimation needs a number of triangles or a largest error as a limit");
    if (parameters.triangles && *parameters.triangles == 0)
        throw InvalidInput("triangles = 0 leaves no surface: give at least 1");
    if (const auto error = parameters.max_error; error && !(*error > 0.0 && std::isfinite(*error)))
        throw InvalidInput("max_error = " + std::to_string(*error) + " must be above 0 mm");
    if (!weights.empty() && weights.size() != surface.vertex_count())
        throw InvalidInput("there are " + std::to_string(weights.size()) + " weights for " +
                           std::to_string(surface.vertex_count()) + " vertices");
    for (const double weight : weights)
        if (!(weight >= 0.0 && weight <= 1.0))
            throw InvalidInput("a weight of " + std::to_string(weight) + " is outside [0, 1]");
}

/// A ball around two triangles that cross.
struct Place {
    Vec3 centre = Vec3::Zero();
    double radius = 0.0;  ///< [mm]
};

Place place_of(const Surface& surface, const TrianglePair& pair) {
    Positions corners;
    for (const TriangleId t : {pair.first, pair.second})
        for (const VertexId v : surface.triangles()[t]) corners.push_back(surface.points()[v]);
    const Bounds box = bounds(corners);
    return {box.centre(), 0.5 * box.diagonal()};
}

std::vector<Place> crossing_places(const Surface& surface, const Progress& progress) {
    std::vector<Place> places;
    for (const TrianglePair& pair : self_intersections(surface, progress))
        places.push_back(place_of(surface, pair));
    return places;
}

/// The places where the result crosses itself and the source does not.
/// \param old the places where the source does; found on first use
std::vector<Place> new_crossings(const Surface& source, const Surface& result,
                                 std::optional<std::vector<Place>>& old, const Progress& progress) {
    std::vector<Place> places = crossing_places(result, progress);
    if (places.empty()) return places;
    if (!old) old = crossing_places(source, progress);
    std::erase_if(places, [&](const Place& place) {
        progress.check_cancelled();
        return std::ranges::any_of(*old, [&](const Place& known) {
            return (place.centre - known.centre).norm() <= place.radius + known.radius;
        });
    });
    return places;
}

void lock_around(const Surface& source, const std::vector<Place>& places, double reach,
                 std::vector<std::uint8_t>& locked, const Progress& progress) {
    progress.report(1.0, "separating walls");
    locked.resize(source.vertex_count(), 0);
    for (const Place& place : places) {
        progress.check_cancelled();
        for (VertexId v = 0; v < locked.size(); ++v)
            if ((source.points()[v] - place.centre).norm() <= reach * place.radius) locked[v] = 1;
    }
}

/// One run; the vertices in `locked` are kept.
Surface decimated_once(const Surface& source, const DecimateParameters& parameters,
                       std::span<const double> weights, std::span<const std::uint8_t> locked,
                       DecimateReport& report, const Progress& progress) {
    std::optional<ErrorBound> bound;
    if (parameters.max_error) bound.emplace(source, weights, *parameters.max_error);
    progress.check_cancelled();
    Decimater decimater(source, weights, locked, bound ? &*bound : nullptr);
    const std::size_t target = parameters.triangles.value_or(1);
    decimater.run(target, progress);
    report.triangles_after = decimater.triangles();
    report.kept_vertices_lost = decimater.kept_vertices_lost();
    report.target_reached = !parameters.triangles || decimater.triangles() <= target;
    return decimater.result(source.patches);
}

/// Where walls start to cross, the source's triangles are kept, in increasing balls.
Decimated decimated_apart(const Surface& surface, const DecimateParameters& parameters,
                          std::span<const double> weights, const Progress& progress) {
    DecimateReport report{.triangles_before = surface.triangle_count()};
    std::vector<std::uint8_t> locked;
    std::optional<std::vector<Place>> old;
    Surface result;
    for (int attempt = 0; attempt < kMostAttempts; ++attempt) {
        // Their number is unknown: each takes half of the remaining progress.
        const Progress own =
            progress.part(1.0 - std::exp2(-attempt), 1.0 - std::exp2(-attempt - 1));
        result = decimated_once(surface, parameters, weights, locked, report, own.part(0.0, 0.9));
        own.report(0.9, "finding crossings");
        const std::vector<Place> places = new_crossings(surface, result, old, own.silent());
        report.vertices_locked = std::ranges::count(locked, 1);
        report.crossings_left = places.size();
        if (places.empty()) break;
        report.crossing = places.front().centre;
        if (attempt + 1 < kMostAttempts) lock_around(surface, places, 1.0 + attempt, locked, own);
    }
    return {std::move(result), report};
}

}  // namespace

Decimated decimate(const Surface& surface, const DecimateParameters& parameters,
                   std::span<const double> weights, const Progress& progress) {
    require_sound(surface, parameters, weights);
    constexpr double kBelow = 0.97;  // of the limit implied by the last overrun
    DecimateParameters used = parameters;
    Decimated decimated = decimated_apart(surface, used, weights, progress.part(0.0, 0.5));
    for (int attempt = 0; parameters.max_error && attempt < kMostAttempts; ++attempt) {
        // The bound is enforced at samples of the triangles; the surface between them is checked at
        // the end.
        progress.report(1.0 - std::exp2(-attempt - 1), "measuring the error");
        if (!(area(surface) > 0.0 && area(decimated.surface) > 0.0)) break;
        const double largest =
            compare_with_reference(decimated.surface, surface, progress.silent()).hausdorff;
        if (largest <= *parameters.max_error) break;
        *used.max_error *= kBelow * *parameters.max_error / largest;
        decimated = decimated_apart(surface, used, weights, progress.silent());
    }
    decimated.surface = with_attributes_of(surface, std::move(decimated.surface));
    return decimated;
}

}  // namespace vesselbench
