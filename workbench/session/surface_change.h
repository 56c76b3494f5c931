#pragma once

#include <optional>
#include <vector>

#include "geometry/kernel/progress.h"
#include "workbench/case/edit_record.h"
#include "workbench/case/scene.h"

namespace vesselbench {

/// The effect of an edit on the scene's surface. If the connectivity was kept, deviations are
/// measured from each vertex to its old place, with their mean over the vertices that moved. Else
/// they are measured from the vertices of either surface to the other surface, with their mean over
/// all vertices of both; of more than 50,000 that coincide with no vertex of the other, every n-th
/// is measured. The volume before is unknown if its triangles do not all run the same way round and
/// others replace them.
/// \throw Cancelled
[[nodiscard]] SurfaceChange surface_change(const Scene& before, const Scene& after,
                                           const Progress& progress = {});

/// How far points are from a surface.
struct PointDeviation {
    double mean = 0.0, largest = 0.0;  ///< [mm]; 0 if there are no points
};

/// Of more than 50,000 points that coincide with no vertex of the surface, every n-th is measured.
/// \throw Cancelled
[[nodiscard]] PointDeviation deviation_from(const Positions& points, const Surface& other,
                                            const Progress& progress = {});

/// Change of the volume, relative to that before [-]; none: one is unknown, or was 0.
[[nodiscard]] std::optional<double> volume_change(const SurfaceChange& change);

/// Vertices that differ in place or in an attribute that only one surface has or both share;
/// ascending. \param after of the same connectivity as `before`
[[nodiscard]] std::vector<VertexId> changed_vertices(const Surface& before, const Surface& after);

}  // namespace vesselbench
