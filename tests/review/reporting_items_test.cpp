#include "workbench/review/reporting_items.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "geometry/kernel/whole_file.h"
#include "tests/review/reviewed_session.h"
#include "tests/session/small_operations.h"
#include "tests/session/sphere_session.h"
#include "tests/support/shapes.h"
#include "workbench/review/audit.h"
#include "workbench/review/audit_texts.h"
#include "workbench/session/export_record.h"

using namespace vesselbench;
using namespace vesselbench::test;
using Catch::Matchers::Contains;
using Json = nlohmann::ordered_json;

namespace {

/// Of a case of an image, extracted, edited, reviewed and exported.
Json full_statement() {
    return Json::parse(R"({
        "program_versions": ["1.2.3"], "variants": ["rp"],
        "sources": [{"file": "scan.nrrd", "sha256": "ab", "size_voxels": [83, 25, 78],
                     "spacing_mm": [0.45, 0.45, 0.8]}],
        "segmentation": [{"operation": "extract-surface", "arguments": "threshold=250",
                          "loaded": false}],
        "edits": [{"edit": 2, "operation": "extract-surface"},
                  {"edit": 3, "operation": "smooth", "accuracy": {"largest_deviation_mm": 0.25}},
                  {"edit": 4, "operation": "remesh", "accuracy": {"largest_deviation_mm": 0.125}},
                  {"edit": 5, "operation": "extrude-opening", "step": "openings",
                   "accuracy": {"largest_deviation_mm": 12.0}}],
        "operators": ["Ada", "Bo"],
        "reviewers": [{"name": "A. Kern", "role": "radiologist"}],
        "exports": [{"file": "print.stl", "sha256": "cd"}]})");
}

const Json& item(const Json& items, const std::string& name) {
    for (const Json& row : items)
        if (row["item"] == name) return row;
    FAIL("there is no item " << name);
    return items;
}

std::string text_of(const Json& items, const std::string& name) {
    return item(items, name)["text"];
}

}  // namespace

SCENARIO("What a report should state is listed, stated or not", "[review][reporting-items]") {
    const Json items = reporting_items(full_statement());
    CHECK(items.size() == 16);
    CHECK(text_of(items, "intended use") == "Model for printing");
    CHECK(text_of(items, "source") == "scan.nrrd");
    CHECK(text_of(items, "resolution") == "0.45 x 0.45 x 0.8 mm, 83 x 25 x 78 voxels");
    CHECK(text_of(items, "segmentation") == "extract-surface threshold=250");
    CHECK(text_of(items, "edits") == "4 edits, listed");
    CHECK(text_of(items, "operators") == "Ada, Bo");
    CHECK(text_of(items, "reviewers") == "A. Kern (radiologist)");
    CHECK_THAT(text_of(items, "accuracy of the editing"), Contains("0.25 mm by edit 3 smooth"));
    CHECK(text_of(items, "software and version") == "1.2.3");
    CHECK(text_of(items, "files") == "print.stl SHA-256 cd");
    THEN("what the program does not know is said to be not stated") {
        for (const char* name : {"modality", "image quality: noise, contrast, artifacts",
                                 "accuracy of the segmentation", "printer, material and settings",
                                 "post-processing and accuracy of the print"}) {
            CHECK(item(items, name)["stated"] == false);
            CHECK_THAT(text_of(items, name), Contains("not stated: "));
        }
    }
}

SCENARIO("A statement that lacks something says so", "[review][reporting-items]") {
    Json statement = full_statement();
    GIVEN("a surface that was segmented elsewhere") {
        statement["sources"] = {{{"file", "tube.stl"}, {"triangles", 1200}}};
        statement["segmentation"] = {{{"operation", "load-surface"}, {"loaded", true}}};
        const Json items = reporting_items(statement);
        CHECK(text_of(items, "resolution") == "1200 triangles");
        CHECK(item(items, "segmentation")["stated"] == false);
    }
    GIVEN("nothing at all") {
        for (auto& [key, value] : statement.items()) value = Json::array();
        for (const Json& row : reporting_items(statement)) {
            CAPTURE(row.dump());
            CHECK(row["stated"] == (row["item"] == "unit and scale"));
        }
    }
}

SCENARIO("An audit lists the items and the exported files", "[review][reporting-items]") {
    const std::string project = reviewed_project(), file = temporary_folder() + "/model.stl";
    {
        Session session = Session::open(project, options());
        for (const char* content : {"an earlier model", "the model"}) {
            write_file(file, content);
            record_export(session, file, "cfd");
        }
    }
    const Audit made = audit({.project = project, .find = find_test_operation});
    const Json& files = made.statement["exports"];
    REQUIRE(files.size() == 1);  // the last one of this name
    CHECK(files[0]["file"] == "model.stl");
    CHECK(files[0]["sha256"].get<std::string>().size() == 64);
    CHECK(text_of(made.statement["items"], "operators") == "Ada");
    CHECK(item(made.statement["items"], "reviewers")["stated"] == false);
    const std::string page = audit_html(made);
    CHECK_THAT(page, Contains("What a report should state") && Contains("Exported files"));
    CHECK_THAT(page, Contains("<td>reviewers</td><td>no</td><td>not stated: not reviewed</td>"));
    CHECK_THAT(page, Contains(files[0]["sha256"].get<std::string>()));
}
