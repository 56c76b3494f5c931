#pragma once

#include <cstddef>
#include <string>

#include "workbench/session/snapshot.h"
#include "workbench/window/case/edit_input.h"

namespace vesselbench {

/// Edits that have to run again.
struct Rerun {
    std::size_t edits = 0;
    double seconds = 0.0;  ///< that they took when they ran last [s]; what never ran is not in it
};

/// The pending edits of a variant's model.
[[nodiscard]] Rerun pending_rerun(const Snapshot& snapshot, const std::string& variant);

/// The same after an edit was entered at a place: those that follow it are pending then.
[[nodiscard]] Rerun rerun_after(const EditSite& site, const Snapshot& snapshot,
                                const std::string& variant);

/// "5 edits, about 20 s"
[[nodiscard]] std::string rerun_text(const Rerun& rerun);

}  // namespace vesselbench
