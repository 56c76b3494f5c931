#pragma once

#include <vector>

#include "geometry/kernel/topology.h"
#include "geometry/kernel/vec3.h"
#include "smoothing/context/area_normals.h"

namespace vesselbench {

/// The axes across which steps are looked for: the stack axis, or all three of cubic voxels, whose
/// masks have steps across each.
class StackAxes {
public:
    /// \param axes one axis, or three as columns; any length but 0
    template <class Derived>
    StackAxes(const Eigen::MatrixBase<Derived>& axes) {  // implicit: one axis is the usual case
        for (Eigen::Index i = 0; i < axes.cols(); ++i) axes_.emplace_back(axes.col(i));
    }

    [[nodiscard]] auto begin() const { return axes_.begin(); }

    [[nodiscard]] auto end() const { return axes_.end(); }

    [[nodiscard]] std::size_t size() const { return axes_.size(); }

private:
    std::vector<Vec3> axes_;
};

/// Orientation of every face relative to the image stack [-]: 0 if the face's normal is parallel to
/// the stack axis, 1 if it is orthogonal; 0 for degenerate faces. #T
/// Source: thesis Eq. 5.3.
/// \param stack_axis any length but 0
/// \throw InvalidInput if the axis has no direction
[[nodiscard]] std::vector<double> face_orientations(const Topology& topology,
                                                    const Positions& positions,
                                                    const Vec3& stack_axis);

/// Orientation change theta' of every vertex [-]: the largest minus the smallest orientation of the
/// faces around it, in [0, 1]; 0 in flat areas, 1 at perfect staircase edges. Degenerate faces are
/// ignored. The largest of several axes. #V
/// Source: thesis Eq. 5.4.
/// \throw InvalidInput if an axis has no direction
[[nodiscard]] std::vector<double> orientation_change(const Topology& topology,
                                                     const Positions& positions,
                                                     const StackAxes& stack_axes);

/// The same from normals computed before, which the search for caps shares.
/// \throw InvalidInput if an axis has no direction
[[nodiscard]] std::vector<double> orientation_change(const AreaNormals& faces,
                                                     const StackAxes& stack_axes);

/// \throw InvalidInput if the axis has no direction
[[nodiscard]] Vec3 unit_axis(const Vec3& stack_axis);

}  // namespace vesselbench
