#include "workbench/review/review.h"

#include <catch2/catch.hpp>

#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/errors.h"
#include "tests/review/reviewed_session.h"
#include "tests/session/sphere_session.h"
#include "workbench/project/project.h"
#include "workbench/project/record_check.h"
#include "workbench/review/verdict_draft.h"

using namespace vesselbench;
using namespace vesselbench::test;
using Catch::Matchers::Contains;

namespace {

std::vector<ReviewStatus> statuses(const Session& session) {
    std::vector<ReviewStatus> found;
    for (const ReviewedEdit& edit : review_of(session).edits) found.push_back(edit.status);
    return found;
}

ImportedVerdicts enter(Session& session, const std::string& project, const VerdictFile& verdicts) {
    return import_verdicts(session, save_verdicts(project, verdicts));
}

std::string error_of(Session& session, const std::string& project, const VerdictFile& verdicts) {
    try {
        enter(session, project, verdicts);
    } catch (const InvalidInput& error) {
        return error.what();
    }
    return "entered";
}

const std::vector<ReviewStatus> kAllOpen(3, ReviewStatus::Open);
const std::vector<ReviewStatus> kAllAccepted(3, ReviewStatus::Accepted);

}  // namespace

SCENARIO("Verdicts are entered once and judge the edits", "[review]") {
    const std::string project = reviewed_project();
    Session session = Session::open(project, options());
    CHECK(statuses(session) == kAllOpen);
    CHECK(review_words(review_of(session)) == "not reviewed");
    const VerdictFile kern = verdicts_on(session, "A. Kern", Verdict::Accept);
    CHECK_FALSE(enter(session, project, kern).known);
    CHECK(statuses(session) == kAllAccepted);
    CHECK(review_words(review_of(session)) == "accepted by A. Kern");
    THEN("a second time they are known") {
        const std::string head = session.project().record_head();
        CHECK(enter(session, project, kern).known);
        CHECK(session.project().record_head() == head);
    }
    THEN("they are in the record") {
        const RecordCheck check = session.project().check_record();
        CHECK(check.findings.empty());
        CHECK(check.entries.back().kind == "verdicts");
        CHECK(check.entries.back().subject == "A. Kern");
    }
    WHEN("another reviewer disagrees") {
        VerdictFile roth = verdicts_on(session, "B. Roth", Verdict::Reject);
        roth.overall = Verdict::None;
        roth.edits.resize(2);
        roth.edits[1].verdict = Verdict::Unsure;
        enter(session, project, roth);
        THEN("what both decided is disputed") {
            CHECK(statuses(session) == std::vector{ReviewStatus::Disputed, ReviewStatus::Accepted,
                                                   ReviewStatus::Accepted});
        }
        THEN("the one that is entered last replaces it, whatever time it gives") {
            enter(session, project,
                  verdicts_on(session, "B. Roth", Verdict::Accept, "2020-01-02T00:00:00Z"));
            CHECK(statuses(session) == kAllAccepted);
            enter(session, project,
                  verdicts_on(session, "B. Roth", Verdict::Reject, "2019-01-01T00:00:00Z"));
            CHECK(statuses(session) == std::vector(3, ReviewStatus::Disputed));
        }
    }
    WHEN("an edit is changed afterwards") {
        session.change_edit(2, {{"at", kTop}, {"reach", 4.0}, {"height", 0.75}});
        THEN("the verdicts on it and on what follows are outdated") {
            CHECK(statuses(session) == std::vector{ReviewStatus::Accepted, ReviewStatus::Outdated,
                                                   ReviewStatus::Outdated});
            CHECK(review_of(session).overall.at(0).outdated);
            CHECK(status_of(review_of(session)) == ReviewStatus::Outdated);
        }
        THEN("they hold again once the change is undone") {
            session.undo();
            CHECK(statuses(session) == kAllAccepted);
        }
        THEN("verdicts that come later on what was, are said to be outdated") {
            CHECK(enter(session, project,
                        [&] {
                            VerdictFile roth = kern;
                            roth.reviewer = "B. Roth";
                            return roth;
                        }())
                      .outdated == 2);
        }
    }
    WHEN("an edit is computed again with the same result, its verdict holds") {
        session.undo();
        session.undo();
        session.redo();
        session.redo();
        CHECK(statuses(session) == kAllAccepted);
    }
}

SCENARIO("Verdicts of another project, copy or record are refused", "[review]") {
    const std::string project = reviewed_project();
    Session session = Session::open(project, options());
    const VerdictFile good = verdicts_on(session, "A. Kern", Verdict::Accept);
    VerdictFile other = good;
    other.project = "0";
    CHECK_THAT(error_of(session, project, other),
               Contains(".project.id") && Contains("another project"));
    other = good;
    other.edits[1].edit.revision = 3;
    CHECK_THAT(error_of(session, project, other), Contains(".edits[1].edit"));
    other = good;
    other.chain_head = std::string(64, 'a');
    CHECK_THAT(error_of(session, project, other), Contains(".chain_head"));
    CHECK(statuses(session) == kAllOpen);
}

SCENARIO("The gate names what is missing", "[review]") {
    const std::string project = reviewed_project();
    Session session = Session::open(project, options());
    const auto refusal = [&](std::size_t reviewers) -> std::string {
        try {
            require_accepted(review_of(session, "cfd"), reviewers);
        } catch (const DiagnosedFailure& failure) {
            CHECK(failure.diagnostics().front().code == "not-accepted");
            return failure.what();
        }
        return "";
    };
    CHECK_THAT(refusal(1), Contains("1 make-sphere (open)") && Contains("3 bump (open)"));
    enter(session, project, verdicts_on(session, "A. Kern", Verdict::Accept));
    CHECK(refusal(1).empty());
    CHECK_THAT(refusal(2), Contains("2 bump (accepted by 1 of 2)"));
    enter(session, project, verdicts_on(session, "B. Roth", Verdict::Accept));
    CHECK(refusal(2).empty());
    VerdictFile veto = verdicts_on(session, "C. Lang", Verdict::Reject);
    veto.edits.clear();
    for (const ReviewedEdit& edit : review_of(session).edits)
        veto.edits.push_back({.edit = edit.edit, .hash = edit.hash, .time = veto.written});
    enter(session, project, veto);
    CHECK_THAT(refusal(1), Contains("the whole model (rejected by C. Lang)"));
}

SCENARIO("An edit's hash follows what it is", "[review]") {
    const std::string project = reviewed_project();
    Session session = Session::open(project, options());
    const auto hash = [&](std::size_t at) {
        return edit_hash(session.project(), session.log().at(at));
    };
    const std::string first = hash(0), second = hash(1), third = hash(2);
    CHECK(first.size() == 64);
    CHECK(second != third);
    session.set_note({2, 1}, "a note changes no model");
    CHECK(hash(1) == second);
    session.remove_edit(2);
    CHECK(session.log().at(1).status == EditStatus::Pending);
    CHECK(hash(0) == first);
    CHECK(hash(1) != third);
    session.undo();
    CHECK(hash(2) == third);
}

SCENARIO("A verdict is entered without a file", "[review]") {
    const std::string project = reviewed_project();
    Session session = Session::open(project, options());
    const ReviewedEdit seen = review_of(session).edits.at(1);
    EditVerdict said{.edit = seen.edit, .hash = seen.hash, .verdict = Verdict::Accept};
    const Reviewer kern{"A. Kern", "radiologist"};
    WHEN("it accepts an edit") {
        const ImportedVerdicts entered = enter_verdict(session, kern, said);
        CHECK(imported_words(entered) == "1 verdict of A. Kern");
        THEN("that edit alone is accepted, and the record knows it") {
            CHECK(statuses(session) ==
                  std::vector{ReviewStatus::Open, ReviewStatus::Accepted, ReviewStatus::Open});
            CHECK(session.project().check_record().findings.empty());
            CHECK(session.project().check_record().entries.back().kind == "verdicts");
        }
        THEN("a later one of the same reviewer replaces it, also within a second") {
            said.verdict = Verdict::Reject;
            said.comment = "too high";
            enter_verdict(session, kern, said);
            CHECK(statuses(session)[1] == ReviewStatus::Rejected);
            said.verdict = Verdict::Accept;
            said.comment.clear();
            CHECK_FALSE(enter_verdict(session, kern, said).known);
            CHECK(statuses(session)[1] == ReviewStatus::Accepted);
        }
    }
    WHEN("the edit was changed since it was seen, it is outdated") {
        session.change_edit(2, {{"at", kTop}, {"reach", 4.0}, {"height", 0.75}});
        CHECK(imported_words(enter_verdict(session, kern, said)) ==
              "1 verdict of A. Kern, 1 of them on what has changed since");
        CHECK(statuses(session)[1] == ReviewStatus::Outdated);
    }
    THEN("what a file could not say is refused") {
        CHECK_THROWS_AS(enter_verdict(session, {"", ""}, said), InvalidInput);
        said.verdict = Verdict::Reject;
        CHECK_THROWS_WITH(enter_verdict(session, kern, said), Contains("the verdict"));
        said.edit.revision = 7;
        said.comment = "why";
        CHECK_THROWS_AS(enter_verdict(session, kern, said), InvalidInput);
        CHECK(review_of(session).files == 0);
    }
}

SCENARIO("The whole model is judged without a file", "[review]") {
    const std::string project = reviewed_project();
    Session session = Session::open(project, options());
    const Reviewer kern{"A. Kern", "radiologist"};
    VerdictFile pinned = verdicts_on(session, "A. Kern", Verdict::Accept, "2020-01-01T00:00:00Z");
    pinned.overall = Verdict::None;
    pinned.edits[1].pins = {{.place = Vec3(1, 2, 3), .text = "look here"}};
    enter(session, project, pinned);
    const Review seen = review_of(session);
    CHECK(status_of_whole(seen) == ReviewStatus::Open);
    WHEN("it is rejected") {
        CHECK(imported_words(
                  enter_overall(session, kern, seen, Verdict::Reject, "a branch is missing")) ==
              "one on the whole model of A. Kern");
        const Review review = review_of(session);
        CHECK(status_of_whole(review) == ReviewStatus::Rejected);
        REQUIRE(review.overall.size() == 1);
        CHECK(review.overall[0].comment == "a branch is missing");
        CHECK_FALSE(review.overall[0].outdated);
        CHECK_THROWS_WITH(require_accepted(review, 1),
                          Contains("the whole model (rejected by A. Kern)"));
        THEN("the verdicts and marks on edits are what they were") {
            CHECK(statuses(session) == kAllAccepted);
            CHECK(review.edits.at(1).pins.size() == 1);
        }
        THEN("it is outdated once an edit is another one") {
            session.change_edit(2, {{"at", kTop}, {"reach", 4.0}, {"height", 0.75}});
            CHECK(review_of(session).overall.at(0).outdated);
            CHECK(status_of_whole(review_of(session)) == ReviewStatus::Outdated);
        }
        THEN("a later verdict of the same reviewer replaces it") {
            enter_overall(session, kern, seen, Verdict::Accept, "");
            CHECK(status_of_whole(review_of(session)) == ReviewStatus::Accepted);
        }
    }
    WHEN("the model was changed since it was seen, it is outdated at once") {
        session.change_edit(2, {{"at", kTop}, {"reach", 4.0}, {"height", 0.75}});
        enter_overall(session, kern, seen, Verdict::Accept, "");
        CHECK(review_of(session).overall.at(0).outdated);
    }
    THEN("a rejection without a reason is refused") {
        CHECK_THROWS_AS(enter_overall(session, kern, seen, Verdict::Reject, ""), InvalidInput);
        CHECK(review_of(session).overall.empty());
    }
}

SCENARIO("No verdict holds for an edit that has no result", "[review]") {
    const std::string project = reviewed_project();
    Session session = Session::open(project, options());
    session.change_edit(2, {{"at", kTop}, {"reach", 4.0}, {"height", 0.75}});
    const Review before = review_of(session);
    CHECK_FALSE(before.edits.at(0).pending);
    REQUIRE(before.edits.at(2).pending);
    enter(session, project, verdicts_on(session, "A. Kern", Verdict::Accept));
    CHECK(statuses(session).at(0) == ReviewStatus::Accepted);
    CHECK(statuses(session).at(2) == ReviewStatus::Outdated);
    THEN("nor when it has one") {
        static_cast<void>(session.scene());
        CHECK_FALSE(review_of(session).edits.at(2).pending);
        CHECK(statuses(session).at(2) == ReviewStatus::Outdated);
    }
}

SCENARIO("A draft becomes a verdict with the marks that were given before", "[review]") {
    const std::string project = reviewed_project();
    Session session = Session::open(project, options());
    const auto edit = [&] { return review_of(session).edits.at(1); };
    VerdictDraft draft{.comment = "too high",
                       .pins = {{.place = Vec3(1, 2, 3), .text = "here"}},
                       .distances = {distance_between(Vec3(0, 0, 0), Vec3(3, 4, 0))}};
    CHECK(draft.distances[0].length == 5.0);
    enter_verdict(session, {"A. Kern", ""}, verdict_of(draft, Verdict::Reject, edit(), "A. Kern"));
    CHECK(edit().pins.size() == 1);
    REQUIRE(edit().distances.size() == 1);
    CHECK(edit().distances[0].reviewer == "A. Kern");
    CHECK(edit().distances[0].distance.length == 5.0);
    WHEN("the same reviewer gives another verdict") {
        draft = {.pins = {{.place = Vec3(4, 5, 6), .text = "and here"}}};
        enter_verdict(session, {"A. Kern", ""},
                      verdict_of(draft, Verdict::Accept, edit(), "A. Kern"));
        REQUIRE(edit().pins.size() == 2);
        CHECK(edit().pins[0].pin.text == "here");
        CHECK(edit().pins[1].pin.text == "and here");
        CHECK(edit().distances.size() == 1);
    }
    THEN("what was added while it was entered stays a draft") {
        VerdictDraft added = draft;
        added.pins.push_back({.place = Vec3(4, 5, 6), .text = "and here"});
        const VerdictDraft rest = rest_of(added, draft);
        REQUIRE(rest.pins.size() == 1);
        CHECK(rest.pins[0].text == "and here");
        CHECK(rest.comment.empty());
        CHECK(rest.distances.empty());
    }
    THEN("another reviewer's verdict has none of them") {
        CHECK(verdict_of({}, Verdict::Accept, edit(), "B. Roth").pins.empty());
    }
    THEN("those on an earlier result stay with it") {
        session.change_edit(2, {{"at", kTop}, {"reach", 4.0}, {"height", 0.75}});
        CHECK(edit().distances.at(0).outdated);
        const EditVerdict next = verdict_of({}, Verdict::Accept, edit(), "A. Kern");
        CHECK(next.pins.empty());
        CHECK(next.distances.empty());
    }
}

SCENARIO("Only a rejection needs words", "[review]") {
    CHECK(why_incomplete({}, Verdict::Reject) == "a rejection needs a reason");
    CHECK(why_incomplete({.comment = "  "}, Verdict::Reject) == "a rejection needs a reason");
    CHECK(why_incomplete({.comment = "too high"}, Verdict::Reject).empty());
    CHECK(why_incomplete({}, Verdict::Accept).empty());
    CHECK(why_incomplete({}, Verdict::Unsure).empty());
}

SCENARIO("A review has the pins of each reviewer's newest verdicts", "[review]") {
    const std::string project = reviewed_project();
    Session session = Session::open(project, options());
    VerdictFile kern = verdicts_on(session, "A. Kern", Verdict::None);
    kern.edits[1].pins = {{.place = Vec3(1, 2, 3), .text = "look here"}};
    enter(session, project, kern);
    const std::vector<GivenPin> pins = review_of(session).edits.at(1).pins;
    REQUIRE(pins.size() == 1);
    CHECK(pins[0].reviewer == "A. Kern");
    CHECK(pins[0].pin.text == "look here");
    CHECK(pins[0].pin.place == Vec3(1, 2, 3));
    CHECK_FALSE(pins[0].outdated);
    THEN("they are outdated once the edit is changed") {
        session.change_edit(2, {{"at", kTop}, {"reach", 4.0}, {"height", 0.75}});
        CHECK(review_of(session).edits.at(1).pins.at(0).outdated);
    }
    THEN("newer verdicts on the edit replace them") {
        enter(session, project,
              verdicts_on(session, "A. Kern", Verdict::Accept, "2020-01-02T00:00:00Z"));
        CHECK(review_of(session).edits.at(1).pins.empty());
    }
}
