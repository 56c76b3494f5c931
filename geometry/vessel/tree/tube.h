#pragma once

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "geometry/kernel/vec3.h"

namespace vesselbench {

/// A place on a tube's axis.
struct AxisPlace {
    std::size_t segment = 0;  ///< from the axis' point of this number to the next one
    double t = 0.0;           ///< along the segment [-]
};

/// Coordinates of a point relative to a tube.
struct TubeCoordinates {
    double along = 0.0;   ///< arc length of the nearest point of the axis [mm]
    double angle = 0.0;   ///< around the axis, from the frame's first direction [rad], (-pi, pi]
    double height = 0.0;  ///< distance from the tube's wall [mm], negative inside
    double radius = 0.0;  ///< of the tube at this point [mm]
};

/// A vessel as a tube: an axis with radii and a frame with minimal rotation along it.
class Tube {
public:
    Tube() =
        default;  ///< without an axis; only points(), radii(), along() and length() may be asked

    /// \param points of the axis, at least 2, consecutive ones different [mm]
    /// \param radii [mm], #points; empty: no radius or height may be asked
    /// \param first where the angle is 0 at the start, made perpendicular; none: any direction
    Tube(Positions points, std::vector<double> radii, const std::optional<Vec3>& first = {});

    [[nodiscard]] const Positions& points() const { return points_; }

    [[nodiscard]] const std::vector<double>& radii() const { return radii_; }

    /// Arc length at each point [mm].
    [[nodiscard]] const std::vector<double>& along() const { return along_; }

    [[nodiscard]] double length() const { return along_.empty() ? 0.0 : along_.back(); }

    /// The place at an arc length [mm]; beyond the ends t is below 0 or above 1.
    [[nodiscard]] AxisPlace at(double along) const;

    /// The place of the axis that is nearest to x. \param first, last segments that are looked at
    [[nodiscard]] AxisPlace nearest(const Vec3& x, std::size_t first, std::size_t last) const;
    [[nodiscard]] AxisPlace nearest(const Vec3& x) const;

    [[nodiscard]] Vec3 centre(const AxisPlace& place) const;
    [[nodiscard]] double radius(const AxisPlace& place) const;
    [[nodiscard]] double along(const AxisPlace& place) const;
    /// Unit direction along the axis, at a place or at a point.
    [[nodiscard]] Vec3 tangent(const AxisPlace& place) const;

    [[nodiscard]] const Vec3& tangent(std::size_t point) const { return tangents_[point]; }

    /// Unit direction of angle 0.
    [[nodiscard]] Vec3 first(const AxisPlace& place) const;

    /// Of the arc length, clamped to the tube [mm].
    [[nodiscard]] double radius(double along) const;
    [[nodiscard]] TubeCoordinates coordinates(const Vec3& x) const;
    [[nodiscard]] Vec3 position(double along, double angle, double height) const;

    /// The place whose wall is nearest to x, which another one's centre may be, and its height
    /// [mm].
    [[nodiscard]] std::pair<AxisPlace, double> nearest_wall(const Vec3& x) const;

    [[nodiscard]] double height(const Vec3& x) const { return nearest_wall(x).second; }

    /// The same tube, with angle 0 pointing to x.
    [[nodiscard]] Tube turned_to(const Vec3& x) const;

private:
    Positions points_;
    std::vector<double> radii_;
    std::vector<double> along_;
    Positions tangents_;  ///< at each point
    Positions firsts_;    ///< direction of angle 0 at each point
};

}  // namespace vesselbench
