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

/// Orders the patches (wall, inlet, outlets by descending area, the rest) and assigns a kind and a
/// name to those of kind Cut that are listed in `unnamed`: the inlet, the others outlet_1,
/// outlet_2 ... by descending area. An inlet that is named as an outlet, or the other way round, is
/// renamed.
/// \param inlet a point near the opening that is the inlet [mm]; none: the largest, unless a patch
/// of that kind exists or the largest is not in `unnamed`
/// \param promote without an inlet, the largest of `unnamed`, else the largest outlet, becomes one
[[nodiscard]] Surface name_openings(const Surface& surface, const std::vector<std::string>& unnamed,
                                    const std::optional<Vec3>& inlet = std::nullopt,
                                    bool promote = false);

/// The opening whose centroid is nearest to a point; empty if there is no opening.
[[nodiscard]] std::optional<std::size_t> nearest_opening(const Surface& surface, const Vec3& point);

}  // namespace vesselbench
