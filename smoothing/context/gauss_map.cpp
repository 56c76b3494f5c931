#include "smoothing/context/gauss_map.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "geometry/kernel/parallel.h"

namespace vesselbench {

namespace {

constexpr double kBinsPerRadius = 3.0;
constexpr double kMostBins = 1024.0;  // per side of the cube: 0.09 degrees

int largest_component(const Vec3& axis) {
    int largest = 0;
    axis.cwiseAbs().maxCoeff(&largest);
    return largest;
}

/// Bin on three sides of a cube, with equal angles along each side.
std::uint32_t bin_of(const Vec3& axis, int bins) {
    const int side = largest_component(axis);
    const auto along = [&](int component) {
        const double angle = std::atan(axis[component] / axis[side]);  // -pi/4 ... pi/4
        const double share = angle * (2.0 / std::numbers::pi) + 0.5;
        return std::clamp(static_cast<int>(share * bins), 0, bins - 1);
    };
    return static_cast<std::uint32_t>((side * bins + along((side + 1) % 3)) * bins +
                                      along((side + 2) % 3));
}

}  // namespace

Vec3 folded_axis(const Vec3& axis) {
    return axis[largest_component(axis)] < 0.0 ? Vec3(-axis) : axis;
}

GaussMap::GaussMap(std::span<const Vec3> normals, double radius)
    : radius_(radius), cells_(static_cast<std::size_t>(2.0 / radius) + 4) {
    fill_bins(normals);
    fill_cells();
}

void GaussMap::fill_bins(std::span<const Vec3> normals) {
    const int bins = static_cast<int>(
        std::min(kMostBins, std::ceil(0.5 * std::numbers::pi * kBinsPerRadius / radius_)));
    std::vector<std::uint32_t> bin(normals.size());
    for_each_vertex(normals.size(), [&](std::size_t i) { bin[i] = bin_of(normals[i], bins); });
    constexpr auto kNone = static_cast<std::uint32_t>(-1);
    std::vector<std::uint32_t> occupied(static_cast<std::size_t>(3 * bins * bins), kNone);
    for (std::size_t i = 0; i < normals.size();
         ++i) {  // in order: the same sums for any number of threads
        std::uint32_t& at = occupied[bin[i]];
        if (at == kNone) {
            at = static_cast<std::uint32_t>(count_.size());
            count_.push_back(0);
            direction_.push_back(Vec3::Zero());
        }
        ++count_[at];
        direction_[at] += folded_axis(normals[i]);
    }
    for (Vec3& direction : direction_) direction.normalize();
}

void GaussMap::fill_cells() {
    const auto cell = [&](const Vec3& p) {
        return first_cell(cell_of(p.x()), cell_of(p.y()), cell_of(p.z()));
    };
    cell_start_.assign(cells_ * cells_ * cells_ + 1, 0);
    for (const Vec3& d : direction_) {
        ++cell_start_[cell(d) + 1];
        ++cell_start_[cell(-d) + 1];
    }
    for (std::size_t c = 1; c < cell_start_.size(); ++c) cell_start_[c] += cell_start_[c - 1];
    std::vector<std::uint32_t> next(cell_start_.begin(), cell_start_.end() - 1);
    entry_.resize(2 * direction_.size());
    for (std::uint32_t b = 0; b < direction_.size(); ++b)
        for (const float sign : {1.0F, -1.0F}) {
            const Vec3 d = static_cast<double>(sign) * direction_[b];
            entry_[next[cell(d)]++] = {d, b, sign};
        }
}

std::vector<std::uint64_t> GaussMap::densities() const {
    std::vector<std::uint64_t> density(size(), 0);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, size(), 64), [&](const auto& range) {
        for (std::size_t b = range.begin(); b != range.end(); ++b)
            visit_within(direction_[b],
                         [&](std::size_t other, float) { density[b] += count_[other]; });
    });
    return density;
}

}  // namespace vesselbench
