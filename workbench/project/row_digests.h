#pragma once

#include <map>
#include <string>

#include "workbench/project/database.h"

namespace vesselbench {

/// SHA-256 of stored rows, by table and key: "edits 2.1", "sources 2.1 file", "states 4",
/// "results 3", "blobs 7", "verdicts 1", "meta spots". A digest covers the type and the exact value
/// of every column. Two columns are bound otherwise: of a blob, the digest covers the SHA-256 of
/// its content and whether the content is in the file; the head of the chain follows from the
/// chain.
using RowDigests = std::map<std::string, std::string>;

/// Adds the digests of some rows of a table.
/// \param where SQL that selects them; empty: all
void add_row_digests(const Database& database, const std::string& table, const std::string& where,
                     RowDigests& digests);

/// The digests of all rows that the chain binds.
[[nodiscard]] RowDigests all_row_digests(const Database& database);

}  // namespace vesselbench
