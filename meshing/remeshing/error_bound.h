#pragma once

#include <span>
#include <vector>

#include "geometry/kernel/surface.h"
#include "geometry/kernel/surface_distance.h"

namespace vesselbench {

/// Keeps a mesh within a distance of its source surface while its triangles are replaced in
/// small groups. Samples of the source (vertices, edge midpoints, inner points) belong to the
/// nearest triangle among those that replaced theirs, so that their true distance is at most the
/// one checked; points in the new triangles are checked against the source. Source: the
/// bookkeeping of Klein, Liebich & Strasser, "Mesh reduction with error control", Visualization
/// 1996.
class ErrorBound {
public:
    /// A triangle to be placed in the mesh.
    struct Fresh {
        TriangleId triangle = 0;
        Vec3 a, b, c;  ///< corners [mm]
    };

    /// \param weights fraction of `max_error` permitted at each vertex, in [0, 1]; empty: 1
    ErrorBound(const Surface& source, std::span<const double> weights, double max_error);

    /// True if the fresh triangles may replace the gone ones, which `fresh` may include; stores the
    /// new triangles of the samples.
    [[nodiscard]] bool allows(std::span<const TriangleId> gone, std::span<const Fresh> fresh);

    /// Replaces the triangles that were permitted last.
    void accept(std::span<const TriangleId> gone, std::span<const Fresh> fresh);

private:
    struct Sample {
        Vec3 place = Vec3::Zero();  ///< [mm]
        double allowed = 0.0;       ///< [mm]
    };

    void add_inner_samples(TriangleId t);
    void add_sample(const Vec3& place, double weight, TriangleId triangle);
    [[nodiscard]] double allowed_at(const SurfacePoint& at) const;
    [[nodiscard]] bool is_near_source(const Fresh& triangle) const;

    Positions points_;  ///< the source's
    std::vector<Triangle> triangles_;
    std::vector<double> weights_;
    double max_error_ = 0.0;
    /// Spacing of samples in triangles, except giant ones (sample_parts): half of the source's mean
    /// edge [mm]
    double spacing_ = 0.0;
    SurfaceDistance search_;
    std::vector<Sample> samples_;
    std::vector<std::vector<std::uint32_t>> samples_of_;          ///< by triangle
    std::vector<std::pair<std::uint32_t, std::uint32_t>> moves_;  ///< sample, place in `fresh`
};

}  // namespace vesselbench
