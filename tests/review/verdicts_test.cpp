#include "workbench/review/verdicts.h"

#include <functional>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/whole_file.h"
#include "tests/support/shapes.h"

using namespace vesselbench;
using namespace vesselbench::test;
using Catch::Matchers::Contains;
using Json = nlohmann::ordered_json;

namespace {

/// As the page saves them.
Json good() {
    return {
        {"format", "vesselbench-verdicts"},
        {"version", 1},
        {"program", "0.2.0"},
        {"project", {{"id", "5f0c"}, {"name", "case.vbench"}}},
        {"chain_head", std::string(64, 'a')},
        {"reviewer", {{"name", "A. Kern"}, {"role", "radiologist"}}},
        {"written", "2024-05-17T09:30:00.123Z"},
        {"overall", {{"verdict", "unsure"}, {"comment", ""}}},
        {"edits",
         {{{"edit", 2},
           {"revision", 1},
           {"hash", std::string(64, 'b')},
           {"verdict", "reject"},
           {"comment", "too thin\nat the bend, <script>alert(1)</script> \u202E"},
           {"time", "2024-05-17T09:29:00Z"},
           {"pins", {{{"place", {1.5, 2, -3}}, {"text", "here"}}}},
           {"distances", {{{"from", {0, 0, 0}}, {"to", {0, 0, 2}}, {"mm", 2.0}, {"text", ""}}}}}}}};
}

std::string error_of(const std::string& text) {
    try {
        static_cast<void>(verdicts_from_text(text, "v.json"));
    } catch (const InvalidInput& error) {
        return error.what();
    }
    return "read";
}

/// The error of the good verdicts after a change.
std::string error_with(const std::function<void(Json&)>& change) {
    Json json = good();
    change(json);
    return error_of(json.dump());
}

}  // namespace

SCENARIO("Verdicts are read as the page saves them", "[review][verdicts]") {
    const VerdictFile file = verdicts_from_text(good().dump(2), "v.json");
    CHECK(file.reviewer == "A. Kern");
    CHECK(file.written == "2024-05-17T09:30:00Z");
    REQUIRE(file.edits.size() == 1);
    CHECK(file.edits[0].edit == EditRef{2, 1});
    CHECK(file.edits[0].verdict == Verdict::Reject);
    CHECK_THAT(file.edits[0].comment, Contains("<script>"));
    CHECK(file.edits[0].pins.at(0).place == Vec3(1.5, 2, -3));
    CHECK(file.edits[0].distances.at(0).length == 2.0);
    THEN("what they say can be written and read again") {
        CHECK(text_of(verdicts_from_text(text_of(file), "v.json")) == text_of(file));
    }
    THEN("what is not known is left out, whatever the order of the fields") {
        Json other = good();
        other["more"] = "x";
        const Json program = other["program"];
        other.erase("program");
        other["program"] = program;
        CHECK(text_of(verdicts_from_text(other.dump(), "v.json")) == text_of(file));
    }
}

SCENARIO("Verdicts of any origin are refused with the field that is wrong",
         "[review][verdicts][hostile]") {
    const auto names = [](const std::string& error, const std::string& field) {
        INFO(error);
        CHECK_THAT(error, Catch::Matchers::StartsWith("v.json"));
        CHECK_THAT(error, Contains(field));
        CHECK(error.size() < 400);
    };
    names(error_of(""), "ends too early");
    names(error_of("[]"), "an object");
    names(error_of(std::string(100'000, '[')), "deep");
    names(error_of(R"({"a":)" + std::string(1000, '{')), "deep");
    names(error_of(std::string(kLargestVerdictFile + 1, ' ')), "bytes");
    names(error_of("{\"format\": \"\xFF\"}"), "not valid JSON");
    names(error_of(R"({"format": NaN})"), "not valid JSON");
    names(error_of(R"({"format": 1e999})"), "too large");
    names(error_with([](Json& j) { j["format"] = "other"; }), ".format");
    names(error_with([](Json& j) { j["version"] = 2; }), ".version");
    names(error_with([](Json& j) { j["version"] = "1"; }), ".version");
    names(error_with([](Json& j) { j.erase("project"); }), "no \"project\"");
    names(error_with([](Json& j) { j["project"]["id"] = 5; }), ".project.id");
    names(error_with([](Json& j) { j["chain_head"] = ""; }), ".chain_head");
    names(error_with([](Json& j) { j["chain_head"] = std::string(64, 'G'); }), ".chain_head");
    names(error_with([](Json& j) { j["reviewer"] = "A. Kern"; }), ".reviewer");
    names(error_with([](Json& j) { j["reviewer"]["name"] = " "; }), ".reviewer.name");
    names(error_with([](Json& j) { j["reviewer"]["name"] = std::string(100'000, 'x'); }),
          ".reviewer.name has 100000 bytes");
    names(error_with([](Json& j) { j["reviewer"]["name"] = "a\x1b[2J"; }), "control characters");
    names(error_with([](Json& j) { j["reviewer"]["role"] = "a\nb"; }), "control characters");
    names(error_with([](Json& j) { j["written"] = "yesterday"; }), ".written");
    names(error_with([](Json& j) { j["written"] = "2024-05-17T09:30:00+02:00"; }), ".written");
    names(error_with([](Json& j) { j["overall"]["verdict"] = "maybe"; }), ".overall.verdict");
    names(error_with([](Json& j) {
              j["overall"] = {{"verdict", "reject"}, {"comment", ""}};
          }),
          ".overall.comment");
    names(error_with([](Json& j) { j["edits"] = 5; }), ".edits");
    names(error_with([](Json& j) { j["edits"][0] = Json::array(); }), ".edits[0]");
    names(error_with([](Json& j) { j["edits"].push_back(j["edits"][0]); }), ".edits[1].edit");
    names(error_with([](Json& j) { j["edits"][0]["edit"] = 0; }), ".edits[0].edit");
    names(error_with([](Json& j) { j["edits"][0]["edit"] = 1.5; }), ".edits[0].edit");
    names(error_with([](Json& j) { j["edits"][0]["revision"] = 5'000'000'000; }), ".revision");
    names(error_with([](Json& j) { j["edits"][0]["hash"] = "b"; }), ".edits[0].hash");
    names(error_with([](Json& j) { j["edits"][0]["verdict"] = true; }), ".edits[0].verdict");
    names(error_with([](Json& j) { j["edits"][0]["comment"] = ""; }), "needs its reason");
    names(error_with([](Json& j) { j["edits"][0]["comment"] = std::string(1 << 20, 'x'); }),
          ".edits[0].comment");
    names(error_with([](Json& j) { j["edits"][0]["comment"] = std::string("a\0b", 3); }),
          "control characters");
    names(error_with([](Json& j) { j["edits"][0]["time"] = 5; }), ".edits[0].time");
    names(error_with([](Json& j) { j["edits"][0]["pins"] = "x"; }), ".edits[0].pins");
    names(error_with([](Json& j) {
              j["edits"][0]["pins"][0]["place"] = {1, 2};
          }),
          ".pins[0].place");
    names(error_with([](Json& j) {
              j["edits"][0]["pins"][0]["place"] = {1e300, 2, 3};
          }),
          ".pins[0].place");
    names(error_with([](Json& j) { j["edits"][0]["pins"] = Json(2000, j["edits"][0]["pins"][0]); }),
          ".edits[0].pins has 2000");
    names(error_with([](Json& j) { j["edits"][0]["distances"][0]["mm"] = -1.0; }), ".mm");
    THEN("a file that is too large is not even read") {
        const std::string path = temporary_folder() + "/large.json";
        write_file(path, std::string(kLargestVerdictFile + 1, ' '));
        CHECK_THROWS_AS(verdicts_from_file(path), InvalidInput);
        CHECK_THROWS_AS(verdicts_from_file(temporary_folder() + "/none.json"), IoError);
    }
}
