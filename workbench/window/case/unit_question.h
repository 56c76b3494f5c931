#pragma once

#include <optional>
#include <string>

#include "workbench/session/snapshot.h"

namespace vesselbench {

/// A surface file whose unit was guessed although another one is nearly as plausible.
struct UnitQuestion {
    EditId edit = 0;    ///< that loaded it
    std::string doubt;  ///< the two readings, in one sentence
    std::string read;   ///< the unit that was taken: "mm"

    bool operator==(const UnitQuestion&) const = default;
};

/// The question of the current state; none: no unit is in doubt, or it was given.
[[nodiscard]] std::optional<UnitQuestion> unit_question(const Snapshot& snapshot);

}  // namespace vesselbench
