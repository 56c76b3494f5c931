#include "workbench/session/surface_change.h"

#include <algorithm>
#include <iterator>
#include <span>
#include <unordered_set>
#include <vector>

#include "geometry/kernel/content_key.h"
#include "geometry/kernel/edges.h"
#include "geometry/kernel/measure.h"
#include "geometry/kernel/surface_distance.h"

namespace vesselbench {

namespace {

// In larger differences every n-th vertex is measured: the log must not cost more than the edit.
constexpr std::size_t kLargestSample = 50000;

struct Deviations {
    double sum = 0.0;
    double largest = 0.0;
    double count = 0.0;

    void add(double deviation, double weight = 1.0) {
        sum += weight * deviation;
        largest = std::max(largest, deviation);
        count += weight;
    }
};

struct PlaceHash {
    std::size_t operator()(const Vec3& p) const {
        const Vec3 place = p + Vec3::Zero();  // 0.0 and -0.0 are the same place
        return content_key(std::as_bytes(std::span(&place, 1))).low;
    }
};

Deviations deviations_in_place(const Positions& before, const Positions& after) {
    Deviations found;
    for (std::size_t v = 0; v < after.size(); ++v)
        if (before[v] != after[v]) found.add((after[v] - before[v]).norm());
    return found;
}

/// Distances of the vertices to another surface. Those coinciding with one of its vertices need no
/// search.
Deviations deviations_from(const Positions& points, const Surface& other,
                           const Progress& progress) {
    progress.check_cancelled();
    Positions away;
    if (points != other.points()) {
        const std::unordered_set<Vec3, PlaceHash> known(other.points().begin(),
                                                        other.points().end());
        std::ranges::copy_if(points, std::back_inserter(away),
                             [&](const Vec3& p) { return !known.contains(p); });
    }
    Deviations found;
    found.count = static_cast<double>(points.size() - away.size());
    if (away.empty()) return found;
    const std::size_t stride = (away.size() - 1) / kLargestSample + 1;
    const std::size_t all = away.size();
    Positions sample;
    for (std::size_t i = 0; i < all; i += stride) sample.push_back(away[i]);
    const double weight = static_cast<double>(all) / static_cast<double>(sample.size());
    progress.check_cancelled();
    const SurfaceDistance distance = distance_to(other);
    constexpr std::size_t kPiece = 2048;  // points far away take tens of microseconds each
    for (std::size_t i = 0; i < sample.size(); i += kPiece) {
        progress.check_cancelled();
        const std::size_t count = std::min(kPiece, sample.size() - i);
        for (const SurfacePoint& nearest :
             distance.closest_points(std::span(sample).subspan(i, count)))
            found.add(nearest.distance, weight);
    }
    return found;
}

void add_deviations(const Surface& before, const Surface& after, SurfaceChange& change,
                    const Progress& progress) {
    Deviations found;
    if (before.topology == after.topology) {
        found = deviations_in_place(before.points(), after.points());
        change.moved_vertices = static_cast<std::size_t>(found.count);
    } else {
        found = deviations_from(after.points(), before, progress.part(0.0, 0.5));
        progress.report(0.5, "measuring the change");
        const Deviations back = deviations_from(before.points(), after, progress.part(0.5, 1.0));
        found = {found.sum + back.sum, std::max(found.largest, back.largest),
                 found.count + back.count};
    }
    change.largest_deviation = found.largest;
    change.mean_deviation = found.count > 0.0 ? found.sum / found.count : 0.0;
}

template <class Values>
void add_differences(const Values& before, const Values& after, std::vector<VertexId>& changed) {
    for (std::size_t v = 0; v < after.size(); ++v)
        if (before[v] != after[v]) changed.push_back(static_cast<VertexId>(v));
}

using Values = std::shared_ptr<const std::vector<double>>;

Values attribute(const Surface& surface, const std::string& name) {
    const auto found = surface.attributes.find(name);
    return found == surface.attributes.end()
               ? std::make_shared<const std::vector<double>>(surface.vertex_count(), 0.0)
               : found->second;
}

}  // namespace

SurfaceChange surface_change(const Scene& before, const Scene& after, const Progress& progress) {
    progress.report(0.0, "measuring the change");
    SurfaceChange change;
    const bool had = before.surface && !before.surface->empty();
    const bool has = after.surface && !after.surface->empty();
    if (had) {
        change.triangles_before = before.surface->triangle_count();
        change.volume_before = volume(*before.surface);
    }
    if (!has) return change;
    change.triangles_after = after.surface->triangle_count();
    const bool same_shape = had && before.surface->positions == after.surface->positions &&
                            before.surface->topology == after.surface->topology;
    change.volume_after = same_shape ? change.volume_before : volume(*after.surface);
    // Triangles that run either way enclose no volume: any number would come out.
    const bool rebuilt = had && before.surface->topology != after.surface->topology;
    if (rebuilt && !manifold_defects(*before.surface->topology).inconsistent_edges.empty())
        change.volume_before.reset();
    if (had) add_deviations(*before.surface, *after.surface, change, progress);
    return change;
}

PointDeviation deviation_from(const Positions& points, const Surface& other,
                              const Progress& progress) {
    const Deviations found = deviations_from(points, other, progress);
    return {found.count > 0.0 ? found.sum / found.count : 0.0, found.largest};
}

std::optional<double> volume_change(const SurfaceChange& change) {
    if (!change.volume_before || !change.volume_after || !(*change.volume_before > 0.0))
        return std::nullopt;
    return *change.volume_after / *change.volume_before - 1.0;
}

std::vector<VertexId> changed_vertices(const Surface& before, const Surface& after) {
    std::vector<VertexId> changed;
    if (before.positions != after.positions)
        add_differences(before.points(), after.points(), changed);
    for (const auto& [name, values] : after.attributes) {
        const Values old = attribute(before, name);
        if (old != values) add_differences(*old, *values, changed);
    }
    return changed;
}

}  // namespace vesselbench
