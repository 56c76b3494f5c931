#pragma once

#include <string>
#include <vector>

#include "workbench/review/entered_verdicts.h"

namespace vesselbench {

/// Whose an entered file of verdicts is.
struct ReviewerIdentity {
    /// Equal for files of which the later one replaces the earlier: of one signer, whatever keys
    /// and names, or of one name that nobody signed. What is not signed is the signer's who first
    /// signed under the name.
    std::string giver;
    /// Equal for files that may be of one person: by a chain of equal givers and equal names.
    std::string person;
    bool is_signed = false;  ///< by a key that verifies, or that nobody asked to be verified
};

/// One for each file. Signers are known by a principal of the allowed signers, and by the key where
/// nobody says whose keys are allowed.
[[nodiscard]] std::vector<ReviewerIdentity> identities_of(
    const std::vector<EnteredVerdicts>& files);

}  // namespace vesselbench
