#pragma once

#include <vector>

#include "geometry/kernel/surface.h"

namespace vesselbench {

/// Mean length of the edges at every vertex [mm], #V.
[[nodiscard]] std::vector<double> vertex_edge_lengths(const Surface& surface);

/// Target edge length in the lumen [mm] on a regular grid around a surface. At the surface it is
/// the surface's own edge length; inwards it grows by at most `growth` per unit of distance, and
/// from a depth of two edges on it is scaled by `factor`, which leaves room for the transition.
class SizeField {
public:
    /// \param growth largest growth of the edge length per distance [-], >= 0
    SizeField(const Surface& surface, double growth);

    /// Target edge length at a point [mm], trilinear; beyond the grid that of the nearest point.
    /// Linear in the factor.
    [[nodiscard]] double at(const Vec3& place, double factor) const;

private:
    struct Node {
        float size;      ///< smallest of (edge length + growth * distance) over all vertices [mm]
        float distance;  ///< to the surface's vertices [mm], along the grid
    };

    [[nodiscard]] static double size_of(const Node& node, double factor);

    [[nodiscard]] std::size_t index(int i, int j, int k) const {
        return (static_cast<std::size_t>(k) * count_[1] + j) * count_[0] + i;
    }

    void seed(const Surface& surface);
    void sweep(double growth);

    Vec3 origin_ = Vec3::Zero();
    double spacing_ = 1.0;
    std::array<int, 3> count_ = {1, 1, 1};
    std::vector<Node> nodes_;
};

}  // namespace vesselbench
