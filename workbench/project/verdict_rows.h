#pragma once

#include <string>
#include <vector>

#include "workbench/project/chain.h"

namespace vesselbench {

/// Stores and enters a reviewer's verdicts, once, inside the caller's transaction.
/// \param hash SHA-256 of what they say
/// \return false if these are stored already
bool insert_verdicts(const Database& database, const std::string& text, const std::string& hash,
                     NewEntry entry);

/// The texts in the order they were entered; none in a project without a record.
/// \throw InvalidInput if one is damaged
[[nodiscard]] std::vector<std::string> read_verdicts(const Database& database);

}  // namespace vesselbench
