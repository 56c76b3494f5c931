#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "geometry/kernel/surface.h"

namespace vesselbench {

/// A surface taken apart, so that triangles can be added and removed; labels and attributes go
/// along.
struct SurfaceParts {
    Positions positions;
    std::vector<Triangle> triangles;
    PatchLabels labels;
    std::vector<Patch> patches;
    std::map<std::string, std::vector<double>> attributes;

    /// Adds a vertex whose attributes are the weighted mean of others' (weights of sum 1).
    VertexId add_vertex(const Vec3& position, std::span<const VertexId> sources,
                        std::span<const double> weights);

    void add_triangle(const Triangle& triangle, std::uint16_t label) {
        triangles.push_back(triangle);
        labels.push_back(label);
    }

    /// Adds a patch; its label.
    std::uint16_t add_patch(Patch patch);
};

[[nodiscard]] SurfaceParts take_apart(const Surface& surface);

/// Puts the parts together without the triangles marked in `removed` (#T long, or empty), the
/// vertices that no triangle uses, and the patches that have no triangle left (the wall stays).
/// The order of what stays is kept.
/// \param new_ids if not null, receives each old vertex' new index (or kRemovedVertex)
[[nodiscard]] Surface put_together(const SurfaceParts& parts,
                                   const std::vector<std::uint8_t>& removed = {},
                                   std::vector<VertexId>* new_ids = nullptr);

inline constexpr VertexId kRemovedVertex = static_cast<VertexId>(-1);

/// Mean length of a closed polygon's edges [mm].
[[nodiscard]] double mean_edge(const Positions& positions, std::span<const VertexId> loop);

}  // namespace vesselbench
