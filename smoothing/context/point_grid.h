#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "geometry/kernel/topology.h"
#include "geometry/kernel/vec3.h"
#include "smoothing/context/point_tree.h"

namespace vesselbench {

/// Equal cells over a box.
struct CellLayout {
    double per_length = 1.0;              ///< cells per length [1/mm]
    std::array<int, 3> size = {1, 1, 1};  ///< cells along each axis

    [[nodiscard]] std::size_t count() const {
        return static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1]) *
               static_cast<std::size_t>(size[2]);
    }
};

/// Cells for some points of a surface in a box of this size [mm], with few points per cell.
/// \return none if the box is too large for cell numbers
[[nodiscard]] std::optional<CellLayout> cell_layout(const Vec3& extent, std::size_t points);

/// Some vertices of a surface in equal cells, searched like a PointTree: several times faster,
/// unless most vertices crowd in few cells. If two are equally near, either is found.
class PointGrid {
public:
    using Found = PointTree::Found;

    /// \param chosen at finite positions
    PointGrid(const Positions& positions, std::span<const VertexId> chosen);

    /// True if cells are so crowded that a PointTree should be used; a crowded grid must not be
    /// searched.
    [[nodiscard]] bool crowded() const { return crowded_; }

    /// The vertex nearest to p if it is closer than the known one; else the known one.
    [[nodiscard]] Found nearest(const Vec3& p, Found known) const {
        visit_rows(p, known.squared, [&](std::uint32_t i) {
            const double d = (p - points_[i]).squaredNorm();
            if (d < known.squared) known = {vertices_[i], d};
        });
        return known;
    }

    /// Calls visit(Found) for every vertex closer to p than the square root of `squared`.
    template <class Visit>
    void visit_nearer(const Vec3& p, double squared, const Visit& visit) const {
        visit_rows(p, squared, [&](std::uint32_t i) {
            const double d = (p - points_[i]).squaredNorm();
            if (d < squared) visit(Found{vertices_[i], d});
        });
    }

private:
    /// The cells within the distance along one axis.
    struct Span {
        double at;        ///< coordinate of the query point
        int first, last;  ///< cells within the distance

        /// Lower bound of the distance from the point to the cell.
        [[nodiscard]] double gap(int cell) const {
            const double apart = std::max(cell - at, at - (cell + 1));
            return std::max(0.0, apart - 1e-9 * (1.0 + std::abs(at)));  // rounding
        }
    };

    [[nodiscard]] int cell(double at, int axis) const {
        return static_cast<int>(std::clamp(at, 0.0, cells_.size[axis] - 1.0));
    }

    [[nodiscard]] Span span(const Vec3& p, double distance, int axis) const {
        const double from = p[axis] - origin_[axis];
        return {from * cells_.per_length,
                cell((p[axis] - distance - origin_[axis]) * cells_.per_length, axis),
                cell((p[axis] + distance - origin_[axis]) * cells_.per_length, axis)};
    }

    /// Calls visit(place) at least for all vertices closer to p than the square root of `squared`,
    /// which visit() may reduce.
    template <class Visit>
    void visit_rows(const Vec3& p, const double& squared, const Visit& visit) const {
        const double distance = std::sqrt(squared) * (1.0 + 1e-9);  // rounding
        const Span xs = span(p, distance, 0), ys = span(p, distance, 1), zs = span(p, distance, 2);
        const double scale = cells_.per_length * cells_.per_length * (1.0 + 1e-9);
        for (int z = zs.first; z <= zs.last; ++z) {
            const double dz = zs.gap(z);
            for (int y = ys.first; y <= ys.last; ++y) {
                const double dy = ys.gap(y);
                if (dy * dy + dz * dz > squared * scale) continue;
                const std::size_t row =
                    (static_cast<std::size_t>(z) * cells_.size[1] + y) * cells_.size[0];
                const std::uint32_t end = offsets_[row + xs.last + 1];
                for (std::uint32_t i = offsets_[row + xs.first]; i < end; ++i) visit(i);
            }
        }
    }

    Vec3 origin_ = Vec3::Zero();
    CellLayout cells_;
    bool crowded_ = false;
    std::vector<std::uint32_t> offsets_;  ///< of the cells, x fastest; #cells + 1
    std::vector<Vec3> points_;            ///< by cell
    std::vector<VertexId> vertices_;      ///< the same
};

}  // namespace vesselbench
