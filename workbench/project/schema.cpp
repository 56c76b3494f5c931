#include "workbench/project/schema.h"

#include <algorithm>
#include <string>
#include <vector>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/printable.h"
#include "workbench/case/version.h"
#include "workbench/project/chain.h"
#include "workbench/project/part_store.h"

namespace vesselbench {

namespace {

constexpr std::int64_t kApplication = 0x56424e43;  // "VBNC", PRAGMA application_id
constexpr std::int64_t kVersion = 2;               // PRAGMA user_version

/// "table edits: CREATE TABLE ..." of all that the schema contains, sorted.
std::vector<std::string> contents_of(const Database& database) {
    std::vector<std::string> contents;
    for (auto row = database.prepare("SELECT type, name, tbl_name, coalesce(sql, '')"
                                     " FROM sqlite_master ORDER BY type, name");
         row.step();)
        contents.push_back(row.text(0) + " " + row.text(1) + " " + row.text(2) + " " + row.text(3));
    return contents;
}

std::string writer_of(const Database& database) {
    Statement query = database.prepare("SELECT value FROM meta WHERE name = 'written by'");
    return query.step() ? query.text(0) : "?";
}

/// The tables of version 1.
void make_first_tables(const Database& database) {
    database.run(
        "CREATE TABLE meta(name TEXT PRIMARY KEY, value) WITHOUT ROWID;"
        "CREATE TABLE edits(edit INTEGER, revision INTEGER, step INTEGER NOT NULL,"
        " variant TEXT NOT NULL, operation TEXT NOT NULL, author TEXT NOT NULL,"
        " time TEXT NOT NULL, note TEXT NOT NULL, given BLOB NOT NULL,"
        " PRIMARY KEY(edit, revision)) WITHOUT ROWID;"
        "CREATE TABLE states(id INTEGER PRIMARY KEY, parent INTEGER NOT NULL,"
        " change INTEGER NOT NULL, edit INTEGER NOT NULL, revision INTEGER NOT NULL,"
        " last_child INTEGER NOT NULL);"
        "CREATE TABLE results(id INTEGER PRIMARY KEY, edit INTEGER NOT NULL,"
        " revision INTEGER NOT NULL, input INTEGER NOT NULL, stale TEXT NOT NULL,"
        " time TEXT NOT NULL, duration REAL NOT NULL, version TEXT NOT NULL,"
        " device TEXT NOT NULL, details BLOB NOT NULL, scene BLOB);"
        "CREATE TABLE sources(edit INTEGER, revision INTEGER, parameter TEXT, name TEXT NOT NULL,"
        " hash TEXT NOT NULL, place TEXT NOT NULL, PRIMARY KEY(edit, revision, parameter))"
        " WITHOUT ROWID;");
    PartStore::make_table(database);
}

/// Those that version 2 added.
void make_record_tables(const Database& database) {
    database.run(
        "CREATE TABLE chain(number INTEGER PRIMARY KEY, time TEXT NOT NULL, kind TEXT NOT NULL,"
        " subject TEXT NOT NULL, author TEXT NOT NULL, version TEXT NOT NULL,"
        " content TEXT NOT NULL, hash TEXT NOT NULL);"
        "CREATE TABLE verdicts(id INTEGER PRIMARY KEY, hash TEXT NOT NULL UNIQUE,"
        " time TEXT NOT NULL, content BLOB NOT NULL);");
    database.run("PRAGMA user_version = " + std::to_string(kVersion));
}

void enter_start(const Database& database, const std::string& kind) {
    const std::string id = new_project_id();
    database.prepare("INSERT INTO meta VALUES('project id', ?)").bind(0, id).step();
    append_entry(database, {.kind = kind,
                            .subject = "project",
                            .author = "",
                            .facts = {{"project", id}},
                            .rows = all_row_digests(database),
                            .gone = {}});
}

}  // namespace

void make_tables(const Database& database) {
    make_first_tables(database);
    database.run(
        "INSERT INTO states VALUES(0, 0, 0, 0, 0, 0);"
        "INSERT INTO meta VALUES('current', 0);");
    const std::string program = version();
    database.prepare("INSERT INTO meta VALUES('written by', ?)").bind(0, program).step();
    database.run("PRAGMA application_id = " + std::to_string(kApplication));
    make_record_tables(database);
    enter_start(database, "new");
}

bool lacks_record(const Database& database) {
    return database.number("PRAGMA user_version") < 2;
}

void begin_record(const Database& database) {
    make_record_tables(database);
    enter_start(database, "found");
}

void check_version(const Database& database) {
    const auto stored = database.number("PRAGMA user_version");
    if (database.number("PRAGMA application_id") != kApplication || stored < 1)
        throw InvalidInput(database.name() + " is not a vesselbench project");
    if (stored > kVersion)
        throw InvalidInput(database.name() + " is a project of version " + std::to_string(stored) +
                           ", written by vesselbench " + writer_of(database) +
                           "  ; this vesselbench, " + version() + ", reads up to version " +
                           std::to_string(kVersion) + ": use the newer program");
}

void check_tables(const Database& database) {
    const Database own("", OpenMode::Temporary);
    make_first_tables(own);
    if (!lacks_record(database)) make_record_tables(own);
    const std::vector<std::string> ours = contents_of(own), found = contents_of(database);
    if (found == ours) return;
    for (const std::string& content : found)
        if (std::ranges::count(ours, content) == 0)
            throw InvalidInput(database.name() +
                               " was not written by vesselbench: it contains the foreign " +
                               shortened(printable(content), 60) + "; use a copy of it");
    throw InvalidInput(database.name() + " is damaged: it lacks tables; use a copy of it");
}

}  // namespace vesselbench
