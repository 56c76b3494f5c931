#pragma once

#include <optional>
#include <vector>

#include "geometry/kernel/progress.h"
#include "geometry/kernel/surface.h"
#include "geometry/vessel/centerlines/centerline_graph.h"
#include "geometry/vessel/centerlines/stubs.h"
#include "geometry/vessel/ends/end_choice.h"

namespace vesselbench {

/// A blind end, or a blind branch without a line, as a plan of openings judges it beside all
/// others.
struct JudgedTip {
    Vec3 tip = Vec3::Zero();  ///< [mm]
    EndVerdict verdict;
};

/// The ends that a plan of openings (plan_openings) would judge, with the same odds; ends that the
/// surface has cut already are left out.
/// \param graph, stubs of the surface \param image that the surface was made from
/// \throw Cancelled
[[nodiscard]] std::vector<JudgedTip> judged_tips(const Surface& surface,
                                                 const CenterlineGraph& graph,
                                                 const std::vector<Stub>& stubs,
                                                 const std::optional<ImageBox>& image,
                                                 const Progress& progress = {});

}  // namespace vesselbench
