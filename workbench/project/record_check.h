#pragma once

#include <string>
#include <vector>

#include "geometry/kernel/diagnostic.h"
#include "geometry/kernel/progress.h"
#include "workbench/project/chain.h"

namespace vesselbench {

/// What a project's record says, and whether the project is what it says.
struct RecordCheck {
    std::string project;               ///< its lasting id
    std::vector<ChainEntry> entries;   ///< in the order of their numbers
    std::vector<Diagnostic> findings;  ///< contradictions; empty: none
    std::size_t rows = 0;              ///< stored rows that were compared with the entries
    std::size_t referenced = 0;        ///< blobs whose content is not in the file
};

/// Verifies that every entry follows from the one before it, that the last one is the one that was
/// entered last, and that the stored rows are exactly those that the entries bind. The content of
/// data, which PartStore verifies when it reads them, is not read. \throw IoError
[[nodiscard]] RecordCheck check_record_rows(const Database& database);

/// The same, and everything else: verifies that every entry follows from the one before it, that
/// the last one is the one that was entered last, that the stored rows are exactly those that the
/// entries bind, and that every blob has the content of its SHA-256. Writes nothing.
/// \throw Cancelled, IoError
[[nodiscard]] RecordCheck check_record(const Database& database, const Progress& progress = {});

/// "edits 2.1" of RowDigests for people: "edit 2.1".
[[nodiscard]] std::string row_words(const std::string& key);

}  // namespace vesselbench
