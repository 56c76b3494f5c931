#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "geometry/kernel/measure.h"
#include "workbench/session/snapshot.h"
#include "workbench/window/features/openings/end_rows.h"
#include "workbench/window/form/field_text.h"

namespace vesselbench {

/// Texts by which an opening becomes the inlet, and the inlet so far an outlet; or an outlet, with
/// a free name if it was none.
/// \param patches of the surface
[[nodiscard]] std::vector<FieldText> role_texts(const PatchMeasures& opening, PatchKind role,
                                                const std::vector<Patch>& patches);

/// Where the edit that opens all ends of a variant made an opening.
struct MadeOpening {
    EditId edit = 0;
    Vec3 tip = Vec3::Zero();  ///< of the end that it cut [mm]
};

/// By the axes of the edit's planes, along which an opening may have been extended; of several
/// edits the last. None: no edit opened all ends, or none did there.
[[nodiscard]] std::optional<MadeOpening> made_opening(const Snapshot& now,
                                                      const std::string& variant,
                                                      const PatchMeasures& opening);

/// The fields of an edit that names ends by their numbers, with the places that it found for these
/// instead: on its input now, the numbers may be those of other ends.
[[nodiscard]] std::vector<FieldText> found_texts(const Snapshot& now, EditId edit);

/// By their numbers, the ends that an edit opened or closed and that would be otherwise now.
[[nodiscard]] std::vector<std::pair<int, EndWish>> former_wishes(const std::vector<EndRow>& rows,
                                                                 const Snapshot& now, EditId edit);

/// A list of names, separated by commas, with a name added or taken away.
[[nodiscard]] std::string with_name_switched(const std::string& list, const std::string& name);

}  // namespace vesselbench
