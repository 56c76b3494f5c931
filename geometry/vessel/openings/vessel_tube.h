#pragma once

#include <vector>

#include "geometry/kernel/vec3.h"
#include "geometry/vessel/centerlines/centerline_graph.h"

namespace vesselbench {

/// Coordinates of a point relative to a tube.
struct TubeCoordinates {
    double along = 0.0;   ///< arc length of the nearest point of the line [mm]
    double angle = 0.0;   ///< around the line, from the frame's first axis [rad], (-pi, pi]
    double height = 0.0;  ///< distance from the tube's wall [mm], negative inside
    double radius = 0.0;  ///< of the tube at this point [mm]
};

/// A line with radii and a frame with minimal rotation along it.
class VesselTube {
public:
    /// \param points at least 2, consecutive ones different [mm]
    /// \param first_axis direction in which the angle is 0 at the start; made perpendicular
    VesselTube(Positions points, std::vector<double> radii, const Vec3& first_axis);

    [[nodiscard]] TubeCoordinates coordinates(const Vec3& x) const;
    [[nodiscard]] Vec3 position(double along, double angle, double height) const;

    [[nodiscard]] double length() const { return along_.back(); }

    [[nodiscard]] double radius(double along) const;

    /// The same line, with angle 0 pointing to x.
    [[nodiscard]] VesselTube turned_to(const Vec3& x) const;

    [[nodiscard]] const Positions& points() const { return points_; }

private:
    struct Place {
        std::size_t segment = 0;
        double t = 0.0;
    };

    Place nearest(const Vec3& x) const;
    Place at(double along) const;
    Vec3 axis(const Place& place) const;
    Vec3 tangent(const Place& place) const;

    Positions points_;
    std::vector<double> radii_;
    std::vector<double> along_;
    Positions tangents_;  ///< at each point
    Positions axes_;      ///< first axis of the frame at each point
};

/// A branch to be removed and its parent vessels.
struct BranchRoot {
    std::size_t branch = 0;
    std::size_t node = 0;             ///< the furcation
    Vec3 mouth = Vec3::Zero();        ///< where the branch's line leaves the parent [mm]
    double branch_radius = 0.0;       ///< of the branch just behind its mouth [mm]
    double parent_radius = 0.0;       ///< of the parent at the mouth [mm]
    std::vector<VesselTube> parents;  ///< one for each pair of the other vessels at the furcation:
                                      ///< line and radius continue smoothly, as if the branch had
                                      ///< never existed
    std::vector<VesselTube> others;   ///< the vessels elsewhere
    VesselTube own;                   ///< the branch from its mouth on
};

/// \param tip node of the graph with one branch
/// \throw AlgorithmFailure if the branch has no furcation, or fewer than two others meet there
[[nodiscard]] BranchRoot branch_root(const CenterlineGraph& graph, std::size_t tip);

}  // namespace vesselbench
