#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "workbench/project/database.h"
#include "workbench/project/row_digests.h"

namespace vesselbench {

// Kinds of entries that several places know.
constexpr const char* kVerdictsEntered = "verdicts";
constexpr const char* kKeyRetired = "key-retired";

/// One entry of a project's chained record.
struct ChainEntry {
    std::int64_t number = 0;  ///< 1, 2, ...
    std::string time;         ///< UTC
    std::string kind;         ///< "edit", "result", "note", "verdicts", "export" ...
    std::string subject;      ///< "edit 2.1", "spots", "model.stl"
    std::string author;       ///< as given; empty: nobody was named
    std::string version;      ///< of vesselbench
    std::string content;      ///< JSON with sorted keys: facts, and the digests of rows
    std::string hash;         ///< link_of()

    bool operator==(const ChainEntry&) const = default;
};

/// What is entered.
struct NewEntry {
    std::string kind, subject, author;
    nlohmann::json facts = nlohmann::json::object();
    RowDigests rows;                ///< those that were written
    std::vector<std::string> gone;  ///< keys of rows that were removed
};

/// What the chain starts from, in place of an earlier entry's hash.
[[nodiscard]] std::string chain_start();

/// SHA-256, in 64 hexadecimal digits, of the earlier entry's hash, a line break, and the entry
/// without its hash as JSON with sorted keys and no blanks.
[[nodiscard]] std::string link_of(const std::string& earlier, const ChainEntry& entry);

/// Adds an entry inside the caller's transaction, which also writes what the entry records.
void append_entry(const Database& database, const NewEntry& entry);

/// The hash of the last entry; empty: the project has no record (its file is of an earlier version
/// and was not opened for writing since).
[[nodiscard]] std::string chain_head(const Database& database);

/// True if an entry has this hash.
[[nodiscard]] bool has_entry(const Database& database, const std::string& hash);

/// The hash that is kept beside the chain, of what was entered last.
[[nodiscard]] std::string kept_chain_head(const Database& database);

/// All entries, in order. \throw InvalidInput if a text is too long to be one of a record
[[nodiscard]] std::vector<ChainEntry> read_chain(const Database& database);

/// A lasting id of a new project: a random UUID.
[[nodiscard]] std::string new_project_id();

/// Empty if it has none, as projects of an earlier version.
[[nodiscard]] std::string project_id(const Database& database);

}  // namespace vesselbench
