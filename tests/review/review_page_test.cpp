#include "workbench/review/review_page.h"

#include <algorithm>
#include <stop_token>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "geometry/kernel/errors.h"
#include "tests/review/reviewed_session.h"
#include "tests/session/small_operations.h"
#include "workbench/review/page_manifest.h"
#include "workbench/review/page_queue.h"

using namespace vesselbench;
using namespace vesselbench::test;
using Json = nlohmann::ordered_json;

namespace {

Session opened(const std::string& project) {
    return Session::open(project, {.author = "Ada", .find = find_test_operation});
}

/// What the page's data element says. Empty: the build has no page.
Json case_in(const std::string& page) {
    const std::string begin = R"(<script type="application/json" id="case">)";
    const std::size_t from = page.find(begin) + begin.size();
    return Json::parse(page.substr(from, page.find("</script>", from) - from));
}

}  // namespace

SCENARIO("The page's manifest has every edit with its surfaces, arguments and figures",
         "[review]") {
    Session session = opened(reviewed_project());
    const auto log = session.log(kDefaultVariant);
    const PageModels models = page_models(session, log, find_test_operation);
    const Json page = page_manifest(session, kDefaultVariant, log, models, PageImages::Contours,
                                    find_test_operation);
    CHECK(page["format"] == "vesselbench-review");
    CHECK(page["project"]["id"] == session.project().id());
    CHECK(page["chain_head"] == session.project().record_head());
    REQUIRE(page["edits"].size() == log.size());
    for (std::size_t i = 0; i < log.size(); ++i) {
        const Json& edit = page["edits"][i];
        CHECK(edit["id"] == log[i].edit.edit.id);
        CHECK(edit["hash"].get<std::string>().size() == 64);
        CHECK(edit["author"] == "Ada");
        CHECK(edit["after"] == i);
        if (i > 0) CHECK(edit["before"] == i - 1);
    }
    THEN("a change has its place, its size and the vessel's radius there") {
        const Json& bump = page["edits"][1];
        REQUIRE(bump.contains("place"));
        CHECK(bump["deviation"]["max_mm"].get<double>() > 0.0);
        CHECK(bump["radius"].get<double>() == Approx(10.0).epsilon(0.1));
        CHECK(bump["changed_box"].size() == 6);
    }
}

SCENARIO("Comparing many edits says how far it is, and can be cancelled between two of them",
         "[review]") {
    Session session = opened(reviewed_project());
    const auto log = session.log(kDefaultVariant);
    std::vector<double> fractions;
    std::stop_source stop;
    const Progress progress(
        [&](double fraction, std::string_view what) {
            fractions.push_back(fraction);
            if (what.starts_with("comparing")) stop.request_stop();
        },
        stop.get_token());
    CHECK_THROWS_AS(page_models(session, log, find_test_operation, {}, progress), Cancelled);
    CHECK(fractions.size() == log.size() + 1);
    CHECK(std::ranges::is_sorted(fractions));
}

SCENARIO("What deserves a look comes first", "[review]") {
    Session session = opened(reviewed_project());
    const auto log = session.log(kDefaultVariant);
    const PageModels models = page_models(session, log, find_test_operation);
    const auto queue = review_queue(log, models, find_test_operation);
    CHECK(std::ranges::is_sorted(queue, std::ranges::greater{}, &QueueItem::score));
    for (const QueueItem& item : queue) {
        CHECK_FALSE(item.why.empty());
        CHECK(std::ranges::count(log, item.edit,
                                 [](const LogEntry& entry) { return entry.edit.edit.id; }) == 1);
    }
}

SCENARIO("Texts of a project cannot leave the page's data", "[review]") {
    const std::string project = reviewed_project();
    const std::string hostile = "</script><script>alert(1)</script>\xe2\x80\xa8&\"'";
    {
        Session session = opened(project);
        session.set_note(session.log().back().edit.edit, hostile);
    }
    Session session = opened(project);
    std::string page;
    try {
        page = review_page(session, kDefaultVariant, find_test_operation).html;
    } catch (const AlgorithmFailure& failure) {
        WARN("skipped: " << failure.what());
        return;
    }
    CHECK(page.find("alert(1)</script>") == std::string::npos);
    CHECK(case_in(page)["edits"].back()["note"] == hostile);
    CHECK(page.find("id=\"blob-chunk-0\"") != std::string::npos);
    CHECK(page.find("<!-- vesselbench data -->") == std::string::npos);
}
