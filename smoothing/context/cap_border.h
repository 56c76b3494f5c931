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
          seen_(surface.vertex_count(), 0) {}

    /// Thesis Algorithm 1, and the conditions stated at find_caps().
    /// \param area triangles, all of which have the number `areas[area.front()]`
    /// \param normal unit mean normal of the area
    [[nodiscard]] bool encloses_cap(const AreaNumbers& areas, std::span<const TriangleId> area,
                                    const Vec3& normal);

private:
    struct Area {
        const AreaNumbers& numbers;
        std::uint32_t number;
        Vec3 normal;
        std::vector<VertexId> border;  ///< vertices of the area with surface beyond
    };

    [[nodiscard]] bool touches(const Area& area, VertexId v) const;
    [[nodiscard]] bool goes_on(const Area& area, VertexId v) const;
    [[nodiscard]] int side_beyond(const Area& area, VertexId v) const;
    [[nodiscard]] int common_side(Area& area, std::span<const TriangleId> triangles);
    [[nodiscard]] double inner_radius(const Area& area);
    [[nodiscard]] bool drops(const Area& area, VertexId start, int side, double radius) const;

    const Surface& surface_;
    std::vector<double> depth_;        ///< #V, all 0 between two areas
    std::vector<std::uint32_t> seen_;  ///< #V: the last area that visited the vertex
};

}  // namespace vesselbench
