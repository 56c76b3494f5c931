#include <filesystem>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "geometry/formats/surface_file.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/whole_file.h"
#include "tests/review/reviewed_session.h"
#include "tests/support/program.h"
#include "tests/support/shapes.h"
#include "tests/support/signing.h"
#include "workbench/operations/table.h"
#include "workbench/project/chain.h"
#include "workbench/project/database.h"
#include "workbench/project/project.h"
#include "workbench/project/row_digests.h"
#include "workbench/project/stored_text.h"
#include "workbench/review/retired_keys.h"
#include "workbench/review/signing_key.h"
#include "workbench/review/verdict_import.h"
#include "workbench/session/stored_texts.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

Session opened(const std::string& project) {
    return Session::open(project, {.find = find_operation});
}

void change(const std::string& project, const std::string& sql) {
    Database(project, OpenMode::Write).run(sql);
}

/// What somebody does who knows the program: the record says what the rows are now, and every hash
/// follows from the one before it.
void make_sound(const std::string& project) {
    const Database database(project, OpenMode::Write);
    std::vector<ChainEntry> entries = read_chain(database);
    const RowDigests stored = all_row_digests(database);
    std::map<std::string, std::size_t> last;  // entry that wrote a row
    std::vector<nlohmann::json> contents;
    for (std::size_t i = 0; i < entries.size(); ++i) {
        contents.push_back(nlohmann::json::parse(entries[i].content));
        for (const auto& [key, digest] : contents[i]["rows"].items()) last[key] = i;
    }
    for (std::size_t i = 0; i < entries.size(); ++i)
        for (const auto& [key, writer] : last)
            if (!stored.contains(key))
                contents[i]["rows"].erase(key);
            else if (writer == i)
                contents[i]["rows"][key] = stored.at(key);
    for (const auto& [key, digest] : stored)
        if (!last.contains(key)) contents.back()["rows"][key] = digest;
    database.run("DELETE FROM chain");
    std::string earlier = chain_start();
    for (std::size_t i = 0; i < entries.size(); ++i) {
        ChainEntry& entry = entries[i];
        entry.number = static_cast<std::int64_t>(i) + 1;
        entry.content = contents[i].dump();
        entry.hash = earlier = link_of(earlier, entry);
        database.prepare("INSERT INTO chain VALUES(?, ?, ?, ?, ?, ?, ?, ?)")
            .bind(0, entry.number)
            .bind(1, entry.time)
            .bind(2, entry.kind)
            .bind(3, entry.subject)
            .bind(4, entry.author)
            .bind(5, entry.version)
            .bind(6, entry.content)
            .bind(7, entry.hash)
            .step();
    }
    database.prepare("UPDATE meta SET value = ? WHERE name = 'chain head'").bind(0, earlier).step();
}

/// Replaces what a stored file of verdicts says. \param id of its row
void rewrite_verdicts(const std::string& project, int id, const std::string& from,
                      const std::string& to) {
    const Database database(project, OpenMode::Write);
    std::string text;
    {
        Statement row = database.prepare("SELECT content FROM verdicts WHERE id = ?");
        row.bind(0, std::int64_t{id}).step();
        text = unpack_text(row.blob(0));
    }
    REQUIRE(text.find(from) != std::string::npos);
    for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
        text.replace(at, from.size(), to);
    const Bytes packed = pack_text(text);
    database.prepare("UPDATE verdicts SET content = ? WHERE id = ?")
        .bind(0, packed)
        .bind(1, std::int64_t{id})
        .step();
}

/// Projects of which two reviewers have to accept the model, and the reviewers' keys.
class Clinic {
public:
    Clinic() {
        write_surface(icosphere(10.0, 2), folder_ + "/ball.stl");
        REQUIRE(run({"new", path("short"), folder_ + "/ball.stl", "--units", "mm"}).exit_code == 0);
        REQUIRE(run({"apply", path("short"), "smooth", "--author", "Ada"}).exit_code == 0);
        store_text(path("short"), StoredText::Acceptance, R"({"cfd": 2})");
        says("short", "A. Kern", Verdict::Accept, kern);
        copy("short", "rejected");
        says("rejected", "C. Lang", Verdict::Accept, lang);
        says("rejected", "B. Roth", Verdict::Reject, roth);
        copy("rejected", "accepted");
        says("accepted", "B. Roth", Verdict::Accept, roth);
        for (const char* name : {"short", "rejected", "accepted"})
            witnesses_[name] = run({"audit", path(name), "--witness"}).out;
    }

    /// \param name of one of the projects, or of the copy that is worked on
    [[nodiscard]] std::string path(const std::string& name) const {
        return folder_ + "/" + name + ".vbench";
    }

    [[nodiscard]] std::string model() const { return folder_ + "/model.stl"; }

    /// A copy of a project on which somebody works.
    std::string begin(const std::string& from) {
        std::filesystem::remove(model());
        signers = allowed_signers(allowed_line("kern", kern) + allowed_line("lang", lang) +
                                  allowed_line("roth", roth));
        for (const char* suffix : {"-wal", "-shm"}) std::filesystem::remove(path("copy") + suffix);
        copy(from, "copy");
        witness_ = witnesses_.at(from);
        witness_.pop_back();  // the line's end
        return path("copy");
    }

    /// What the reviewer's page would save, and what became of it.
    void says(
        const std::string& project, const std::string& reviewer, Verdict verdict,
        const std::string& key,
        const std::function<void(VerdictFile&)>& alter = [](VerdictFile&) {}) {
        Session session = opened(path(project));
        VerdictFile file = verdicts_on(session, reviewer, verdict);
        alter(file);
        last_file = save_verdicts(path(project), file);
        if (!key.empty()) sign(last_file, key);
        import_verdicts(session, last_file);
    }

    /// The same in the copy; what the program refuses to enter is not in it.
    void tries(
        const std::string& reviewer, Verdict verdict, const std::string& key,
        const std::function<void(VerdictFile&)>& alter = [](VerdictFile&) {}) {
        try {
            says("copy", reviewer, verdict, key, alter);
        } catch (const InvalidInput&) {
            return;
        }
    }

    [[nodiscard]] ProgramRun exported(std::vector<std::string> more) const {
        std::vector<std::string> command = {"export",     path("copy"), model(), "--require",
                                            "accepted=2", "--signers",  signers};
        if (!more.empty() && more.front() == "--without") {
            command = {"export", path("copy"), model()};
            more.erase(more.begin());
        }
        command.insert(command.end(), more.begin(), more.end());
        return run(command);
    }

    [[nodiscard]] ProgramRun audited() const {
        return run({"audit", path("copy"), "--against", witness_, "--signers", signers});
    }

    std::string signers;
    const std::string kern = new_signing_key(), lang = new_signing_key(), roth = new_signing_key(),
                      eve = new_signing_key();
    std::string last_file;

private:
    void copy(const std::string& from, const std::string& to) const {
        std::filesystem::copy_file(path(from), path(to),
                                   std::filesystem::copy_options::overwrite_existing);
    }

    std::string folder_ = temporary_folder();
    std::map<std::string, std::string> witnesses_;
    std::string witness_;
};

/// A way to a model that nobody accepted.
struct Way {
    const char* name;
    const char* from;  ///< project that it begins with
    std::function<void(Clinic&, const std::string& project)> act;
    std::vector<std::string> more = {};  ///< arguments of the export; "--without" first: no others
};

/// By SQL: rows that are not what the record says.
Way by_sql(const char* name, const char* from, const char* sql,
           std::vector<std::string> more = {}) {
    return {name, from, [sql](Clinic&, const std::string& project) { change(project, sql); },
            std::move(more)};
}

/// By SQL, and with the record made sound.
Way by_forgery(const char* name, const char* from, const char* sql,
               std::vector<std::string> more = {}) {
    return {name, from,
            [sql](Clinic&, const std::string& project) {
                change(project, sql);
                make_sound(project);
            },
            std::move(more)};
}

/// Other contents in the places of parts of one size, without and with their digests.
constexpr const char* kExchangeContents =
    "CREATE TEMP TABLE two AS SELECT id, content, hash FROM blobs ORDER BY length(content) DESC"
    " LIMIT 2;"
    "UPDATE blobs SET content = (SELECT content FROM two WHERE two.id <> blobs.id)"
    " WHERE id IN (SELECT id FROM two)";
constexpr const char* kExchangeParts =
    "CREATE TEMP TABLE two AS SELECT id, content, hash FROM blobs ORDER BY length(content) DESC"
    " LIMIT 2;"
    "UPDATE blobs SET hash = 'none ' || id WHERE id IN (SELECT id FROM two);"
    "UPDATE blobs SET content = (SELECT content FROM two WHERE two.id <> blobs.id),"
    " hash = (SELECT hash FROM two WHERE two.id <> blobs.id) WHERE id IN (SELECT id FROM two)";

std::vector<Way> ways_with_the_model() {
    return {
        by_sql("parts exchanged", "accepted", kExchangeContents),
        by_sql("parts exchanged with their digests", "accepted", kExchangeParts),
        by_forgery("parts exchanged with their digests, record rewritten", "accepted",
                   kExchangeParts),
        by_sql("a part's bytes", "accepted",
               "UPDATE blobs SET content = zeroblob(length(content))"),
        by_sql("a part said to be elsewhere", "accepted", "UPDATE blobs SET content = NULL"),
        by_sql("the result of another edit", "accepted",
               "UPDATE results SET scene = (SELECT scene FROM results LIMIT 1)"),
        by_forgery("the result of another edit, record rewritten", "accepted",
                   "UPDATE results SET scene = (SELECT scene FROM results LIMIT 1)"),
        by_sql("other arguments", "accepted",
               "UPDATE edits SET given = (SELECT given FROM edits LIMIT 1)"),
        by_forgery("another operation, record rewritten", "accepted",
                   "UPDATE edits SET operation = 'repair' WHERE edit = 2"),
        by_sql("another author", "accepted", "UPDATE edits SET author = 'Eve'"),
        by_sql("another file as the source", "accepted", "UPDATE sources SET hash = lower(hex(0))"),
        by_sql("an earlier state", "accepted", "UPDATE meta SET value = 1 WHERE name = 'current'"),
        by_sql("another parent of a state", "accepted",
               "UPDATE states SET parent = 0 WHERE id = (SELECT max(id) FROM states)"),
        by_sql("a table beside the program's", "accepted", "CREATE TABLE other(x)"),
        by_sql("a trigger", "accepted",
               "CREATE TRIGGER t AFTER INSERT ON chain BEGIN DELETE FROM verdicts; END"),
    };
}

std::vector<Way> ways_with_the_record() {
    return {
        by_sql("the rejection deleted", "rejected", "DELETE FROM verdicts WHERE id = 3"),
        by_sql("the rejection deleted with its entry", "rejected",
               "DELETE FROM verdicts WHERE id = 3; DELETE FROM chain WHERE number ="
               " (SELECT max(number) FROM chain)"),
        by_sql("the record cut off, and the head written again", "rejected",
               "DELETE FROM meta WHERE name = 'signature ' || (SELECT hash FROM verdicts WHERE"
               " id = 3); DELETE FROM verdicts WHERE id = 3; DELETE FROM chain WHERE number ="
               " (SELECT max(number) FROM chain); UPDATE meta SET value = (SELECT hash FROM chain"
               " ORDER BY number DESC LIMIT 1) WHERE name = 'chain head'"),
        by_forgery("the rejection deleted, record rewritten", "rejected",
                   "DELETE FROM meta WHERE name = 'signature ' || (SELECT hash FROM verdicts WHERE"
                   " id = 3); DELETE FROM verdicts WHERE id = 3; DELETE FROM chain WHERE number ="
                   " (SELECT max(number) FROM chain)"),
        by_sql("an acceptance in place of the rejection", "rejected",
               "UPDATE verdicts SET content = (SELECT content FROM verdicts WHERE id = 1)"
               " WHERE id = 3"),
        {"the rejection made an acceptance, record rewritten", "rejected",
         [](Clinic&, const std::string& project) {
             rewrite_verdicts(project, 3, "\"reject\"", "\"accept\"");
             make_sound(project);
         }},
        {"an acceptance under another name, record rewritten", "short",
         [](Clinic&, const std::string& project) {
             change(project,
                    "INSERT INTO verdicts SELECT 2, 'other', time, content FROM verdicts;"
                    "INSERT INTO meta SELECT 'signature other', value FROM meta"
                    " WHERE name LIKE 'signature %'");
             rewrite_verdicts(project, 2, "A. Kern", "B. Roth");
             make_sound(project);
         }},
        by_sql("the signature of the rejection deleted", "rejected",
               "DELETE FROM meta WHERE name = 'signature ' || (SELECT hash FROM verdicts WHERE"
               " id = 3)"),
        by_sql("a rejection called a note", "rejected",
               "UPDATE chain SET kind = 'note' WHERE kind = 'verdicts'"),
        by_sql("the order of the verdicts", "accepted", "UPDATE verdicts SET id = 10 - id"),
        by_sql("another time of entering", "accepted",
               "UPDATE verdicts SET time = '2019-01-01T00:00:00Z'"),
        by_sql("no required reviewers", "short", "DELETE FROM meta WHERE name = 'acceptance'",
               {"--without"}),
        by_sql("fewer required reviewers", "short",
               "UPDATE meta SET value = '{\"cfd\":1}' WHERE name = 'acceptance'", {"--without"}),
        by_forgery("fewer required reviewers, record rewritten", "short",
                   "UPDATE meta SET value = '{\"cfd\":1}' WHERE name = 'acceptance'",
                   {"--without"}),
        by_sql("no record", "accepted", "DELETE FROM chain"),
        by_sql("a middle entry deleted", "accepted", "DELETE FROM chain WHERE number = 4"),
        by_sql("another project's id", "accepted",
               "UPDATE meta SET value = 'another' WHERE name = 'project id'"),
        by_forgery("another project's id, record rewritten", "accepted",
                   "UPDATE meta SET value = 'another' WHERE name = 'project id'"),
        by_sql("a project of an earlier version", "accepted",
               "DROP TABLE chain; DROP TABLE verdicts; DELETE FROM meta WHERE name IN"
               " ('chain head', 'project id', 'acceptance'); PRAGMA user_version = 1"),
        by_forgery("the record rewritten before the verdicts", "accepted",
                   "UPDATE chain SET author = 'Ada' WHERE number = 2"),
    };
}

std::vector<Way> ways_of_reviewers() {
    const auto says = [](
                          const char* name, const char* from, const char* reviewer, Verdict verdict,
                          const std::string Clinic::*key,
                          std::function<void(VerdictFile&)> alter = [](VerdictFile&) {}) {
        return Way{name, from, [=](Clinic& clinic, const std::string&) {
                       clinic.tries(reviewer, verdict, key == nullptr ? "" : clinic.*key, alter);
                   }};
    };
    using enum Verdict;
    const std::string Clinic::*unsigned_ = nullptr;
    return {
        says("one key under two names", "short", "B. Roth", Accept, &Clinic::kern),
        says("one name with two keys", "short", " a.  KERN", Accept, &Clinic::lang),
        says("a name that is nearly another", "short", "A Kern", Accept, &Clinic::lang),
        says("a name in other letters", "short", "\u0410. Kern", Accept, &Clinic::lang),
        says("a name with what is not seen", "short", "A. Kern\u200b", Accept, &Clinic::lang),
        says("an acceptance that nobody signed", "short", "C. Lang", Accept, unsigned_),
        says("a key that is not allowed", "short", "C. Lang", Accept, &Clinic::eve),
        says("a time that is ahead", "short", "C. Lang", Accept, &Clinic::lang,
             [](VerdictFile& file) { file.written = "2099-01-01T00:00:00Z"; }),
        says("a day that does not exist", "short", "C. Lang", Accept, &Clinic::lang,
             [](VerdictFile& file) { file.written = "2020-02-30T00:00:00Z"; }),
        says("verdicts of another project", "short", "C. Lang", Accept, &Clinic::lang,
             [](VerdictFile& file) { file.project = "another"; }),
        says("verdicts of another record", "short", "C. Lang", Accept, &Clinic::lang,
             [](VerdictFile& file) { file.chain_head = std::string(64, 'a'); }),
        says("verdicts on another result", "short", "C. Lang", Accept, &Clinic::lang,
             [](VerdictFile& file) { file.edits.back().hash = std::string(64, 'a'); }),
        says("some edits accepted only", "short", "C. Lang", Accept, &Clinic::lang,
             [](VerdictFile& file) { file.edits.pop_back(); }),
        says("the whole accepted, no edit", "short", "C. Lang", Accept, &Clinic::lang,
             [](VerdictFile& file) {
                 for (EditVerdict& edit : file.edits) edit.verdict = None;
             }),
        says("unsure is no acceptance", "short", "C. Lang", Unsure, &Clinic::lang),
        says("a rejection taken back unsigned", "rejected", "B. Roth", Accept, unsigned_),
        says("a rejection taken back by another key", "rejected", "B. Roth", Accept, &Clinic::eve),
        says("a rejection taken back by another reviewer", "rejected", "B. Roth", Accept,
             &Clinic::lang),
        says("a rejection that nobody signed", "accepted", "D. Moser", Reject, unsigned_),
        {"a signature for another purpose", "short",
         [](Clinic& clinic, const std::string& project) {
             Session session = opened(project);
             const std::string file =
                 save_verdicts(project, verdicts_on(session, "C. Lang", Verdict::Accept));
             sign(file, clinic.lang, "git");
             CHECK_THROWS_AS(import_verdicts(session, file), InvalidInput);
         }},
        {"a file that was changed after it was signed", "short",
         [](Clinic& clinic, const std::string& project) {
             Session session = opened(project);
             const std::string file =
                 save_verdicts(project, verdicts_on(session, "C. Lang", Verdict::Unsure));
             sign(file, clinic.lang);
             write_file(file, text_of(verdicts_on(session, "C. Lang", Verdict::Accept)));
             CHECK_THROWS_AS(import_verdicts(session, file), InvalidInput);
         }},
        {"a key that had expired", "short",
         [](Clinic& clinic, const std::string&) {
             clinic.tries("C. Lang", Verdict::Accept, clinic.lang);
             clinic.signers =
                 allowed_signers(allowed_line("kern", clinic.kern) +
                                 allowed_line("lang", clinic.lang, "valid-before=\"20200101\""));
         }},
    };
}

/// Retires the key that signed the last file.
void retire_signer(const Clinic& clinic, const std::string& project) {
    Session session = opened(project);
    retire_key(session, key_fingerprint(signing_key(file_content(clinic.last_file + ".sig"))),
               "lost");
}

Way by_command(const char* name, const char* from, std::vector<std::string> command,
               std::vector<std::string> more = {}) {
    return {name, from,
            [command](Clinic&, const std::string& project) {
                std::vector<std::string> whole = command;
                whole.insert(whole.begin() + 1, project);
                REQUIRE(run(whole).exit_code == 0);
            },
            std::move(more)};
}

std::vector<Way> ways_with_keys_and_commands() {
    return {
        {"a retired key signs", "short",
         [](Clinic& clinic, const std::string& project) {
             clinic.tries("C. Lang", Verdict::Unsure, clinic.lang);
             retire_signer(clinic, project);
             clinic.tries("C. Lang", Verdict::Accept, clinic.lang);
         }},
        {"a key retired before it signed, record rewritten", "short",
         [](Clinic& clinic, const std::string& project) {
             clinic.tries("C. Lang", Verdict::Accept, clinic.lang);
             retire_signer(clinic, project);
             change(project,
                    "UPDATE chain SET number = 1000 WHERE number = (SELECT max(number)"
                    " FROM chain WHERE kind = 'verdicts')");
             make_sound(project);
         }},
        {"the rejecting key retired", "rejected",
         [](Clinic& clinic, const std::string& project) {
             clinic.tries("B. Roth", Verdict::Reject, clinic.roth);
             retire_signer(clinic, project);
             clinic.tries("B. Roth", Verdict::Accept, clinic.eve);
         }},
        {"the rejecting key taken out of the allowed ones", "rejected",
         [](Clinic& clinic, const std::string&) {
             clinic.signers = allowed_signers(allowed_line("kern", clinic.kern) +
                                              allowed_line("lang", clinic.lang));
         }},
        by_command("an edit changed", "accepted", {"change", "2", "iterations=3"}),
        by_command("another edit", "accepted", {"apply", "repair"}),
        by_command("a variant that nobody saw", "accepted", {"log"}, {"--variant", "nobody"}),
        by_command("fewer reviewers than the project requires", "short", {"log"},
                   {"--without", "--require", "accepted"}),
    };
}

}  // namespace

SCENARIO("No way leads past the gate but the honest one", "[workbench][review][hostile]") {
    if (!can_sign()) return;
    Clinic clinic;
    const auto passes = [&](const std::vector<std::string>& more) {
        const ProgramRun exported = clinic.exported(more);
        UNSCOPED_INFO(exported.err);
        CHECK(std::filesystem::exists(clinic.model()) == (exported.exit_code == 0));
        return exported.exit_code == 0;
    };
    std::set<std::string> passed;
    std::size_t ways = 0;
    for (const auto& list : {ways_with_the_model(), ways_with_the_record(), ways_of_reviewers(),
                             ways_with_keys_and_commands()})
        for (const Way& way : list) {
            INFO(way.name);
            ++ways;
            way.act(clinic, clinic.begin(way.from));
            if (!passes(way.more)) continue;
            passed.insert(way.name);
            CHECK(clinic.audited().exit_code == 1);
        }
    CHECK(ways >= 43);
    // What no file can prove by itself is found by a witness alone.
    CHECK(passed == std::set<std::string>{"the record cut off, and the head written again",
                                          "the rejection deleted, record rewritten"});

    // Whom two accept passes, and the record stays what the witness saw.
    clinic.begin("accepted");
    CHECK(passes({}));
    CHECK(clinic.audited().exit_code == 0);

    // Who rejected takes it back, also with a new key in place of a lost one.
    const std::string project = clinic.begin("rejected");
    clinic.tries("B. Roth", Verdict::Reject, clinic.roth);
    retire_signer(clinic, project);
    CHECK_FALSE(passes({}));
    clinic.tries("B. Roth", Verdict::Accept, clinic.eve);
    clinic.signers =
        allowed_signers(allowed_line("kern", clinic.kern) + allowed_line("lang", clinic.lang) +
                        allowed_line("roth", clinic.roth) + allowed_line("roth", clinic.eve));
    CHECK(passes({}));
}
