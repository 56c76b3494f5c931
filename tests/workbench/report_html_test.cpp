#include "workbench/report/report_html.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

using namespace vesselbench;
using Catch::Matchers::Contains;
using Json = nlohmann::ordered_json;

SCENARIO("The report's page matches its document", "[workbench][report]") {
    const Json report = Json::parse(R"({
        "program_version": "1.2.3", "purpose": "cfd", "units": "mm",
        "input": {"name": "<vessel> & co"},
        "warnings": ["the inlet sits in a bend"],
        "steps": [{"step": "smoothing", "operation": "smooth", "resolved": {"lambda": 0.5},
                   "duration_s": 0.25, "change": {"volume_before_mm3": 200.0,
                   "volume_after_mm3": 190.0, "triangles_after": 1234}}],
        "quality": {"before": {"closed": false}, "after": {"closed": true, "triangles": 1234}},
        "openings": [{"name": "inlet", "kind": "inlet", "diameter": 4.25}],
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
    for (const char* part : {"&lt;vessel&gt; &amp; co", "the inlet sits in a bend", "lambda=0.5",
                             "-5 %", "98765", "4.25", "89.8", "<h2>Mould</h2>", "To be cast.",
                             "wax grams", "12.5", "flow [cm&sup3;/s]", "least [mm] 0.5, noise 0<",
                             "10 numbers", "data:image/png;base64,iVBORw==", "surface.vtp"})
        CHECK_THAT(page, Contains(part));
    CHECK(page.find("src=\"http") == std::string::npos);
    CHECK(page.find("<vessel>") == std::string::npos);
    CHECK(page.find("Absent") == std::string::npos);
}
