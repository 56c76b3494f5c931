#include "geometry/image/wall_topology.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "geometry/image/simple_voxel.h"

namespace vesselbench {

namespace {

/// All voxels around it on its own side belong to the outline as well.
bool is_thin(const VoxelBand& band, std::size_t b) {
    return std::ranges::none_of(band.neighbours[b], [&](std::int32_t place) {
        const auto n = static_cast<std::size_t>(place);
        return place >= 0 && band.inside[n] == band.inside[b] && band.layer[n] > 1;
    });
}

bool may_change(const VoxelBand& band, std::size_t b) {
    return band.layer[b] == 1 && (band.inside[b] == 0 || !is_thin(band, b));
}

class Sides {
public:
    explicit Sides(const Image& before) : image_(before), inside_(before.voxel_count()) {
        for (std::size_t v = 0; v < inside_.size(); ++v) inside_[v] = (*before.voxels)[v] > 0.0f;
    }

    [[nodiscard]] bool is_inside(std::size_t v) const { return inside_[v] != 0; }

    void change(std::size_t v) { inside_[v] = inside_[v] == 0; }

    /// Beyond the image as at its border: a vessel that leaves it goes on.
    [[nodiscard]] VoxelSurroundings around(std::size_t v) const {
        const auto n = static_cast<std::size_t>(image_.size[0]),
                   m = static_cast<std::size_t>(image_.size[1]);
        const int i = static_cast<int>(v % n), j = static_cast<int>(v / n % m),
                  k = static_cast<int>(v / n / m);
        VoxelSurroundings result{};
        for (int s = 0; s < 27; ++s)
            result[static_cast<std::size_t>(s)] =
                inside_[image_.offset(within(i + s % 3 - 1, 0), within(j + s / 3 % 3 - 1, 1),
                                      within(k + s / 9 - 1, 2))] != 0;
        return result;
    }

private:
    [[nodiscard]] int within(int index, std::size_t axis) const {
        return std::clamp(index, 0, image_.size[axis] - 1);
    }

    const Image& image_;
    std::vector<char> inside_;
};

}  // namespace

void keep_topology(const Image& before, const VoxelBand& band, std::vector<float>& values) {
    Sides sides(before);
    std::vector<std::size_t> changing;
    for (std::size_t b = 0; b < band.size(); ++b)
        if (sides.is_inside(band.voxels[b]) != (values[band.voxels[b]] > 0.0f))
            changing.push_back(b);
    for (bool changed = true; changed;) {
        changed = false;
        std::vector<std::size_t> left;
        for (const std::size_t b : changing) {
            const std::size_t v = band.voxels[b];
            if (!may_change(band, b) || !is_simple(sides.around(v))) {
                left.push_back(b);
                continue;
            }
            sides.change(v);
            changed = true;
        }
        changing.swap(left);
    }
    const auto least = static_cast<float>(1e-3 * before.spacing().minCoeff());
    for (const std::size_t b : changing)
        values[band.voxels[b]] = sides.is_inside(band.voxels[b]) ? least : -least;
}

}  // namespace vesselbench
