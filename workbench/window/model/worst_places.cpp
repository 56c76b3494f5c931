#include "workbench/window/model/worst_places.h"

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

/// What is coloured: vertices, or the centroids of tetrahedra.
struct Coloured {
    Positions points;
    const std::vector<double>* values = nullptr;
};

Positions centroids(const VolumeMesh& mesh) {
    Positions points;
    for (const Tetrahedron& t : mesh.tetrahedra)
        points.push_back(
            0.25 * (mesh.points[t[0]] + mesh.points[t[1]] + mesh.points[t[2]] + mesh.points[t[3]]));
    return points;
}

const std::vector<double>* shown_values(const Document& document, const ViewData& data,
                                        ColouringKind kind) {
    if (kind == ColouringKind::Deviation)
        return document.deviation() ? &document.deviation()->values : nullptr;
    return data.colours() && data.colours()->kind == kind ? &data.colours()->values : nullptr;
}

Coloured coloured(const Scene& scene, ColouringKind kind, const std::vector<double>& values) {
    Coloured found;
    if (kind == ColouringKind::TetrahedraQuality)
        found.points = scene.volume_mesh ? centroids(*scene.volume_mesh) : Positions();
    else if (scene.surface)
        found.points = scene.surface->points();
    if (found.points.size() == values.size()) found.values = &values;
    return found;
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
        places.push_back({points[worst], values[worst]});
        std::erase_if(left, [&](std::size_t i) {
            return (points[i] - points[worst]).squaredNorm() <= apart * apart;
        });
    }
    return places;
}

std::optional<WorstPlace> WorstTour::go(const Document& document, const ViewData& data,
                                        ColouringKind kind, int steps) {
    const Scene* scene = document.shown();
    const std::vector<double>* values = shown_values(document, data, kind);
    if (scene == nullptr || values == nullptr) return std::nullopt;
    const std::pair<const void*, int> now(values, document.scene_changes());
    if (of_ != now) {
        const Coloured of = coloured(*scene, kind, *values);
        if (of.values == nullptr) return std::nullopt;
        of_ = now;
        at_ = 0;
        places_ = worst_places(of.points, *values, colouring_info(kind).worst,
                               kApart * bounds(of.points).diagonal(), kMostPlaces);
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
