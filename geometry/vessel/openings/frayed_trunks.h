#pragma once

#include <cstddef>
#include <vector>

#include "geometry/kernel/surface.h"
#include "geometry/vessel/centerlines/centerline_graph.h"
#include "geometry/vessel/centerlines/stubs.h"

namespace vesselbench {

/// An end in which a trunk frays.
struct ThinEnd {
    Vec3 place = Vec3::Zero();  ///< its tip [mm]
    double diameter = 0.0;      ///< [mm]
};

/// A vessel that splits into closed threads over a stretch hardly longer than it is wide: where an
/// image shows its contrast agent arriving or fading, or its noise.
struct FrayedTrunk {
    std::size_t tip = 0;  ///< node of the lines without frays, where the trunk is whole
    std::vector<ThinEnd> ends;
};

struct LinesWithoutFrays {
    CenterlineGraph graph;  ///< a frayed trunk has one tip, where its threads begin
    std::vector<FrayedTrunk> trunks;
};

/// No vessel ends like this: of a trunk's at least three threads none is wider than a quarter of
/// it, they have less than a tenth of its section in common, and all lie within its 2.8 diameters.
/// The trunk is longer than sacs are, 2.5 of its radii, and over them, but for its rounded end,
/// nowhere narrower than seven tenths of it. A thread that ends in a rim or cap of the surface was
/// meant: there is no fray, nor where the trunk itself ends among them, in a stub four tenths as
/// wide.
[[nodiscard]] LinesWithoutFrays without_frays(const Surface& surface, const CenterlineGraph& graph,
                                              const std::vector<Stub>& stubs = {});

}  // namespace vesselbench
