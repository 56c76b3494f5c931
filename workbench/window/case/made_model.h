#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "workbench/case/history.h"
#include "workbench/case/scene.h"

namespace vesselbench {

/// A model that a recipe or a run of pending edits has made.
struct MadeModel {
    std::string what;             ///< "Ran 5 pending edits"
    std::string variant;          ///< whose model it is
    StateId from = 0, state = 0;  ///< of the history, before and after
    std::optional<Scene> before;  ///< the model before; none: not known
    std::size_t warnings_before = 0;
};

}  // namespace vesselbench
