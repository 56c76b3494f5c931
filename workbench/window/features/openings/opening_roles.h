#pragma once

#include "geometry/kernel/measure.h"
#include "workbench/window/form/field_text.h"

namespace vesselbench {

/// Texts by which an opening becomes the inlet, and the inlet so far an outlet; or an outlet, with
/// a free name if it was none.
/// \param patches of the surface
[[nodiscard]] std::vector<FieldText> role_texts(const PatchMeasures& opening, PatchKind role,
                                                const std::vector<Patch>& patches);

/// A list of names, separated by commas, with a name added or taken away.
[[nodiscard]] std::string with_name_switched(const std::string& list, const std::string& name);

}  // namespace vesselbench
