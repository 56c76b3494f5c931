#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "workbench/project/chain.h"
#include "workbench/session/session.h"

namespace vesselbench {

/// A key with which nobody should sign any more, as the record says.
struct RetiredKey {
    std::string fingerprint;       ///< key_fingerprint()
    std::string time;              ///< UTC, of the entry
    std::string author;            ///< who retired it
    std::string reason;            ///< "lost"
    std::size_t files_before = 0;  ///< of verdicts, that were entered before it
};

/// In the order of their entries. \param entries of the whole record
[[nodiscard]] std::vector<RetiredKey> retired_keys(std::span<const ChainEntry> entries);

/// The same; reads the record.
[[nodiscard]] std::vector<RetiredKey> retired_keys(const ProjectFile& project);

/// The key with this fingerprint among them; null: it is not retired.
[[nodiscard]] const RetiredKey* find_retired(const std::vector<RetiredKey>& keys,
                                             const std::string& fingerprint);

/// "its key was retired on 2026-05-17T09:30:00Z: lost"
[[nodiscard]] std::string retired_words(const RetiredKey& key);

/// Enters that a key is retired: what it signs is no longer entered, and does not count if it is in
/// the project all the same. What was entered before stays as it is.
/// \param fingerprint as `ssh-keygen -l` prints it
/// \param reason in the user's words
/// \throw UsageError if it is no fingerprint; InvalidInput if the key is retired already; IoError
void retire_key(Session& session, const std::string& fingerprint, const std::string& reason);

}  // namespace vesselbench
