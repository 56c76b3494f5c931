#include "workbench/review/cohort.h"

#include <filesystem>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "geometry/kernel/whole_file.h"
#include "tests/review/reviewed_session.h"
#include "tests/session/sphere_session.h"
#include "tests/support/shapes.h"

using namespace vesselbench;
using namespace vesselbench::test;
using Catch::Matchers::Contains;

namespace {

/// A project with a sphere and 17 bumps, which A. Kern accepts all; B. Roth rejects every fifth
/// edit, and is unsure of the last one.
std::string long_project() {
    const std::string project = reviewed_project();
    Session session = Session::open(project, options());
    for (int i = 0; i < 15; ++i)
        session.apply("bump", {{"at", kTop}, {"reach", 4.0}, {"height", 0.01 * (i + 1)}});
    import_verdicts(session,
                    save_verdicts(project, verdicts_on(session, "A. Kern", Verdict::Accept)));
    VerdictFile roth = verdicts_on(session, "B. Roth", Verdict::Accept);
    for (std::size_t i = 0; i < roth.edits.size(); i += 5) roth.edits[i].verdict = Verdict::Reject;
    roth.edits.back().verdict = Verdict::Unsure;
    import_verdicts(session, save_verdicts(project, roth));
    return project;
}

/// A project that each of the reviewers accepts.
std::string accepted_project(const std::vector<std::string>& reviewers) {
    const std::string project = reviewed_project();
    Session session = Session::open(project, options());
    for (const std::string& reviewer : reviewers)
        import_verdicts(session,
                        save_verdicts(project, verdicts_on(session, reviewer, Verdict::Accept)));
    return project;
}

}  // namespace

SCENARIO("Agreement is counted by operation over several projects", "[review][cohort]") {
    const CohortAgreement cohort = cohort_agreement({long_project(), long_project()});
    CHECK(cohort.projects == 2);
    CHECK(cohort.unread.empty());
    CHECK(cohort.reviewers == std::set<std::string>{"A. Kern", "B. Roth"});
    REQUIRE(cohort.operations.size() == 2);
    THEN("a unit is an edit that two have decided, and unsure is no decision") {
        const EditAgreement& bumps = cohort.operations.at("bump");
        CHECK(bumps.agreement.units == 32);  // of 34; two are not decided by B. Roth
        CHECK(bumps.agreement.values == 64);
        CHECK(bumps.unsure == 2);
        CHECK(bumps.agreement.share.value() == Approx(26.0 / 32.0));  // edits 6, 11 and 16
        std::vector<RatedUnit> units(26, RatedUnit{"accept", "accept"});
        units.resize(32, RatedUnit{"accept", "reject"});
        CHECK(bumps.agreement.alpha.value() == Approx(krippendorff_alpha(units).value()));
        CHECK(bumps.agreement.lower.value() <= bumps.agreement.alpha.value());
        CHECK(bumps.agreement.upper.value() >= bumps.agreement.alpha.value());
    }
    THEN("below 30 units there is no alpha") {
        const EditAgreement& spheres = cohort.operations.at("make-sphere");
        CHECK(spheres.agreement.units == 2);
        CHECK(spheres.agreement.share.value() == 0.0);
        CHECK_FALSE(spheres.agreement.alpha.has_value());
    }
    THEN("the last figures are those over all operations") {
        CHECK(cohort.all.agreement.units == 34);
        CHECK(cohort.all.agreement.share.value() == Approx(26.0 / 34.0));
        const nlohmann::ordered_json json = cohort_json(cohort);
        CHECK(json["all"]["edits"] == 34);
        CHECK(json["all"]["interval"].size() == 2);
        CHECK(json["operations"][1]["operation"] == "make-sphere");
        CHECK(json["operations"][1]["alpha"].is_null());
        CHECK(json["operations"][1]["too_few"] == true);
    }
}

SCENARIO("Verdicts are paired if they are on the same content of an edit", "[review][cohort]") {
    const std::string project = accepted_project({"A. Kern"});
    Session session = Session::open(project, options());
    session.change_edit(2, {{"at", kTop}, {"reach", 4.0}, {"height", 0.75}});
    const VerdictFile roth = verdicts_on(session, "B. Roth", Verdict::Reject);
    import_verdicts(session, save_verdicts(project, roth));
    const CohortAgreement apart = cohort_agreement({project});
    CHECK(apart.operations.at("make-sphere").agreement.units == 1);
    CHECK(apart.operations.at("bump").agreement.units == 0);
    CHECK_FALSE(apart.operations.at("bump").agreement.share.has_value());
    WHEN("a third one judges the edits as they were, it is paired although they were changed") {
        session.undo();
        import_verdicts(session,
                        save_verdicts(project, verdicts_on(session, "C. Lang", Verdict::Accept)));
        session.redo();
        const CohortAgreement cohort = cohort_agreement({project});
        CHECK(cohort.operations.at("bump").agreement.units == 2);
        CHECK(cohort.operations.at("bump").agreement.share.value() == 1.0);
    }
    WHEN("a reviewer decides again, the newest verdict counts") {
        import_verdicts(session,
                        save_verdicts(project, verdicts_on(session, "A. Kern", Verdict::Reject,
                                                           "2020-01-02T00:00:00Z")));
        import_verdicts(session,
                        save_verdicts(project, verdicts_on(session, "A. Kern", Verdict::Accept,
                                                           "2019-01-02T00:00:00Z")));
        const CohortAgreement cohort = cohort_agreement({project});
        CHECK(cohort.all.agreement.units == 3);
        CHECK(cohort.all.agreement.values == 6);
        CHECK(cohort.all.agreement.share.value() == 1.0);
    }
}

SCENARIO("A cohort is read beside its writers, and without what cannot be read",
         "[review][cohort]") {
    const std::string project = accepted_project({"A. Kern", "B. Roth"});
    const std::string copy = temporary_folder() + "/copy.vbench";
    std::filesystem::copy_file(project, copy);
    const std::string text = temporary_folder() + "/text.vbench";
    write_file(text, "text");
    const std::string none = temporary_folder() + "/none.vbench";
    const Session writer = Session::open(project, options());
    const CohortAgreement cohort = cohort_agreement({text, project, copy, none, project});
    CHECK(cohort.projects == 3);
    CHECK(cohort.all.agreement.units == 3);  // a copy is no second opinion
    CHECK(cohort.all.agreement.values == 6);
    REQUIRE(cohort.unread.size() == 2);
    CHECK(cohort.unread[0].project == text);
    CHECK_THAT(cohort.unread[0].reason, Contains("text.vbench"));
    CHECK(cohort.unread[1].project == none);
    CHECK(cohort_agreement({}).all.agreement.units == 0);
    CHECK(cohort_agreement({reviewed_project()}).reviewers.empty());
}
