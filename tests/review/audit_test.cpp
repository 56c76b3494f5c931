#include "workbench/review/audit.h"

#include <algorithm>
#include <filesystem>

#include <catch2/catch.hpp>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/whole_file.h"
#include "tests/review/reviewed_session.h"
#include "tests/session/small_operations.h"
#include "tests/session/sphere_session.h"
#include "tests/support/shapes.h"
#include "workbench/project/database.h"
#include "workbench/project/project.h"
#include "workbench/project/utc_time.h"
#include "workbench/review/audit_texts.h"
#include "workbench/review/verdict_import.h"
#include "workbench/review/witness.h"

using namespace vesselbench;
using namespace vesselbench::test;
using Catch::Matchers::Contains;

namespace {

Audit audited(const std::string& project, const std::vector<std::string>& against = {},
              bool replay = false) {
    return audit({.project = project,
                  .against = {against.begin(), against.end()},
                  .replay = replay,
                  .find = find_test_operation,
                  .worker = test_worker()});
}

std::vector<std::string> codes(const Audit& audit) {
    std::vector<std::string> found;
    for (const Diagnostic& finding : audit.findings) found.push_back(finding.code);
    return found;
}

bool says(const std::vector<std::string>& texts, const std::string& part) {
    return std::ranges::any_of(
        texts, [&](const std::string& text) { return text.find(part) != std::string::npos; });
}

/// What a forger with the program's knowledge does: other facts, and every later hash anew.
void rewrite(const std::string& project, std::int64_t from) {
    const Database database(project, OpenMode::Write);
    std::vector<ChainEntry> entries = read_chain(database);
    std::string earlier = chain_start();
    for (ChainEntry& entry : entries) {
        if (entry.number == from) entry.author = "Eve";
        if (entry.number >= from) entry.hash = link_of(earlier, entry);
        earlier = entry.hash;
        database.prepare("UPDATE chain SET author = ?, hash = ? WHERE number = ?")
            .bind(0, entry.author)
            .bind(1, entry.hash)
            .bind(2, entry.number)
            .step();
    }
    database.prepare("UPDATE meta SET value = ? WHERE name = 'chain head'").bind(0, earlier).step();
}

}  // namespace

SCENARIO("An audit verifies a project and says what it cannot verify", "[review][audit]") {
    const std::string project = reviewed_project();
    const Audit made = audited(project);
    CHECK(codes(made).empty());
    CHECK(says(made.verified, "7 entries"));
    CHECK(says(made.unverified, "--replay"));
    CHECK(says(made.unverified, "--against"));
    CHECK(says(made.unverified, "nothing is signed"));
    CHECK(made.statement["operators"] == std::vector<std::string>{"Ada"});
    CHECK(made.statement["edits"].size() == 3);
    CHECK(made.statement["edits"][1]["accuracy"]["largest_deviation_mm"].get<double>() ==
          Approx(0.5).epsilon(0.2));
    CHECK(entry_words(made.record.entries.at(1)) == "make-sphere (source)");
    THEN("it replays if asked to") {
        const Audit replayed = audited(project, {}, true);
        CHECK(codes(replayed).empty());
        CHECK(says(replayed.verified, "3 edits of the current state give their stored result"));
        CHECK_FALSE(says(replayed.unverified, "--replay"));
    }
    THEN("it may be read beside a writer, and changes nothing") {
        Session writer = Session::open(project, options());
        const std::string head = writer.project().record_head();
        CHECK(codes(audited(project)).empty());
        CHECK(writer.project().record_head() == head);
    }
    THEN("an altered row is found, wherever it is") {
        Database(project, OpenMode::Write)
            .run("UPDATE edits SET operation = 'scale' WHERE edit = 2");
        CHECK(codes(audited(project)).front() == "record-row-altered");
    }
    THEN("rows that cannot be read any more are findings, too") {
        Database(project, OpenMode::Write).run("UPDATE edits SET given = x'00' WHERE edit = 2");
        CHECK(codes(audited(project)).back() == "record-unreadable");
        CHECK(audited(project).statement.is_null());
    }
    THEN("what is no project is bad input") {
        const std::string text = temporary_folder() + "/text.vbench";
        write_file(text, "text");
        CHECK_THROWS_AS(audited(text), InvalidInput);
        CHECK_THROWS_AS(audited(temporary_folder() + "/none.vbench"), IoError);
    }
}

SCENARIO("A reviewer's file convicts a record that was rewritten after it", "[review][audit]") {
    const std::string project = reviewed_project();
    std::string early, late;
    {
        Session session = Session::open(project, options());
        early = save_verdicts(project, verdicts_on(session, "A. Kern", Verdict::Accept, utc_now()));
        session.apply("bump", {{"at", kTop}, {"reach", 3.0}, {"height", 0.1}});
        late = save_verdicts(project, verdicts_on(session, "B. Roth", Verdict::Accept, utc_now()));
    }
    const Audit good = audited(project, {early, late});
    CHECK(codes(good).empty());
    CHECK(says(good.verified, "A. Kern saw the record up to entry 7"));
    WHEN("the record is rewritten from its last edit on") {
        rewrite(project, 8);
        CHECK(codes(audited(project)).empty());  // by itself it is sound
        const Audit bad = audited(project, {early, late});
        CHECK(codes(bad) == std::vector<std::string>{"record-rewritten"});
        CHECK(bad.findings[0].words.at("reviewer") == "B. Roth");
        CHECK(bad.findings[0].words.at("where") == "between entry 8 and entry 9");
    }
    WHEN("it is rewritten from the start") {
        rewrite(project, 2);
        CHECK(codes(audited(project, {early, late})) ==
              std::vector<std::string>{"record-rewritten", "record-rewritten"});
    }
    WHEN("the verdicts are in the project, they convict it as well") {
        {
            Session session = Session::open(project, options());
            import_verdicts(session, early);
        }
        CHECK(codes(audited(project)).empty());
        rewrite(project, 3);
        CHECK(codes(audited(project)) == std::vector<std::string>{"record-rewritten"});
    }
    WHEN("the record is begun anew") {
        Database(project, OpenMode::Write)
            .run(
                "DROP TABLE chain; DROP TABLE verdicts; PRAGMA user_version = 1;"
                "DELETE FROM meta WHERE name IN ('project id', 'chain head')");
        static_cast<void>(Session::open(project, options()));
        const Audit bad = audited(project, {early});
        CHECK(codes(bad) == std::vector<std::string>{"record-other-project"});
        CHECK(says(bad.unverified, "the record begins with what was found"));
    }
}

SCENARIO("A line of a lab book, or an older copy, finds an end that was cut off",
         "[review][audit]") {
    const std::string project = reviewed_project(),
                      copy = std::filesystem::path(project).parent_path() / "copy.vbench";
    {
        Session session = Session::open(project, options());
        import_verdicts(session,
                        save_verdicts(project, verdicts_on(session, "A. Kern", Verdict::Reject)));
    }
    std::filesystem::copy_file(project, copy);
    const Audit before = audited(project);
    const std::string line = witness_line(before.record, "2026-01-01T00:00:00Z");
    CHECK_THAT(line, Contains("vesselbench-witness project=") && Contains("entries=8") &&
                         Contains("head=" + before.record.entries.back().hash));
    const auto codes_against = [&](const std::string& witness) {
        return codes(audited(project, {witness}));
    };
    const std::string book = project + ".txt";
    write_file(book, "page 7\nJan 1, vessel of case 7: " + line + "\n");
    for (const std::string& witness : {line, book, copy}) {
        CHECK(codes_against(witness).empty());
        CHECK(says(audited(project, {witness}).verified, "saw the record up to entry 8"));
    }
    THEN("sixteen digits of the head do, fewer do not") {
        const std::size_t head = line.find("head=") + 5;
        CHECK(codes_against(line.substr(0, head + 16) + line.substr(head + 64)).empty());
        CHECK_THROWS_WITH(codes_against(line.substr(0, head + 15) + line.substr(head + 64)),
                          Contains("at least 16 digits"));
        CHECK_THROWS_AS(codes_against("vesselbench-witness of nothing"), InvalidInput);
    }
    WHEN("the last entry is cut off with what it recorded, and the head is written again") {
        Database(project, OpenMode::Write)
            .run(
                "DELETE FROM verdicts; DELETE FROM chain WHERE number = 8; UPDATE meta SET value ="
                " (SELECT hash FROM chain WHERE number = 7) WHERE name = 'chain head'");
        CHECK(codes(audited(project)).empty());  // by itself it is sound
        for (const std::string& witness : {line, book, copy}) {
            const Audit bad = audited(project, {witness});
            CHECK(codes(bad) == std::vector<std::string>{"record-cut-off"});
            CHECK(bad.findings.at(0).words.at("number") == "8");
        }
        THEN("it stays so when the record has grown again") {
            {
                Session session = Session::open(project, options());
                session.undo();
            }
            for (const std::string& witness : {line, book, copy})
                CHECK(codes_against(witness) == std::vector<std::string>{"record-rewritten"});
            CHECK(audited(project, {copy}).findings.at(0).words.at("where") == "after entry 7");
        }
    }
    WHEN("it is rewritten, the copy says from where on") {
        rewrite(project, 5);
        CHECK(audited(project, {line}).findings.at(0).words.at("file") == "the line");
        CHECK(audited(project, {copy}).findings.at(0).words.at("where") == "after entry 4");
    }
    WHEN("the copy contradicts its own record, it is no witness") {
        Database(copy, OpenMode::Write).run("UPDATE edits SET author = 'Eve'");
        CHECK_THROWS_WITH(codes_against(copy), Contains("copy.vbench is no witness"));
    }
}

SCENARIO("Texts of a project carry no script into the record's page", "[review][audit]") {
    const std::string project = reviewed_project();
    {
        Session session = Session::open(project, options());
        session.set_note({2, 1}, "<script>alert(1)</script>\"><img src=x onerror=alert(1)>");
        VerdictFile verdicts = verdicts_on(session, "<b>Eve</b>", Verdict::Accept);
        verdicts.role = "{{{statement}}}";
        import_verdicts(session, save_verdicts(project, verdicts));
    }
    const Audit made = audited(project);
    const std::string page = audit_html(made);
    CHECK_THAT(page, !Contains("<script") && !Contains("<img") && !Contains("<b>Eve"));
    CHECK_THAT(page, Contains("&lt;script&gt;") && Contains("&lt;b&gt;Eve"));
    CHECK_THAT(page, Contains("default-src 'none'"));
    CHECK_THAT(page, Contains("make-sphere") && Contains("Verified."));
    CHECK(audit_json(made)["verified"] == true);
    CHECK(audit_json(made)["entries"].size() == made.record.entries.size());
}
