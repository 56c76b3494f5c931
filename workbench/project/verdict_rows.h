#pragma once

#include <string>
#include <vector>

#include "workbench/project/chain.h"
#include "workbench/project/stored_verdicts.h"

namespace vesselbench {

/// Stores and enters a reviewer's verdicts, once, inside the caller's transaction. Their signature
/// is a text of the project, "signature HASH", so that programs which know no signatures read them.
/// \param verdicts their time is that of the call
/// \param hash SHA-256 of what they say
/// \return false if these are stored already
bool insert_verdicts(const Database& database, const StoredVerdicts& verdicts,
                     const std::string& hash, NewEntry entry);

/// The verdicts in the order they were entered; none in a project without a record.
/// \throw InvalidInput if one is damaged
[[nodiscard]] std::vector<StoredVerdicts> read_verdicts(const Database& database);

}  // namespace vesselbench
