#include <algorithm>
#include <filesystem>
#include <fstream>
#include <random>

#include <catch2/catch.hpp>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/whole_file.h"
#include "tests/session/sphere_session.h"
#include "tests/support/shapes.h"
#include "workbench/project/part_store.h"
#include "workbench/project/record_check.h"
#include "workbench/session/compaction.h"
#include "workbench/session/export_record.h"
#include "workbench/session/stored_spots.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

Arguments bump_of(double height) {
    return {{"at", kTop}, {"reach", 4.0}, {"height", height}};
}

/// A project with entries and rows of every kind.
std::string full_project() {
    const std::string folder = temporary_folder(), file = folder + "/full.vbench";
    Session session = Session::create(file, options());
    session.apply("make-sphere", {{"levels", std::int64_t{2}}});
    const EditId bump = session.apply("bump", bump_of(0.5), {.note = "a dent"}).edit.edit.id;
    session.apply("bump", bump_of(0.25));
    session.change_edit(bump, bump_of(0.75));
    static_cast<void>(session.scene());
    session.set_note({bump, 2}, "another height");
    session.undo();
    session.redo();
    session.remove_edit(bump);
    store_spots(file, {{.name = "top", .point = kTop, .normal = Vec3::UnitZ()}});
    write_file(folder + "/model.stl", "solid");
    record_export(session, folder + "/model.stl", "cfd");
    session.add_verdicts({R"({"a":"b"})", "signature"}, std::string(64, 'a'),
                         {.kind = "verdicts", .subject = "A. Kern", .facts = "{}"});
    return file;
}

RecordCheck checked(const std::string& file) {
    return ProjectFile::open_to_read(file, "a test").check_record();
}

std::vector<std::string> codes(const RecordCheck& check) {
    std::vector<std::string> found;
    for (const Diagnostic& finding : check.findings) found.push_back(finding.code);
    return found;
}

std::vector<std::string> kinds(const RecordCheck& check) {
    std::vector<std::string> found;
    for (const ChainEntry& entry : check.entries) found.push_back(entry.kind);
    return found;
}

/// SHA-256 of what the blobs hold: a blob has bytes that say nothing.
std::vector<std::string> contents(const Database& database) {
    std::vector<std::string> found;
    PartStore store(database, 0);
    try {
        for (auto row = database.prepare("SELECT id FROM blobs"); row.step();)
            found.push_back(content_hash(store.load(row.integer(0))));
    } catch (const InvalidInput&) {
        return {};
    }
    return found;
}

/// What a project was before it had a record.
void make_old(const std::string& file) {
    const Database database(file, OpenMode::Write);
    database.run(
        "DROP TABLE chain; DROP TABLE verdicts; PRAGMA user_version = 1;"
        "DELETE FROM meta WHERE name IN ('project id', 'chain head')");
}

/// A random change of what is stored, by SQL.
class Vandal {
public:
    Vandal(const Database& database, unsigned seed) : database_(database), random_(seed) {}

    /// \return what was done; empty: it could not be
    std::string change() {
        const std::vector<std::string> tables = {"meta",    "edits", "states",   "results",
                                                 "sources", "blobs", "verdicts", "chain"};
        const std::string table = tables[below(tables.size())];
        const std::vector<std::int64_t> rows = numbers_of(table);
        if (rows.empty()) return "";
        try {
            switch (below(8)) {
                case 0:
                    return remove(table, rows);
                case 1:
                    return exchange(table, rows);
                default:
                    return alter(table, rows);
            }
        } catch (const IoError&) {  // against a constraint
            return "";
        }
    }

private:
    std::size_t below(std::size_t end) {
        return std::uniform_int_distribution<std::size_t>(0, end - 1)(random_);
    }

    /// The rows by their place in the order of the key.
    std::vector<std::int64_t> numbers_of(const std::string& table) {
        std::vector<std::int64_t> numbers(
            static_cast<std::size_t>(database_.number("SELECT count(*) FROM " + table)));
        for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = static_cast<std::int64_t>(i);
        return numbers;
    }

    std::vector<std::string> columns_of(const std::string& table) {
        std::vector<std::string> names;
        for (auto row = database_.prepare("SELECT name FROM pragma_table_info('" + table + "')");
             row.step();)
            names.push_back(row.text(0));
        return names;
    }

    static std::string key_of(const std::string& table) {
        return table == "meta"      ? "(name)"
               : table == "edits"   ? "(edit, revision)"
               : table == "sources" ? "(edit, revision, parameter)"
               : table == "chain"   ? "(number)"
                                    : "(id)";
    }

    static std::string row_at(const std::string& table, std::int64_t number) {
        const std::string key = key_of(table), keys = key.substr(1, key.size() - 2);
        return key + " = (SELECT " + keys + " FROM " + table + " ORDER BY " + keys +
               " LIMIT 1 OFFSET " + std::to_string(number) + ")";
    }

    std::string remove(const std::string& table, const std::vector<std::int64_t>& rows) {
        const std::string where = row_at(table, rows[below(rows.size())]);
        database_.run("DELETE FROM " + table + " WHERE " + where);
        return "deleted from " + table + " " + where;
    }

    std::string value(const std::string& table, const std::string& column, std::int64_t number) {
        Statement row = database_.prepare("SELECT quote(" + column + ") FROM " + table + " WHERE " +
                                          row_at(table, number));
        row.step();
        return row.text(0);
    }

    void set(const std::string& table, const std::string& column, std::int64_t number,
             const std::string& literal) {
        database_.run("UPDATE " + table + " SET " + column + " = " + literal + " WHERE " +
                      row_at(table, number));
    }

    std::string exchange(const std::string& table, const std::vector<std::int64_t>& rows) {
        const std::vector<std::string> columns = columns_of(table);
        const std::string column = columns[below(columns.size())];
        const std::int64_t one = rows[below(rows.size())], other = rows[below(rows.size())];
        const std::string first = value(table, column, one), second = value(table, column, other);
        if (first == second || key_of(table).find(column) != std::string::npos) return "";
        if (column == "hash" && table != "chain") set(table, column, one, "'none'");
        set(table, column, other, first);
        set(table, column, one, second);
        return "exchanged " + column + " in " + table + ": " + first.substr(0, 80) + " and " +
               second.substr(0, 80);
    }

    std::string flipped(std::string bytes) {
        if (bytes.empty()) return "x";
        char& byte = bytes[below(bytes.size())];
        byte = static_cast<char>(byte ^ (1 << below(8)));
        return bytes;
    }

    std::string alter(const std::string& table, const std::vector<std::int64_t>& rows) {
        const std::vector<std::string> columns = columns_of(table);
        const std::string column = columns[below(columns.size())];
        const std::int64_t number = rows[below(rows.size())];
        const std::string where = row_at(table, number), text = value(table, column, number);
        Statement old =
            database_.prepare("SELECT " + column + " FROM " + table + " WHERE " + where);
        old.step();
        const std::string bytes = flipped(old.text(0));
        const std::int64_t integer = old.integer(0) + 1 + static_cast<std::int64_t>(below(3));
        const bool is_blob = text.starts_with("X'"), is_text = text.starts_with("'");
        const bool is_null = text == "NULL";
        old = database_.prepare("SELECT 1");  // the row is not read any more
        Statement update =
            database_.prepare("UPDATE " + table + " SET " + column + " = ? WHERE " + where);
        if (is_blob)
            update.bind(0, std::as_bytes(std::span(bytes)));
        else if (is_text || is_null)
            update.bind(0, bytes);
        else
            update.bind(0, integer);
        update.step();
        return "altered " + column + " of " + table + " " + std::to_string(number) + ", " +
               text.substr(0, 80);
    }

    const Database& database_;
    std::mt19937 random_;
};

}  // namespace

SCENARIO("Every change of a project is an entry of its record", "[session][record]") {
    const std::string file = full_project();
    const RecordCheck check = checked(file);
    CHECK(codes(check).empty());
    CHECK(kinds(check) == std::vector<std::string>{"new", "edit", "result", "edit", "result",
                                                   "edit", "result", "change", "result", "result",
                                                   "note", "undo", "redo", "remove", "spots",
                                                   "export", "verdicts"});
    CHECK(check.project.size() == 36);
    CHECK(check.entries[3].subject == "edit 2.1");
    CHECK(check.entries[3].author == "Ada");
    CHECK(check.entries[10].content.find("another height") != std::string::npos);
    CHECK(check.entries[15].subject == "model.stl");
    THEN("compacting is one, too") {
        static_cast<void>(compact_project(file));
        CHECK(codes(checked(file)).empty());
        CHECK(kinds(checked(file)).back() == "compact");
    }
    THEN("a copy has the same record and id, which stay good as it grows") {
        const std::string copy = temporary_folder() + "/copy.vbench";
        {
            Session session = Session::open(file, options());
            session.save_as(copy);
            Session other = Session::open(copy, options());
            CHECK(other.project().id() == session.project().id());
            CHECK(other.project().record_head() == session.project().record_head());
            other.apply("bump", bump_of(1.0));
        }
        CHECK(codes(checked(copy)).empty());
        CHECK(checked(copy).entries.size() ==
              check.entries.size() + 3);  // one more edit was pending
    }
    THEN("another project has another id") {
        CHECK(checked(full_project()).project != check.project);
    }
    THEN("a text that is stored again as it is makes no entry") {
        store_spots(file, {{.name = "top", .point = kTop, .normal = Vec3::UnitZ()}});
        CHECK(checked(file).entries.size() == check.entries.size());
    }
}

SCENARIO("What fails is not entered", "[session][record]") {
    const std::string file = full_project();
    Session session = Session::open(file, options());
    const std::string head = session.project().record_head();
    CHECK_THROWS(session.apply("bump", {{"at", Vec3(1e5, 0, 0)}, {"reach", 1.0}, {"height", 1.0}}));
    CHECK(session.project().record_head() == head);
    CHECK_FALSE(session.add_verdicts({R"({"a":"b"})", "signature"}, std::string(64, 'a'),
                                     {.kind = "verdicts", .subject = "A. Kern", .facts = "{}"}));
    CHECK(session.project().record_head() == head);
}

SCENARIO("Random changes of a project contradict its record", "[session][record]") {
    const std::string file = full_project();
    const Database database(file, OpenMode::Write);
    REQUIRE(check_record(database).findings.empty());
    const std::vector<std::string> before = contents(database);
    Vandal vandal(database, 35);
    int changes = 0, missed = 0;
    while (changes < 1000) {
        const Transaction undone(database);
        const std::string what = vandal.change();
        if (what.empty() ||
            (what.starts_with("altered content of blobs") && contents(database) == before))
            continue;
        ++changes;
        if (!check_record(database).findings.empty()) continue;
        ++missed;
        UNSCOPED_INFO(what);
    }
    CHECK(missed == 0);
    CHECK(check_record(database).findings.empty());
}

SCENARIO("Random bytes of a project's file are found where they change what it says",
         "[session][record]") {
    const std::string file = full_project();
    const std::string good = file_content(file);
    const auto content = [](const std::string& path) {
        const Database database(path, OpenMode::Frozen);
        RowDigests all = all_row_digests(database);
        for (const ChainEntry& entry : read_chain(database))
            all["chain " + entry.hash] = link_of("", entry);
        PartStore store(database, 0);
        for (auto row = database.prepare("SELECT id FROM blobs"); row.step();)
            all["content " + row.text(0)] = content_hash(store.load(row.integer(0)));
        return all;
    };
    const RowDigests before = content(file);
    std::mt19937 random(36);
    const std::string path = temporary_folder() + "/bytes.vbench";
    int missed = 0, harmless = 0;
    for (int i = 0; i < 300; ++i) {
        std::string bad = good;
        char& byte = bad[std::uniform_int_distribution<std::size_t>(0, bad.size() - 1)(random)];
        byte = static_cast<char>(byte ^ (1 << (i % 8)));
        std::ofstream(path, std::ios::binary) << bad;
        bool found = false, same = false;
        try {
            found = !checked(path).findings.empty();
            same = !found && content(path) == before;
        } catch (const std::exception&) {
            found = true;
        }
        harmless += same ? 1 : 0;
        missed += found || same ? 0 : 1;
    }
    CHECK(missed == 0);
    CHECK(harmless < 280);  // most of so small a file is unused
}

SCENARIO("Entries that were deleted, added, moved or exchanged are found", "[session][record]") {
    const std::string file = full_project();
    const Database database(file, OpenMode::Write);
    const auto found_after = [&](const std::string& sql) {
        const Transaction undone(database);
        database.run(sql);
        return codes(check_record(database));
    };
    using Codes = std::vector<std::string>;
    const auto holds = [](const Codes& found, const char* code) {
        return std::ranges::count(found, code) > 0;
    };
    CHECK(holds(found_after("DELETE FROM chain WHERE number = 5"), "record-entry-missing"));
    CHECK(holds(found_after("DELETE FROM chain WHERE number = 1"), "record-entry-missing"));
    CHECK(holds(found_after("DELETE FROM chain WHERE number > 15"), "record-head-altered"));
    CHECK(found_after("DELETE FROM chain") == Codes{"record-missing"});
    CHECK(holds(found_after("INSERT INTO chain SELECT 18, time, kind, subject, author, version,"
                            " content, hash FROM chain WHERE number = 16"),
                "record-entry-altered"));
    CHECK(holds(found_after("UPDATE chain SET number = 100 WHERE number = 4;"
                            "UPDATE chain SET number = 4 WHERE number = 5;"
                            "UPDATE chain SET number = 5 WHERE number = 100"),
                "record-entry-altered"));
    CHECK(holds(found_after("UPDATE chain SET author = 'Eve' WHERE number = 4"),
                "record-entry-altered"));
    CHECK(
        holds(found_after("UPDATE edits SET author = 'Eve' WHERE edit = 2"), "record-row-altered"));
    CHECK(holds(found_after("DELETE FROM results WHERE id = 2"), "record-row-missing"));
    CHECK(holds(found_after("INSERT INTO meta VALUES('flow', '{}')"), "record-row-unknown"));
    CHECK(holds(found_after("UPDATE blobs SET content = NULL WHERE id = 1"), "record-row-altered"));
}

SCENARIO("A project of an earlier version gets a record of what was found in it",
         "[session][record]") {
    const std::string file = full_project();
    make_old(file);
    WHEN("it is only looked at") {
        SessionOptions looking = options();
        looking.only_reads = true;
        Session session = Session::open(file, looking);
        CHECK(session.project().id().empty());
        CHECK(session.project().record_head().empty());
        CHECK(session.log().size() == 2);
        THEN("it has none") {
            CHECK(codes(checked(file)) == std::vector<std::string>{"record-missing"});
        }
    }
    WHEN("it is opened") {
        {
            Session session = Session::open(file, options());
            CHECK(session.log().size() == 2);
            for (const ReplayEntry& entry : session.replay()) CHECK(entry.differences.empty());
            session.undo();
            CHECK(session.log().size() == 3);
            CHECK(session.project().id().size() == 36);
        }
        THEN("the record begins with what was found") {
            CHECK(codes(checked(file)).empty());
            CHECK(kinds(checked(file)) == std::vector<std::string>{"found", "undo"});
        }
    }
    WHEN("a text is stored in it first") {
        store_spots(file, {{.name = "other", .point = kTop, .normal = Vec3::UnitZ()}});
        CHECK(codes(checked(file)).empty());
        CHECK(kinds(checked(file)) == std::vector<std::string>{"found", "spots"});
    }
}
