#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/kernel/surface.h"
#include "smoothing/context/flat_areas.h"

namespace vesselbench {

/// Distinguishes caps from other flat areas by the surface beyond their border. One object checks
/// many areas in turn and reuses its arrays.
class CapBorder {
public:
    explicit CapBorder(const Surface& surface)
        : surface_(surface),
          depth_(surface.vertex_count(), 0.0),
          corners_(surface.vertex_count()) {}

    /// Thesis Algorithm 1, and the conditions stated at find_caps().
    /// \param normal unit mean normal of the area
    [[nodiscard]] bool encloses_cap(std::span<const TriangleId> area, const Vec3& normal);

private:
    struct Area {
        std::uint32_t number;
        Vec3 normal;
        std::vector<VertexId> border;  ///< vertices of the area with surface beyond
    };

    /// How many corners of an area's triangles are at a vertex.
    struct Corners {
        std::uint32_t area = 0;  ///< the last area that has triangles at the vertex
        std::uint32_t count = 0;
    };

    void count_corners(const Area& area, std::span<const TriangleId> triangles);

    [[nodiscard]] bool touches(const Area& area, VertexId v) const {
        return corners_[v].area == area.number;
    }

    [[nodiscard]] int side_beyond(const Area& area, VertexId v) const;
    [[nodiscard]] int common_side(Area& area) const;
    [[nodiscard]] double inner_radius(const Area& area);
    [[nodiscard]] bool drops(const Area& area, VertexId start, int side, double radius) const;

    const Surface& surface_;
    std::uint32_t last_area_ = 0;
    std::vector<double> depth_;       ///< #V, all 0 between two areas
    std::vector<Corners> corners_;    ///< #V
    std::vector<VertexId> vertices_;  ///< of the area, by their first triangles
};

}  // namespace vesselbench
