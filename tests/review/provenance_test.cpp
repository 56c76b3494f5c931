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

SCENARIO("A line says where an exported model is from", "[review][provenance]") {
    const std::string project = reviewed_project();
    Session session = Session::open(project, options());
    const std::string digest = session.project().digest(session.log().back().result->id);
    const std::string before = provenance(session, "cfd");
    CHECK(before == "project case, cfd, not reviewed, model " + digest.substr(0, 12));
    THEN("another project with the same model has the same line") {
        CHECK(provenance(Session::open(reviewed_project(), options()), "cfd") == before);
    }
    THEN("what is recorded without changing the model does not change it") {
        session.set_note({2, 1}, "a note");
        CHECK(provenance(session, "cfd") == before);
    }
    THEN("another model has another one") {
        session.change_edit(2, {{"at", kTop}, {"reach", 4.0}, {"height", 0.75}});
        static_cast<void>(session.scene());
        CHECK(provenance(session, "cfd") != before);
    }
    THEN("it names who accepted the model") {
        for (const char* reviewer : {"B. Roth", "A. Kern"})
            import_verdicts(
                session, save_verdicts(project, verdicts_on(session, reviewer, Verdict::Accept)));
        CHECK_THAT(provenance(session, "cfd"), Contains("accepted by A. Kern, B. Roth"));
    }
    THEN("the name given to the input replaces that of the file") {
        store_text(project, StoredText::InputName, "case 7");
        CHECK_THAT(provenance(session, "cfd"), Contains("project case 7, cfd"));
    }
    THEN("a session without a file has no name") {
        Session unsaved = Session::unsaved(options());
        CHECK(provenance(unsaved, "cfd") == "cfd, not reviewed");
    }
}
