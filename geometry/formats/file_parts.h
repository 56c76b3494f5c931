#pragma once

#include <string>
#include <vector>

#include "geometry/formats/raw_surface.h"

namespace vesselbench {

/// Makes a surface of what a file holds and turns its parts into patches: named parts by their
/// names, unnamed ones by their shape (flat: a cut; else wall). Notes say what was decided.
[[nodiscard]] Surface surface_from(RawSurface raw, std::vector<std::string>& notes);

/// The kind that a part's name tells: wall, inlet..., outlet..., cut...; none for other names.
[[nodiscard]] std::optional<PatchKind> kind_of_name(const std::string& name);

}  // namespace vesselbench
