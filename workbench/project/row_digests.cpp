#include "workbench/project/row_digests.h"

#include <algorithm>
#include <array>

#include "geometry/kernel/errors.h"
#include "workbench/project/content_hash.h"

namespace vesselbench {

namespace {

struct BoundTable {
    const char* name;
    const char* key;      ///< SQL of the key's text
    const char* columns;  ///< that the digest covers
    const char* among;    ///< SQL that selects the bound rows
};

constexpr std::array<BoundTable, 7> kTables = {{
    {"edits", "edit || '.' || revision", "*", "1"},
    {"sources", "edit || '.' || revision || ' ' || parameter", "*", "1"},
    {"states", "id", "*", "1"},
    {"results", "id", "*", "1"},
    {"blobs", "id", "id, hash, content IS NULL", "1"},
    {"verdicts", "id", "*", "1"},
    {"meta", "name", "*", "name NOT IN ('chain head', 'view')"},
}};

std::string digest_of_row(const Statement& row) {
    ContentHash hash;
    for (int column = 1; column < row.columns(); ++column) {
        const std::string value = row.exact(column);
        hash.add(std::as_bytes(std::span(value)));
    }
    return hash.hex();
}

/// Version 1 of the schema has no verdicts.
bool has_table(const Database& database, const std::string& name) {
    Statement query = database.prepare("SELECT 1 FROM sqlite_master WHERE name = ?");
    query.bind(0, name);
    return query.step();
}

}  // namespace

void add_row_digests(const Database& database, const std::string& table, const std::string& where,
                     RowDigests& digests) {
    const auto* bound = std::ranges::find(kTables, table, &BoundTable::name);
    if (bound == kTables.end()) throw InvalidInput("no rows of " + table + " are bound");
    const std::string rows = where.empty() ? "1" : where;
    for (auto row = database.prepare(std::string("SELECT ") + bound->key + ", " + bound->columns +
                                     " FROM " + table + " WHERE (" + bound->among + ") AND (" +
                                     rows + ")");
         row.step();)
        digests[table + " " + row.text(0)] = digest_of_row(row);
}

RowDigests all_row_digests(const Database& database) {
    RowDigests digests;
    for (const BoundTable& table : kTables)
        if (has_table(database, table.name)) add_row_digests(database, table.name, "", digests);
    return digests;
}

}  // namespace vesselbench
