#pragma once

#include <span>

#include <nlohmann/json_fwd.hpp>

#include "workbench/project/chain.h"

namespace vesselbench {

/// The files that a record says were written, as JSON: name, variant, time, SHA-256; of one that
/// was written several times the last.
[[nodiscard]] nlohmann::ordered_json exports_json(std::span<const ChainEntry> entries);

/// What a report on a printed or simulated patient's model should state, by the steps that the
/// guideline of the RSNA names (docs/user/review.md): a list of `item`, `stated`, and `text` with
/// what is, or why it is not.
/// \param statement as statement_of() makes it
[[nodiscard]] nlohmann::ordered_json reporting_items(const nlohmann::ordered_json& statement);

}  // namespace vesselbench
