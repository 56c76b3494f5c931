#include "workbench/report/report_html.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "workbench/case/json_text.h"
#include "workbench/report/log_json.h"

using namespace vesselbench;
using Catch::Matchers::Contains;
using Json = nlohmann::ordered_json;

SCENARIO("The report's page has no control characters", "[workbench][report]") {
    const std::string name = "a\x1b[31m\x07\x7f\r b\xe4\xc2\x9b \xe2\x80\xae";
    const Json report = {{"program_version", "1"},
                         {"purpose", "cfd"},
                         {"input", {{"name", name}}},
                         {"warnings", {name}},
                         {"products", {name}}};
    const std::vector<ReportPicture> pictures = {{name, "png"}};
    for (const Json& document : {report, printable_json(report)}) {
        const std::string page = report_html(document, pictures, {});
        for (const char* part : {"\x1b", "\x07", "\x7f", "\r", "\xe4", "\x9b", "\xe2\x80\xae"})
            CHECK_THAT(page, !Contains(part));
        CHECK_THAT(page, Contains("a\\x1b[31m\\x07\\x7f\\x0d b\\xe4\\xc2\\x9b"));
    }
}

SCENARIO("The report's page matches its document", "[workbench][report]") {
    const Json report = Json::parse(R"({
        "program_version": "1.2.3", "purpose": "cfd", "units": "mm",
        "input": {"name": "<vessel> & co"},
        "warnings": ["the inlet sits in a bend"],
        "notes": ["made without staircases"],
        "requirements": [
            {"requirement": "smoothness", "limit": "at most 1 % of edges", "judgement": "not met"},
            {"requirement": "spatial relations", "judgement": "not judged: of low relevance"}],
        "steps": [{"step": "smoothing", "operation": "smooth", "resolved": {"lambda": 0.5,
                   "planes": [{"tip": [1, 2, 3]}, {"tip": [4, 5, 6]}]},
                   "duration_s": 0.25, "change": {"volume_before_mm3": 200.0,
                   "volume_after_mm3": 190.0, "triangles_after": 1234}},
                  {"step": "source", "operation": "repair", "resolved": {},
                   "change": {"volume_before_mm3": null, "volume_after_mm3": 200.0,
                   "no_volume_change": "the triangles before were not oriented alike"}}],
        "quality": {"before": {"closed": false},
                    "after": {"closed": true, "triangles": 1234, "volume": 1536.7}},
        "openings": [{"name": "inlet", "kind": "inlet", "diameter": 4.25}],
        "ends": [{"number": 2, "place_mm": [1, 2, 31.5], "diameter_mm": 3.75, "fate": "closed",
                  "opening": null, "why": "it looks like an <aneurysm>"},
                 {"number": 1, "place_mm": [4, 5, 6], "diameter_mm": 4.5, "fate": "opened",
                  "opening": "inlet", "why": ""}],
        "findings": [{"id": "bump@1,2,3", "title": "Bump", "certainty": 0.87,
                      "text": "the wall rises <here>",
                      "operation": {"name": "brush-smooth", "arguments": {"at": "1,2,3"}}},
                     {"id": "stub@4,5,6", "title": "Sac (aneurysm?) or stub?", "certainty": 0.96,
                      "certain_of": "a branch ends blind", "text": "a blind branch",
                      "readings": [{"key": "sac", "text": "sac (aneurysm?) 88 %: its <neck>"}],
                      "operation": {"name": "remove-branch", "arguments": {"tip": "4,5,6"}}},
                     {"id": "handle@1,2,3", "title": "Handle", "certainty": 0.5, "text": "a ring",
                      "operation": null},
                     {"id": "dent@1,2,3", "title": "Dent", "certainty": 0.49, "text": "a hollow",
                      "operation": null}],
        "distance_from_source": {"mean_mm": 0.125, "largest_mm": 27.5},
        "volume_mesh": {"cells": 98765},
        "flow": {"inlets": [{"name": "inlet", "reynolds": 89.8}]},
        "casting": {"wax_grams": 12.5, "flow_cm3_s": 2.5, "size": {"least_mm": 0.5, "noise": 3e-15},
                    "planes": [1, 2, 3, 4, 5, 6, 7, 8, 9, 10]},
        "products": ["surface.vtp"]})");
    const std::vector<ReportPicture> pictures = {{"from the front", std::string("\x89PNG")}};
    const std::string page = report_html(
        report, pictures,
        std::vector<ReportSection>{{.key = "casting", .title = "Mould", .about = "To be cast."},
                                   {.key = "absent", .title = "Absent", .about = ""}});
    for (const char* part :
         {"&lt;vessel&gt; &amp; co",
          "the inlet sits in a bend",
          "What looks wrong",
          "the wall rises &lt;here&gt;",
          "87 %",
          "brush-smooth at=1,2,3",
          "96 % that a branch ends blind",
          "sac (aneurysm?) 88 %: its &lt;neck&gt;",
          "<details><summary>1 more below 50 %</summary>",
          "lambda=0.5",
          "-5 %",
          "98765",
          "4.25",
          "89.8",
          "<h2>Mould</h2>",
          "To be cast.",
          "wax grams",
          "12.5",
          "flow [cm\u00B3/s]",
          "least [mm] 0.5, noise 0<",
          "10 numbers",
          "planes=2 records",
          "<h2>Vessel ends</h2>",
          "<td class=n>2</td><td>1,2,31.5</td><td class=n>3.75</td><td class=n>closed</td>",
          "<td class=n>1</td><td>4,5,6</td><td class=n>4.5</td><td class=n>opened</td>"
          "<td class=n>inlet, 4.25 mm</td>",
          "inlet=, open= and closed=",
          "it looks like an &lt;aneurysm&gt;",
          "Distance from the source",
          "27.5",
          "- (the triangles before were not oriented alike)",
          "data:image/png;base64,iVBORw==",
          "surface.vtp"})
        CHECK_THAT(page, Contains(part));
    THEN("findings are folded, and what may be anatomy is not offered for removal") {
        const std::size_t likely = page.find("<details><summary>What looks wrong: 3 findings"),
                          unlikely = page.find("<details><summary>1 more below 50 %");
        REQUIRE(likely != std::string::npos);
        CHECK(page.find("87 %") > likely);
        CHECK(page.find("87 %") < unlikely);
        CHECK(page.find("a hollow") > unlikely);
        CHECK(page.find("remove-branch") == std::string::npos);
    }
    THEN("notes are folded, and no warnings") {
        CHECK(page.find("made without staircases") > page.find("<summary>Notes"));
    }
    THEN(
        "the first screen has the picture, verdicts, openings with their ends' numbers, and what "
        "to look at") {
        const std::string first = page.substr(0, page.find("<h2 id=look>"));
        for (const char* part :
             {"from the front",
              "<p class=\"verdict bad\">Not met: smoothness, at most 1 % of edges",
              "<td>spatial relations</td><td class=\"\">not judged</td>",
              "<td class=n>1</td><td>inlet</td><td class=n>4.25</td>", "the inlet sits in a bend",
              "<b>Bump</b> the wall rises &lt;here&gt;", "not reviewed",
              "<td>Name</td><td>Role</td><td>Date</td>"})
            CHECK_THAT(first, Contains(part));
        CHECK_THAT(first, !Contains("a hollow") && !Contains("made without staircases"));
    }
    THEN("numbers have three digits, and no exponent where they are large") {
        CHECK_THAT(page, Contains(">1540<"));
    }
    CHECK(page.find("src=\"http") == std::string::npos);
    CHECK(page.find("<vessel>") == std::string::npos);
    CHECK(page.find("Absent") == std::string::npos);
    THEN("a print's page does not speak of flow") {
        Json print = report;
        print["purpose"] = "rp";
        print.erase("flow");
        const std::string whole = report_html(print, {}, {}),
                          other = whole.substr(whole.find("</style>"));
        for (const char* word : {"inlet=", "extension", "flow"}) {
            CAPTURE(word);
            CHECK(other.find(word) == std::string::npos);
        }
    }
}

SCENARIO("Where there is no change of the volume, the reason is given", "[workbench][report]") {
    SurfaceChange change{.volume_after = 200.0, .triangles_before = 80, .triangles_after = 80};
    CHECK(change_text(change) ==
          "volume 200.0 mm\u00B3 (no change: the triangles before were not oriented alike)");
    change.volume_before = -200.0;
    CHECK_THAT(change_text(change), Contains("the surface before was inside out"));
    change.volume_before = 100.0;
    CHECK(change_text(change) == "volume +100.00 %");
    CHECK(change_text({.volume_after = 200.0, .triangles_after = 80}) ==
          "volume 200.0 mm\u00B3, 80 triangles");
    const auto result = std::make_shared<ResultRecord>();
    result->change = {.volume_after = 200.0, .triangles_before = 80};
    const LogEntry entry{.edit = {}, .result = result};
    CHECK(log_json(entry)["change"]["no_volume_change"] ==
          "the triangles before were not oriented alike");
}

SCENARIO("The first screen of a report is as short as a screen", "[workbench][report]") {
    Json report = Json::parse(R"({"program_version": "1", "purpose": "rp", "input": {"name": "a"},
        "requirements": [{"requirement": "smoothness", "judgement": "met"}],
        "casting": {"headline": "not printable, a gap"}})");
    const std::vector<ReportSection> sections = {{.key = "casting", .title = "Cast", .about = ""}};
    const auto first = [&] {
        const std::string page = report_html(report, {}, sections);
        return page.substr(0, page.find("class=sign"));
    };
    THEN("it says what is met, what a check found, and that there is nothing else") {
        CHECK_THAT(first(), Contains("Meets the one requirement judged for this purpose") &&
                                Contains("verdict bad\">Cast: not printable, a gap") &&
                                Contains("The model is closed") &&
                                Contains("Nothing: there is no"));
    }
    WHEN("there are many openings, warnings and findings") {
        for (int i = 0; i < 20; ++i) {
            const std::string name = "item " + std::to_string(i) + ".";
            report["openings"].push_back({{"name", "outlet of " + name}});
            report["warnings"].push_back("warning of " + name);
            report["findings"].push_back({{"title", "finding of " + name}});
        }
        const std::string text = first();
        CHECK_THAT(text, Contains("outlet of item 5.") && Contains("14 more</a>"));
        CHECK_THAT(text, Contains("warning of item 2.") && Contains("finding of item 2.") &&
                             Contains("34 more</a>"));
        for (const char* part : {"outlet of item 6.", "warning of item 3.", "finding of item 3."})
            CHECK_THAT(text, !Contains(part));
    }
}
