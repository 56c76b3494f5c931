#pragma once

#include <functional>
#include <string>

#include "geometry/kernel/surface.h"

namespace vesselbench::test {

/// Geodesic sphere: an icosahedron divided `levels` times, 20 * 4^levels triangles, outward.
[[nodiscard]] Surface icosphere(double radius, int levels, const Vec3& centre = Vec3::Zero());

/// A sphere with a smaller one inside that faces inward and is rotated, `thickness` apart; both are
/// icospheres.
[[nodiscard]] Surface sphere_shell(double radius, double thickness, int levels);

/// Cylinder wall along +z from z = 0 to `length`, both ends open, outward.
[[nodiscard]] Surface open_tube(double radius, double length, int around, int along);

/// The same tube closed by flat fans; patches wall, inlet (z = 0), outlet_1 (z = length).
[[nodiscard]] Surface closed_tube(double radius, double length, int around, int along);

/// The closed tube with almost equilateral triangles on wall and caps: staggered rows, concentric
/// rings.
/// \param around vertices around, a multiple of 6; the edge length is 2 pi radius / around
[[nodiscard]] Surface fine_tube(double radius, double length, int around);

/// Axis-parallel cube from 0 to `edge`, 12 triangles, outward.
[[nodiscard]] Surface cube(double edge);

/// The surface with every position mapped.
[[nodiscard]] Surface mapped(const Surface& surface, const std::function<Vec3(const Vec3&)>& map);

/// A rotation about an oblique axis.
[[nodiscard]] Eigen::Matrix3d skew_rotation();

/// Path of ../shared/data/<name> beside the checkout, or empty if it is not there: the
/// scenario counts as skipped.
[[nodiscard]] std::string shared_data(const std::string& name);

/// A new empty folder for one test, removed when the program ends.
[[nodiscard]] std::string temporary_folder();

/// Writes an OFF file that does not state its unit.
void write_unitless(const Surface& surface, const std::string& path);

}  // namespace vesselbench::test
