#include "workbench/review/import_checks.h"

#include <chrono>

#include <catch2/catch.hpp>

#include "geometry/kernel/errors.h"
#include "tests/review/reviewed_session.h"
#include "tests/session/sphere_session.h"
#include "workbench/project/utc_time.h"
#include "workbench/review/review.h"
#include "workbench/review/verdict_import.h"

using namespace vesselbench;
using namespace vesselbench::test;
using Catch::Matchers::Contains;

namespace {

std::string time_in_minutes(int minutes) {
    return utc_text(std::chrono::system_clock::now() + std::chrono::minutes(minutes));
}

}  // namespace

SCENARIO("Times exist and are not ahead", "[review][verdicts][hostile]") {
    CHECK(is_utc_time("2024-02-29T23:59:59Z"));
    for (const char* text : {"2023-02-29T00:00:00Z", "2024-13-01T00:00:00Z", "2024-01-01T24:00:00Z",
                             "2024-01-01T00:60:00Z", "2024-01-01", "2024-01-01T00:00:00Zz", ""})
        CHECK_FALSE(is_utc_time(text));
    const std::string project = reviewed_project();
    Session session = Session::open(project, options());
    const auto enter = [&](const std::string& written, const std::string& judged) {
        VerdictFile file = verdicts_on(session, "A. Kern", Verdict::Accept, written);
        file.edits[1].time = judged;
        import_verdicts(session, save_verdicts(project, file));
    };
    const std::string then = "2024-05-17T09:30:00Z";
    CHECK_THROWS_WITH(enter("2024-02-31T00:00:00Z", then), Contains(".written is no time"));
    CHECK_THROWS_WITH(enter(then, "2024-05-17T29:30:00Z"), Contains(".edits[1].time is no time"));
    CHECK_THROWS_WITH(enter(time_in_minutes(20), then), Contains(".written is in the future"));
    CHECK_THROWS_WITH(enter(then, time_in_minutes(20)),
                      Contains(".edits[1].time is in the future"));
    CHECK(review_of(session).files == 0);
    CHECK_NOTHROW(enter(time_in_minutes(5), then));
}

SCENARIO("One person is one reviewer, however the name is written", "[review][hostile]") {
    const std::string project = reviewed_project();
    Session session = Session::open(project, options());
    const auto enter = [&](const std::string& reviewer, Verdict verdict) {
        import_verdicts(session, save_verdicts(project, verdicts_on(session, reviewer, verdict)));
    };
    enter("A. Kern", Verdict::Accept);
    enter("a.  kern ", Verdict::Accept);
    CHECK_THAT(missing_acceptance(review_of(session), 2).at(0), Contains("accepted by 1 of 2"));
    THEN("what is entered later under another spelling replaces what was before") {
        enter("A. KERN", Verdict::Reject);
        CHECK(review_of(session).edits.at(0).verdicts.size() == 1);
        CHECK(status_of(review_of(session)) == ReviewStatus::Rejected);
    }
    THEN("names that an eye mistakes for it, or that hide something, are refused") {
        for (const char* name : {"A Kern", "\u0410. Kern", "A. K\u00e9rn"})
            CHECK_THROWS_WITH(enter(name, Verdict::Accept), Contains("nearly that of"));
        CHECK_THROWS_WITH(enter("B. Roth\u200b", Verdict::Accept), Contains("show nothing"));
        CHECK_THROWS_WITH(enter("...", Verdict::Accept), Contains("no letter"));
        CHECK_NOTHROW(enter("B. Kern", Verdict::Accept));
        CHECK(missing_acceptance(review_of(session), 2).empty());
    }
}

SCENARIO("A rejection of the whole lists all edits that its page had", "[review][hostile]") {
    const std::string project = reviewed_project();
    Session session = Session::open(project, options());
    VerdictFile veto = verdicts_on(session, "C. Lang", Verdict::Reject);
    for (EditVerdict& edit : veto.edits) edit.verdict = Verdict::None;
    const auto enter = [&] { import_verdicts(session, save_verdicts(project, veto)); };
    WHEN("it lists some") {
        veto.edits.pop_back();
        CHECK_THROWS_WITH(enter(), Contains(".edits lists only some"));
        veto.edits.clear();
        CHECK_THROWS_WITH(enter(), Contains(".edits lists only some"));
        CHECK(review_of(session).overall.empty());
    }
    WHEN("an edit was made since, it is entered") {
        session.apply("bump", {{"at", kTop}, {"reach", 4.0}, {"height", 0.25}});
        CHECK_NOTHROW(enter());
        CHECK(review_of(session).overall.at(0).outdated);
    }
}
