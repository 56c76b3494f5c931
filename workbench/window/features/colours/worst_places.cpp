#include "workbench/window/features/colours/worst_places.h"

#include <algorithm>
#include <cmath>

#include "geometry/kernel/measure.h"

namespace vesselbench {

namespace {

constexpr std::size_t kMostPlaces = 10;
constexpr double kApart = 0.02;  ///< of two places, by the model's diagonal [-]

/// The larger, the worse; not-a-number if there is no value.
double badness(double value, WorstEnd end) {
    if (end == WorstEnd::Least) return -value;
    return end == WorstEnd::Largest ? value : std::abs(value);
}

Positions centroids(const VolumeMesh& mesh) {
    Positions points;
    for (const Tetrahedron& t : mesh.tetrahedra)
        points.push_back(
            0.25 * (mesh.points[t[0]] + mesh.points[t[1]] + mesh.points[t[2]] + mesh.points[t[3]]));
    for (const Prism& prism : mesh.prisms) {
        points.emplace_back(Vec3::Zero());
        for (const VertexId v : prism) points.back() += mesh.points[v] / 6.0;
    }
    return points;
}

/// The surface's normal at a vertex; zero if it has none.
Vec3 outward_at(const Surface& surface, std::size_t vertex) {
    Vec3 sum = Vec3::Zero();
    for (const TriangleId t : surface.topology->triangles_at().row(vertex))
        sum += area_normal(surface.points(), surface.triangles()[t]);
    return sum.norm() > 0.0 ? Vec3(sum.normalized()) : Vec3(Vec3::Zero());
}

}  // namespace

std::vector<WorstPlace> worst_places(std::span<const Vec3> points, std::span<const double> values,
                                     WorstEnd end, double apart, std::size_t most) {
    std::vector<WorstPlace> places;
    std::vector<std::size_t> left;
    for (std::size_t i = 0; i < points.size(); ++i)
        if (std::isfinite(values[i])) left.push_back(i);
    while (places.size() < most && !left.empty()) {
        const std::size_t worst = *std::ranges::max_element(
            left, {}, [&](std::size_t i) { return badness(values[i], end); });
        places.push_back({.place = points[worst], .value = values[worst], .index = worst});
        std::erase_if(left, [&](std::size_t i) {
            return (points[i] - points[worst]).squaredNorm() <= apart * apart;
        });
    }
    return places;
}

/// What is coloured: vertices, or the centroids of cells.
struct WorstTour::Coloured {
    const Scene* scene = nullptr;      ///< of a document; null: the surface is live
    const Surface* surface = nullptr;  ///< null: there is none
    const std::vector<double>* values = nullptr;
    const std::vector<double>* sharpness = nullptr;  ///< null: ranked by the values
    int scene_number = 0;
};

/// \return none: there are no colours now
std::optional<WorstTour::Coloured> WorstTour::coloured(const Seen& seen) {
    const Scene* scene = seen.document.shown();
    if (scene == nullptr) return std::nullopt;
    Coloured now{.scene = scene,
                 .surface = scene->surface ? &*scene->surface : nullptr,
                 .scene_number = seen.document.scene_changes()};
    const ColourValues* colours = seen.data.colours().get();
    const DeviationMap* deviation = seen.document.deviation().get();
    if (seen.live) {
        now.scene = nullptr;
        now.surface = &seen.live->state.surface;
        colours = seen.live->colours.get();
        deviation = seen.live->deviation.get();
    }
    if (seen.kind == ColouringKind::Deviation && deviation != nullptr)
        now.values = &deviation->values;
    if (seen.kind != ColouringKind::Deviation && colours != nullptr && colours->kind == seen.kind) {
        now.values = &colours->values;
        if (!colours->sharpness.empty()) now.sharpness = &colours->sharpness;
    }
    if (now.values == nullptr) return std::nullopt;
    return now;
}

bool WorstTour::is_of(const Seen& seen, const Coloured& now) const {
    const bool same_live = !of_live_.owner_before(seen.live) && !seen.live.owner_before(of_live_);
    return same_live && of_ == std::pair<const void*, int>(now.values, now.scene_number);
}

void WorstTour::find(const Coloured& now, ColouringKind kind) {
    const bool cells = kind == ColouringKind::TetrahedraQuality;
    Positions points;
    if (cells && now.scene != nullptr && now.scene->volume_mesh)
        points = centroids(*now.scene->volume_mesh);
    else if (!cells && now.surface != nullptr)
        points = now.surface->points();
    const std::vector<double>& ranks = now.sharpness != nullptr ? *now.sharpness : *now.values;
    places_.clear();
    at_ = 0;
    if (points.size() != ranks.size() || points.size() != now.values->size()) return;
    const WorstEnd end = now.sharpness != nullptr ? WorstEnd::Largest : colouring_info(kind).worst;
    places_ = worst_places(points, ranks, end, kApart * bounds(points).diagonal(), kMostPlaces);
    for (WorstPlace& place : places_) {
        place.value = (*now.values)[place.index];
        if (now.sharpness != nullptr) place.sharpness = ranks[place.index];
        if (!cells) place.outward = outward_at(*now.surface, place.index);
    }
}

std::optional<WorstPlace> WorstTour::go(const Seen& seen, int steps) {
    const std::optional<Coloured> now = coloured(seen);
    if (!now) return std::nullopt;
    if (!is_of(seen, *now)) {
        of_ = {now->values, now->scene_number};
        of_live_ = seen.live;
        find(*now, seen.kind);
    } else if (!places_.empty()) {
        const auto count = static_cast<int>(places_.size());
        at_ = static_cast<std::size_t>((static_cast<int>(at_) + steps % count + count) % count);
    }
    if (places_.empty()) return std::nullopt;
    return places_[at_];
}

std::string WorstTour::position() const {
    return std::to_string(at_ + 1) + " of " + std::to_string(places_.size());
}

}  // namespace vesselbench
