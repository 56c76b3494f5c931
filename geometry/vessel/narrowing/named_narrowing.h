#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "geometry/kernel/progress.h"
#include "geometry/kernel/surface.h"
#include "geometry/vessel/narrowing/narrowing.h"

namespace vesselbench {

/// A narrowing as a user names it.
struct NarrowingQuestion {
    Vec3 at = Vec3::Zero();    ///< on the wall or inside [mm]
    std::optional<Vec3> from;  ///< ends of the stretch, near the vessel's axis [mm]; without both,
    std::optional<Vec3> to;    ///< those of a narrowing found at the point
    NarrowingParameters parameters;
};

/// The narrowing that is meant.
struct NamedNarrowing {
    std::shared_ptr<const CenterlineGraph> graph;
    std::vector<WallRing> rings;  ///< of its branch
    Narrowing narrowing;
    Vec3 from = Vec3::Zero(), to = Vec3::Zero();  ///< ends of its stretch on the axis [mm]; as a
                                                  ///< question, they name the same narrowing
};

/// \throw AlgorithmFailure, with its place, if there is no narrowing at the point and no stretch is
///        given, or the point is at a furcation or an end, or the stretch has no length or leaves
///        no vessel to compare with; and what centerlines_of throws
[[nodiscard]] NamedNarrowing narrowing_at(const Surface& surface, const NarrowingQuestion& question,
                                          const Progress& progress = {});

}  // namespace vesselbench
