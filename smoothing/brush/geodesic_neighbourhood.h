#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/kernel/topology.h"
#include "geometry/kernel/vec3.h"

namespace vesselbench {

/// A vertex near a place, and its distance along the surface.
struct GeodesicNeighbour {
    VertexId vertex = 0;
    double distance = 0.0;  ///< along the surface [mm]

    bool operator==(const GeodesicNeighbour&) const = default;
};

/// Finds the vertices around a place of a surface by their distance along the surface, so that a
/// vessel passing close by is far away. Built once for a topology and queried often: the cost of a
/// query depends on the vertices it visits, not on the size of the surface. Not thread-safe.
/// Distances spread triangle by triangle from the two nearer corners, which are unfolded into the
/// plane with the place as virtual source: accurate to 1e-5 on a plane, obtuse triangles included.
/// Source: Melvaer, Reimers, "Geodesic polar coordinates on polygonal meshes", Computer Graphics
/// Forum 31(8), 2012; the update of Reimers, "Topics in mesh based modelling", 2004.
class GeodesicNeighbourhood {
public:
    /// Keeps a reference to the topology.
    explicit GeodesicNeighbourhood(const Topology& topology);

    /// The vertices at most `radius` [mm] away from `point` on `triangle`, ascending; none if the
    /// triangles are larger than that. Valid until the next call. Parts with positions that are not
    /// finite are ignored.
    /// \param positions [mm], #V
    /// \throw InvalidInput if the triangle does not exist, the positions are not #V long, the point
    /// is not finite, or the radius is not positive and finite
    std::span<const GeodesicNeighbour> within(const Positions& positions, TriangleId triangle,
                                              const Vec3& point, double radius);

private:
    struct Waiting {
        double distance;
        VertexId vertex;

        /// Nearest first; equal distances by vertex.
        bool operator<(const Waiting& other) const {
            return distance != other.distance ? distance > other.distance : vertex > other.vertex;
        }
    };

    void begin();
    [[nodiscard]] double distance_of(VertexId v) const;
    void lower(VertexId v, double distance);
    void spread(const Positions& positions, VertexId v);

    const Topology& topology_;
    std::vector<double> distance_;      ///< #V, valid where stamp_ is now_
    std::vector<std::uint32_t> stamp_;  ///< #V, number of the last search that visited the vertex
    std::uint32_t now_ = 0;
    double longest_ = 0.0;  ///< edge met so far [mm]
    std::vector<Waiting> heap_;
    std::vector<VertexId> met_;
    std::vector<GeodesicNeighbour> found_;
};

}  // namespace vesselbench
