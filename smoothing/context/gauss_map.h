#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/kernel/vec3.h"

namespace vesselbench {

/// Unit face normals as axes (n and -n are one) on a hemisphere, collected in bins a third as wide
/// as the counting radius: linear in the number of normals.
class GaussMap {
public:
    /// \param normals unit vectors, the sign does not matter
    /// \param radius of the density, a chord of the unit sphere [-], in (0, 0.5]
    GaussMap(std::span<const Vec3> normals, double radius);

    [[nodiscard]] std::size_t size() const { return count_.size(); }

    /// Number of normals in an occupied bin.
    [[nodiscard]] std::uint32_t count(std::size_t bin) const { return count_[bin]; }

    /// Mean direction of the normals in a bin.
    [[nodiscard]] const Vec3& direction(std::size_t bin) const { return direction_[bin]; }

    /// Number of normals within the radius of every bin's mean direction.
    [[nodiscard]] std::vector<std::uint64_t> densities() const;

    /// Calls visit(bin, sign) for every bin whose direction times sign is within the radius of q.
    template <class Visit>
    void visit_within(const Vec3& q, const Visit& visit) const {
        const int x = cell_of(q.x()), y = cell_of(q.y()), z = cell_of(q.z());
        for (int k = z - 1; k <= z + 1; ++k)
            for (int j = y - 1; j <= y + 1; ++j) {
                const std::size_t row = first_cell(x - 1, j, k);
                for (std::uint32_t e = cell_start_[row]; e < cell_start_[row + 3]; ++e)
                    if ((entry_[e].direction - q).squaredNorm() <= radius_ * radius_)
                        visit(static_cast<std::size_t>(entry_[e].bin), entry_[e].sign);
            }
    }

private:
    struct Entry {
        Vec3 direction;
        std::uint32_t bin;
        float sign;
    };

    [[nodiscard]] int cell_of(double coordinate) const {
        return static_cast<int>((coordinate + 1.0) / radius_) + 1;  // a border of empty cells
    }

    [[nodiscard]] std::size_t first_cell(int x, int y, int z) const {
        return (static_cast<std::size_t>(z) * cells_ + static_cast<std::size_t>(y)) * cells_ +
               static_cast<std::size_t>(x);
    }

    void fill_bins(std::span<const Vec3> normals);
    void fill_cells();

    double radius_;
    std::size_t cells_;                 ///< along each axis
    std::vector<std::uint32_t> count_;  ///< of the occupied bins
    std::vector<Vec3> direction_;       ///< of the occupied bins
    std::vector<std::uint32_t> cell_start_;
    std::vector<Entry> entry_;  ///< every bin twice, once per sign, by cell
};

/// The same axis with its largest component positive; of equal ones the first.
[[nodiscard]] Vec3 folded_axis(const Vec3& axis);

}  // namespace vesselbench
