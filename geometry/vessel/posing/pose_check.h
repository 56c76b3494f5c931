#pragma once

#include <span>

#include "geometry/kernel/progress.h"
#include "geometry/kernel/surface.h"
#include "geometry/vessel/posing/pose.h"

namespace vesselbench {

/// The least radius of a bend [radii of the vessel]: at 1 the inner wall is a crease.
inline constexpr double kLeastBend = 1.2;

/// \throw DiagnosedFailure "bend-too-strong" where the pose bends a vessel to less than kLeastBend
void require_gentle(const Armature& armature, std::span<const RodPose> poses);

/// \throw DiagnosedFailure "posing-crosses-walls" if moved triangles cross others that they did not
/// cross before; Cancelled
void require_no_crossing(const Surface& before, const Positions& moved, const Progress& progress);

/// \throw DiagnosedFailure with the stiff branch's code
[[noreturn]] void throw_stiff(const StiffBranch& branch);

}  // namespace vesselbench
