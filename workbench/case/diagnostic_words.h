#pragma once

#include <string>
#include <vector>

#include "geometry/kernel/diagnostic.h"

namespace vesselbench {

/// Who reads a diagnostic, and what they know.
struct Audience {
    bool window = false;       ///< without the command line's language
    std::string project = {};  ///< path; empty: remedies are no complete commands
    bool preparing = false;    ///< by a recipe: what was refused goes on with --resume --set
};

/// A diagnostic as a sentence. Remedies are named as their readers would give them: as `vesselbench
/// change case.vbench 4 edge=0.2` where the project is known, as edge=0.2 elsewhere; in the window
/// as "Edge" = 0.2.
[[nodiscard]] std::string worded(const Diagnostic& diagnostic, const Audience& audience = {});

/// With its operation before it: "repair: a hole was closed ...", in the window "Repair: ...".
[[nodiscard]] std::string worded_with_operation(const Diagnostic& diagnostic,
                                                const Audience& audience = {});

[[nodiscard]] std::vector<std::string> worded(const std::vector<Diagnostic>& diagnostics,
                                              const Audience& audience = {});

}  // namespace vesselbench
