#include "geometry/image/wall_topology.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "geometry/image/voxels.h"
#include "geometry/kernel/simple_point.h"

namespace vesselbench {

namespace {

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
    [[nodiscard]] NeighbourBits around(std::size_t v) const {
        const auto [i, j, k] = index_of(image_, v);
        NeighbourBits bits = 0;
        for (int s = 0; s < 27; ++s)
            if (inside_[image_.offset(within(i + s % 3 - 1, 0), within(j + s / 3 % 3 - 1, 1),
                                      within(k + s / 9 - 1, 2))] != 0)
                bits |= NeighbourBits{1} << s;
        return bits;
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
            if (!may_change(band, b) || !is_simple_both_ways(sides.around(v))) {
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
