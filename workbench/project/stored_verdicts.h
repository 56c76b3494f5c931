#pragma once

#include <cstddef>
#include <string>

namespace vesselbench {

/// [bytes] of a detached SSH signature.
constexpr std::size_t kLargestSignature = std::size_t{64} << 10;

/// A reviewer's verdicts in a project.
struct StoredVerdicts {
    std::string text;       ///< JSON; of signed ones byte for byte what was signed
    std::string signature;  ///< armored, as `ssh-keygen -Y sign` writes it; empty: not signed
    std::string time = {};  ///< UTC, when they were entered
};

}  // namespace vesselbench
