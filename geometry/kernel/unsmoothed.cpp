#include "geometry/kernel/unsmoothed.h"

#include <array>
#include <utility>

#include "geometry/kernel/errors.h"

namespace vesselbench {

namespace {

constexpr std::array kNames = {"unsmoothed_x", "unsmoothed_y", "unsmoothed_z"};

bool has_unsmoothed(const Surface& surface) {
    for (const char* name : kNames)
        if (!surface.attributes.contains(name)) return false;
    return true;
}

}  // namespace

Surface with_unsmoothed(Surface smoothed, const Positions& before) {
    if (before.size() != smoothed.vertex_count())
        throw InvalidInput("the places before smoothing are not those of the surface's vertices");
    if (has_unsmoothed(smoothed)) return smoothed;
    for (std::size_t k = 0; k < kNames.size(); ++k) {
        std::vector<double> values;
        values.reserve(before.size());
        for (const Vec3& p : before) values.push_back(p[static_cast<Eigen::Index>(k)]);
        smoothed.attributes[kNames[k]] =
            std::make_shared<const std::vector<double>>(std::move(values));
    }
    return smoothed;
}

Positions unsmoothed(const Surface& surface) {
    if (!has_unsmoothed(surface)) return surface.points();
    Positions before(surface.vertex_count());
    for (std::size_t k = 0; k < kNames.size(); ++k) {
        const std::vector<double>& values = *surface.attributes.at(kNames[k]);
        for (std::size_t v = 0; v < before.size(); ++v)
            before[v][static_cast<Eigen::Index>(k)] = values[v];
    }
    return before;
}

Surface without_unsmoothed(Surface surface) {
    for (const char* name : kNames) surface.attributes.erase(name);
    return surface;
}

}  // namespace vesselbench
