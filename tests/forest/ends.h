#pragma once

#include "tests/forest/plan.h"
#include "tests/forest/tree.h"

namespace vesselbench::forest {

/// Edges of an image's voxels [mm].
struct Voxels {
    double pixel = 0.5;
    double slice = 0.5;  ///< distance of slices
};

/// Contains the tree, with what only shapes its ends [mm].
[[nodiscard]] Eigen::AlignedBox3d box_of(const Tree& tree);

/// As fine as the vessels need, or as 16 million voxels allow.
[[nodiscard]] Voxels voxels_for(const Plan& plan, const Tree& tree);

/// Decides how each vessel ends, what of it can be opened, and which vessels an image shows.
void form_ends(Tree& tree, const Plan& plan);

/// The line around which a branch's wall lies: of a rounded end without its last radius.
[[nodiscard]] Line shaping_line(const Branch& branch);

/// Whether p lies in what is cut away at an end: near its vessel, beyond its plane.
[[nodiscard]] bool is_cut_away(const Tree& tree, const Branch& branch, const Vec3& p);

/// Whether p is at the part of a vessel in which its end is cut.
[[nodiscard]] bool is_at_end(const Tree& tree, const Branch& branch, const Vec3& p);

}  // namespace vesselbench::forest
