#include "workbench/review/record_gate.h"

#include <catch2/catch.hpp>

#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/errors.h"
#include "tests/review/reviewed_session.h"
#include "tests/session/sphere_session.h"
#include "tests/support/shapes.h"
#include "workbench/project/database.h"
#include "workbench/project/project.h"
#include "workbench/project/record_check.h"
#include "workbench/review/verdict_import.h"
#include "workbench/session/stored_texts.h"

using namespace vesselbench;
using namespace vesselbench::test;
using Catch::Matchers::Contains;

namespace {

void change(const std::string& project, const std::string& sql) {
    Database(project, OpenMode::Write).run(sql);
}

/// The codes of what the gate finds; empty: it lets the project pass.
std::vector<std::string> contradictions(const std::string& project, std::size_t reviewers) {
    try {
        require_sound_record(Session::open(project, options()), reviewers);
    } catch (const DiagnosedFailure& failure) {
        std::vector<std::string> codes;
        for (const Diagnostic& diagnostic : failure.diagnostics()) codes.push_back(diagnostic.code);
        return codes;
    }
    return {};
}

using Codes = std::vector<std::string>;

}  // namespace

SCENARIO("No review counts in a project that is not what its record says", "[review][hostile]") {
    const std::string project = reviewed_project();
    GIVEN("a project that nobody has reviewed") {
        CHECK(contradictions(project, 1).empty());
        change(project, "UPDATE edits SET author = 'Eve' WHERE edit = 2");
        THEN("it passes as long as nobody asks for reviewers") {
            CHECK(contradictions(project, 0).empty());
            CHECK(contradictions(project, 1) == Codes{"record-contradicted", "record-row-altered"});
        }
    }
    GIVEN("one that was rejected, and has to be accepted") {
        {
            Session session = Session::open(project, options());
            import_verdicts(
                session, save_verdicts(project, verdicts_on(session, "A. Kern", Verdict::Accept)));
            import_verdicts(
                session, save_verdicts(project, verdicts_on(session, "B. Roth", Verdict::Reject)));
        }
        store_text(project, StoredText::Acceptance, R"({"cfd": 2})");
        CHECK(contradictions(project, 0).empty());
        THEN("a rejection that was deleted is missed") {
            change(project, "DELETE FROM verdicts WHERE id = 2");
            CHECK(contradictions(project, 0) == Codes{"record-contradicted", "record-row-missing"});
        }
        THEN("so is the number of reviewers") {
            change(project, "DELETE FROM meta WHERE name = 'acceptance'");
            CHECK(contradictions(project, 0) == Codes{"record-contradicted", "record-row-missing"});
        }
        THEN("and another number") {
            change(project, "UPDATE meta SET value = '{}' WHERE name = 'acceptance'");
            CHECK(contradictions(project, 0) == Codes{"record-contradicted", "record-row-altered"});
        }
        THEN("an entry that was cut off the record is missed with what it recorded") {
            change(project, "DELETE FROM chain WHERE kind = 'acceptance'");
            CHECK(contradictions(project, 0).size() > 1);
        }
    }
}

SCENARIO("A part that stands in another one's place is not read", "[review][project][hostile]") {
    const std::string project = temporary_folder() + "/case.vbench";
    {
        Session session = Session::create(project, options());
        session.apply("make-sphere", {{"levels", std::int64_t{2}}});
        session.apply("bump", {{"at", kTop}, {"reach", 100.0}, {"height", 0.5}});
    }
    // Both positions are stored whole, and are of one size.
    const std::string positions = " FROM blobs WHERE hex(substr(content, 4, 1)) = '01'";
    std::string first, last;
    {
        const Database database(project, OpenMode::Read);
        REQUIRE(database.number("SELECT count(*)" + positions) == 2);
        first = std::to_string(database.number("SELECT min(id)" + positions));
        last = std::to_string(database.number("SELECT max(id)" + positions));
    }
    change(project,
           "CREATE TEMP TABLE kept AS SELECT id, content FROM blobs;"
           "UPDATE blobs SET content = (SELECT content FROM kept WHERE kept.id = " +
               first + " + " + last + " - blobs.id) WHERE id IN (" + first + ", " + last + ")");
    Session session = Session::open(project, options());
    CHECK_THROWS_WITH(session.scene(), Contains("positions") && Contains("SHA-256"));
    THEN("an audit and a replay name it") {
        const RecordCheck check = session.project().check_record();
        REQUIRE(check.findings.size() == 2);
        CHECK(check.findings[0].code == "record-data-damaged");
        CHECK_THAT(session.replay().back().differences.at(0), Contains("positions"));
    }
}
