#include "smoothing/context/point_grid.h"

#include <Eigen/Geometry>

namespace vesselbench {

namespace {

constexpr double kMostCells = 1024.0;  // along an axis
constexpr double kCrowd = 32.0;        // points in the cell of the average point

/// Points lie on a surface, so n cells in space leave n^(1/3) points per occupied cell: more cells
/// keep these few, and cost memory.
double cells_for(std::size_t points) {
    const auto count = static_cast<double>(points);
    return count * std::clamp(std::sqrt(count) / 100.0, 1.0, 8.0) + 64.0;
}

}  // namespace

std::optional<CellLayout> cell_layout(const Vec3& extent, std::size_t points) {
    const double most = cells_for(points);
    const double longest = extent.maxCoeff();
    double length = longest > 1e-300 ? longest / kMostCells : 1.0;  // no zero by underflow
    const auto cells = [&](int axis) { return std::floor(extent[axis] / length) + 1.0; };
    while (cells(0) * cells(1) * cells(2) > most) length *= 1.1;
    CellLayout layout{.per_length = 1.0 / length};
    if (!std::isfinite(longest) || !std::isfinite(layout.per_length)) return std::nullopt;
    for (int axis = 0; axis < 3; ++axis) layout.size[axis] = static_cast<int>(cells(axis));
    return layout;
}

PointGrid::PointGrid(const Positions& positions, std::span<const VertexId> chosen) {
    Eigen::AlignedBox3d box;
    for (const VertexId v : chosen) box.extend(positions[v]);
    if (chosen.empty()) return;
    origin_ = box.min();
    const auto layout = cell_layout(box.sizes(), chosen.size());
    crowded_ = !layout;
    if (crowded_) return;
    cells_ = *layout;
    offsets_.assign(cells_.count() + 1, 0);
    std::vector<std::uint32_t> cells(chosen.size());
    for (std::size_t i = 0; i < chosen.size(); ++i) {
        const Vec3 at = (positions[chosen[i]] - origin_) * cells_.per_length;
        cells[i] = static_cast<std::uint32_t>((cell(at.z(), 2) * cells_.size[1] + cell(at.y(), 1)) *
                                                  cells_.size[0] +
                                              cell(at.x(), 0));
        ++offsets_[cells[i]];
    }
    double neighbours = 0.0;
    std::uint32_t total = 0;
    for (std::uint32_t& offset : offsets_) {
        neighbours += static_cast<double>(offset) * offset;
        total += offset;
        offset = total;
    }
    crowded_ = neighbours > kCrowd * static_cast<double>(chosen.size());
    points_.resize(chosen.size());
    vertices_.resize(chosen.size());
    for (std::size_t i = chosen.size(); i-- > 0;) {
        const std::uint32_t place = --offsets_[cells[i]];
        points_[place] = positions[chosen[i]];
        vertices_[place] = chosen[i];
    }
}

}  // namespace vesselbench
