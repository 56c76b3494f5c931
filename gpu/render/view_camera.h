#pragma once

#include <optional>
#include <span>

#include <Eigen/Core>

#include "geometry/kernel/measure.h"
#include "geometry/kernel/vec3.h"

namespace vesselbench {

/// A view of the scene, as a value. All of its numbers refer to the plane through the centre
/// perpendicular to the view direction, so that perspective and parallel views of the same numbers
/// show what lies there in the same size. Screen places are "ndc": (-1, -1) is the lower left
/// corner of the view, (1, 1) the upper right one. `aspect` is width / height [-].
/// Functions throw InvalidInput if view and up are parallel or zero.
struct ViewCamera {
    Vec3 centre = Vec3::Zero();       ///< shown in the middle, centre of turns [mm]
    Vec3 view = Vec3(0, 1, 0);        ///< direction from the eye to the centre
    Vec3 up = Vec3(0, 0, 1);          ///< need not be perpendicular to view
    double half_height = 50.0;        ///< half the height of the view at the centre [mm]
    bool perspective = false;         ///< else parallel
    double field_of_view_deg = 30.0;  ///< of the view's height, in perspective [deg]

    bool operator==(const ViewCamera&) const = default;
};

/// What the depth range must enclose.
struct Sphere {
    Vec3 centre = Vec3::Zero();  ///< [mm]
    double radius = 0.0;         ///< [mm]
};

/// Seen from a side of the patient, in patient coordinates (LPS).
enum class StandardView { Anterior, Posterior, Left, Right, Superior, Inferior };

struct Ray {
    Vec3 from =
        Vec3::Zero();  ///< the eye; of a parallel view, a point 10 m before the centre's plane [mm]
    Vec3 direction = Vec3(0, 1, 0);  ///< unit
};

/// Rows: right, up and back (towards the eye), unit and perpendicular; for directions.
[[nodiscard]] Eigen::Matrix3d to_eye(const ViewCamera& camera);

/// Distance of the eye from the centre in perspective [mm].
[[nodiscard]] double eye_distance(const ViewCamera& camera);

/// The eye in perspective [mm].
[[nodiscard]] Vec3 eye_of(const ViewCamera& camera);

/// From points [mm] to OpenGL's clip coordinates; the depth range encloses the sphere, as far as it
/// is before the eye.
[[nodiscard]] Eigen::Matrix4d to_clip(const ViewCamera& camera, double aspect, const Sphere& scene);

/// The line of points seen at a place.
[[nodiscard]] Ray ray_through(const ViewCamera& camera, double aspect, const Eigen::Vector2d& ndc);

/// x and y: the place where a point is seen (ndc); z: how far beyond the centre's plane it is [mm].
/// Nothing for a point behind the eye.
[[nodiscard]] std::optional<Vec3> project(const ViewCamera& camera, double aspect,
                                          const Vec3& point);

/// The point that `project` maps to these numbers.
[[nodiscard]] Vec3 unproject(const ViewCamera& camera, double aspect, const Vec3& projected);

/// Length that one pixel shows at a point [mm], in a view of so many pixels' height.
[[nodiscard]] double pixel_size(const ViewCamera& camera, int height, const Vec3& point);

/// The camera that shows all points with the same directions, or a box, with a margin.
/// \param margin fraction of the half height that is kept free [-]
[[nodiscard]] ViewCamera framed(const ViewCamera& camera, std::span<const Vec3> points,
                                double aspect, double margin = 0.06);
[[nodiscard]] ViewCamera framed(const ViewCamera& camera, const Bounds& box, double aspect,
                                double margin = 0.06);

/// Half height of a view with this centre that shows all points, without margin [mm].
[[nodiscard]] double fitting_half_height(const ViewCamera& camera, std::span<const Vec3> points,
                                         double aspect);

/// Trackball: the scene follows a cursor that goes right and up; about the centre.
/// \param right, up angles [rad]
[[nodiscard]] ViewCamera turned(const ViewCamera& camera, double right, double up);

/// The scene turns counter-clockwise on the screen by an angle [rad].
[[nodiscard]] ViewCamera rolled(const ViewCamera& camera, double angle);

/// What is seen at `from`, in the plane `depth` beyond the centre's [mm], moves to `to`.
[[nodiscard]] ViewCamera panned(const ViewCamera& camera, double aspect,
                                const Eigen::Vector2d& from, const Eigen::Vector2d& to,
                                double depth = 0.0);

/// Makes things in the centre's plane larger by a factor (above 1: nearer); what is seen there at
/// `towards` stays.
[[nodiscard]] ViewCamera zoomed(const ViewCamera& camera, double aspect, double factor,
                                const Eigen::Vector2d& towards = Eigen::Vector2d::Zero());

/// The same centre and size, seen from a side.
[[nodiscard]] ViewCamera facing(const ViewCamera& camera, StandardView side);

/// A perspective camera in a place, for flights in a lumen; its centre is `distance` before it
/// [mm].
[[nodiscard]] ViewCamera looking_from(const Vec3& eye, const Vec3& view, const Vec3& up,
                                      double distance, double field_of_view_deg = 80.0);

/// In perspective: turns about the eye instead of the centre [rad].
[[nodiscard]] ViewCamera looked_round(const ViewCamera& camera, double right, double up);

}  // namespace vesselbench
