#include "workbench/review/provenance.h"

#include <filesystem>

#include <catch2/catch.hpp>

#include "tests/review/reviewed_session.h"
#include "tests/session/sphere_session.h"
#include "workbench/project/project.h"
#include "workbench/session/stored_texts.h"

using namespace vesselbench;
using namespace vesselbench::test;
using Catch::Matchers::Contains;

namespace {

std::string line_of(const Session& session) {
    return provenance(session, "cfd", review_of(session, "cfd"));
}

}  // namespace

SCENARIO("A line says where an exported model is from", "[review][provenance]") {
    const std::string project = reviewed_project();
    Session session = Session::open(project, options());
    const std::string digest = session.project().digest(session.log().back().result->id);
    const std::string before = line_of(session);
    CHECK(before == "project case, cfd, not reviewed, model " + digest.substr(0, 12));
    THEN("another project with the same model has the same line") {
        CHECK(line_of(Session::open(reviewed_project(), options())) == before);
    }
    THEN("what is recorded without changing the model does not change it") {
        session.set_note({2, 1}, "a note");
        CHECK(line_of(session) == before);
    }
    THEN("another model has another one") {
        session.change_edit(2, {{"at", kTop}, {"reach", 4.0}, {"height", 0.75}});
        static_cast<void>(session.scene());
        CHECK(line_of(session) != before);
    }
    THEN("it names who accepted the model") {
        for (const char* reviewer : {"B. Roth", "A. Kern"})
            import_verdicts(
                session, save_verdicts(project, verdicts_on(session, reviewer, Verdict::Accept)));
        CHECK_THAT(line_of(session), Contains("accepted by A. Kern, B. Roth"));
    }
    THEN("who share the edits have not accepted the model each") {
        VerdictFile kern = verdicts_on(session, "A. Kern", Verdict::Accept),
                    roth = verdicts_on(session, "B. Roth", Verdict::Accept);
        kern.edits.pop_back();
        roth.edits.erase(roth.edits.begin());
        import_verdicts(session, save_verdicts(project, kern));
        import_verdicts(session, save_verdicts(project, roth));
        CHECK_THAT(line_of(session), Contains("every edit accepted, by A. Kern, B. Roth"));
    }
    THEN("the name given to the input replaces that of the file") {
        store_text(project, StoredText::InputName, "case 7");
        CHECK_THAT(line_of(session), Contains("project case 7, cfd"));
    }
    THEN("a session without a file has no name") {
        Session unsaved = Session::unsaved(options());
        CHECK(line_of(unsaved) == "cfd, not reviewed");
    }
}
