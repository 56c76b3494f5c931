#pragma once

#include <optional>
#include <string>
#include <vector>

#include "geometry/kernel/diagnostic.h"

namespace vesselbench {

/// One of the things that a finding may turn out to be.
struct Reading {
    std::string key;       ///< a plain word: "sac", "stub"
    std::string name;      ///< as a clinician says it: "sac (aneurysm?)"
    bool anatomy = false;  ///< of the patient: it is kept
    std::optional<double> odds =
        {};  ///< [-], of all readings 1 together; none: nothing weighs them
    std::vector<Diagnostic> evidence = {};  ///< what speaks for it
};

}  // namespace vesselbench
