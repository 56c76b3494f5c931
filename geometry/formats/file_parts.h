#pragma once

#include <string>
#include <vector>

#include "geometry/formats/raw_surface.h"

namespace vesselbench {

/// Makes a surface from a file's content and turns its parts into patches: named parts by their
/// names, unnamed ones by their shape (flat: a cut; else wall). Names become plain and differ from
/// each other (geometry/kernel/plain_name.h). Notes state the decisions.
[[nodiscard]] Surface surface_from(RawSurface raw, std::vector<std::string>& notes);

/// The kind derived from a part's name: wall, inlet..., outlet..., cut...; none for other names.
[[nodiscard]] std::optional<PatchKind> kind_of_name(const std::string& name);

}  // namespace vesselbench
