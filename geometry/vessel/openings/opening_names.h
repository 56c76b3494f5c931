#pragma once

#include <optional>
#include <string>
#include <vector>

#include "geometry/kernel/surface.h"

namespace vesselbench {

/// A name that no patch has yet: the first free one of stem_first, stem_(first + 1) ...; number 0
/// is the stem alone.
[[nodiscard]] std::string free_patch_name(const std::string& stem, int first,
                                          const std::vector<Patch>& patches);

/// Who becomes an inlet.
struct InletChoice {
    /// Near the openings that are the inlets, all others become outlets [mm].
    Positions points = {};
    /// Without any, the widest of the openings without a name, else the widest outlet, becomes one.
    bool promote = false;
    bool gathers = false;  ///< as in a vein: the outlet is the trunk
};

/// Orders the patches (wall, inlet, outlets by descending area, the rest) and assigns a kind and a
/// name to those of kind Cut that are listed in `unnamed`: inlet, or inlet_1, inlet_2 ... where
/// several are, the others outlet_1, outlet_2 ..., by descending area. An inlet that is named as an
/// outlet, or the other way round, is renamed. Where blood gathers and one outlet is named, it is
/// called outlet.
/// Without points, the inlet is the opening of the widest vessel, measured across its axis, unless
/// a patch of that kind exists or that opening is not in `unnamed`.
/// \param choice who becomes an inlet, and how the blood runs
[[nodiscard]] Surface name_openings(const Surface& surface, const std::vector<std::string>& unnamed,
                                    const InletChoice& choice = {});

/// Outlets that may be inlets as well, as in a circle of Willis: at least 0.6 times as wide as the
/// inlet, and facing the same way within 60 degrees. Empty unless there is exactly one inlet.
[[nodiscard]] std::vector<std::size_t> likely_inlets(const Surface& surface);

/// The opening whose centroid is nearest to a point; empty if there is no opening.
[[nodiscard]] std::optional<std::size_t> nearest_opening(const Surface& surface, const Vec3& point);

}  // namespace vesselbench
