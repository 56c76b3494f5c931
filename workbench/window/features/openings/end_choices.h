#pragma once

#include <map>
#include <set>
#include <vector>

#include "geometry/kernel/cross_section.h"
#include "workbench/window/features/openings/planned_ends.h"
#include "workbench/window/form/field_text.h"

namespace vesselbench {

/// What a user decided about vessel ends, by their numbers. A form of clip-opening holds it as its
/// texts: places in `open`, `closed` and `inlet`. Cuts that were moved and branches that go need
/// the whole plan, too, in `planes`, `names` and `closings`, which are used as they are.
struct EndChoices {
    std::set<int> open, closed, inlets;
    std::set<int> removed;      ///< their branches are cut off at the root
    std::map<int, Plane> cuts;  ///< moved by hand; normals out of the vessel

    /// The texts have to give every opening as a plane.
    [[nodiscard]] bool fixes_plan() const { return !cuts.empty() || !removed.empty(); }
};

/// The choices that a form's texts express. Ends that are named both ways are as `open`, `closed`
/// and `inlet` name them.
[[nodiscard]] EndChoices choices_in(const OperationForm& form, const PlannedEnds& planned);

/// True if the end is opened: chosen, or else as planned.
[[nodiscard]] bool is_open(const EndChoices& choices, const PlannedEnds& planned, int number);

/// Where the blood enters: chosen, or else as planned; of a plan that names none the widest
/// opening.
[[nodiscard]] std::set<int> inlets_of(const EndChoices& choices, const PlannedEnds& planned);

/// How an end is opened: at the moved cut, or else as planned; none if that is not known.
[[nodiscard]] std::optional<PlannedOpening> opening_of(const EndChoices& choices,
                                                       const PlannedEnds& planned, int number);

/// The texts of the six parameters above, and empty ones of those that name ends by numbers.
/// Texts that fix the plan are right once `planned` is that of the same choices.
[[nodiscard]] std::vector<FieldText> texts_of(const EndChoices& choices,
                                              const PlannedEnds& planned);

}  // namespace vesselbench
