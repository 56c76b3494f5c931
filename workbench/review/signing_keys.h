#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "workbench/review/entered_verdicts.h"
#include "workbench/review/retired_keys.h"

namespace vesselbench {

/// A key that signed verdicts of a project, or that was retired there.
struct SigningKey {
    std::string fingerprint;              ///< key_fingerprint()
    std::vector<std::string> reviewers;   ///< names that the files give, each once
    std::vector<std::string> principals;  ///< of the allowed signers, where it is one of theirs
    std::size_t files = 0;                ///< of verdicts that it signed
    std::optional<RetiredKey> retired;
};

/// Each once, in the order of their first files; those that signed nothing last.
[[nodiscard]] std::vector<SigningKey> signing_keys(const std::vector<EnteredVerdicts>& entered,
                                                   const std::vector<RetiredKey>& retired);

/// A list of {"fingerprint", "reviewers", "principals", "files", "retired"}, the last one null or
/// {"time", "author", "reason"}.
[[nodiscard]] nlohmann::ordered_json keys_json(const std::vector<SigningKey>& keys);

}  // namespace vesselbench
