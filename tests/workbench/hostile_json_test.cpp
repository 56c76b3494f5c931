#include <filesystem>
#include <functional>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "geometry/kernel/errors.h"
#include "tests/support/paths.h"
#include "tests/support/program.h"
#include "tests/support/shapes.h"
#include "workbench/case/json_fields.h"
#include "workbench/case/json_text.h"
#include "workbench/phantoms/phantom_json.h"
#include "workbench/prepare/input.h"
#include "workbench/prepare/recipe.h"
#include "workbench/project/stored_text.h"

using namespace vesselbench;
using namespace vesselbench::test;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

namespace {

std::string nested(std::size_t depth) {
    return std::string(depth, '[') + std::string(depth, ']');
}

/// The text of the error, which never is the JSON library's.
template <class Error = InvalidInput>
std::string error_of(const std::function<void()>& call) {
    try {
        call();
    } catch (const Error& error) {
        CHECK_THAT(error.what(), !Contains("json.exception"));
        return error.what();
    }
    return "no such error";
}

Input case_with(const std::string& text) {
    const std::string folder = temporary_folder();
    write_text(folder + "/case.json", text);
    return resolve_input({.input = folder}, {});
}

}  // namespace

SCENARIO("JSON is read up to 64 levels and a limit of size", "[workbench][json]") {
    CHECK_NOTHROW(json_from_text(nested(64), "a"));
    CHECK(json_from_text(R"(["[[[[", "\"[{"])", "a").size() == 2);  // brackets in texts
    CHECK_THAT(error_of([] { (void)json_from_text("\n " + nested(65), "a.json"); }),
               Contains("a.json, line 2, column 66") && Contains("64 deep"));
    CHECK_THAT(error_of([] { (void)json_from_text("[1, 2, 3]", "a.json", 5); }),
               Contains("9 bytes") && Contains("at most 5"));
    std::string many = "[0";
    for (int i = 0; i < 8'000'001; ++i) many += ",0";  // 16 MB, which would take 130 or more
    CHECK_THAT(error_of([&] { (void)json_from_text(many + "]", "a.json", kLargestStoredJson); }),
               Contains("more than 8000000 values"));
}

SCENARIO("Comments are allowed in texts that people write only", "[workbench][json]") {
    const std::string text = "[1, // \"[{\n 2 /* \" *//* [ */, \"//\"]";
    CHECK(json_from_text(text, "a", kLargestJsonFile, JsonComments::Ignored).size() == 3);
    CHECK_THAT(error_of([&] { (void)json_from_text(text, "a"); }), Contains("line 1, column 5"));
    const auto ignored = [](const std::string& comment) {
        return error_of(
            [&] { (void)json_from_text(comment, "a", kLargestJsonFile, JsonComments::Ignored); });
    };
    CHECK_THAT(ignored("[1] /* no end"), Contains("not valid JSON") || Contains("too early"));
    CHECK_THAT(ignored("/**/" + nested(65)), Contains("64 deep"));
    CHECK_THAT(ignored("// only this"), Contains("ends too early"));
}

SCENARIO("A mistake in JSON is shown by its line and column", "[workbench][json]") {
    CHECK_THAT(error_of([] { (void)json_from_text("{\n  \"a\": x\n}", "a.json"); }),
               Contains("a.json, line 2, column 8"));
    CHECK_THAT(error_of([] { (void)json_from_text("{\"a\": [1,", "a.json"); }),
               Contains("ends too early"));
    CHECK_THAT(error_of([] { (void)json_from_text("", "a.json"); }), Contains("ends too early"));
    CHECK_THAT(error_of([] { (void)json_from_text("\"\xff\"", "a.json"); }), Contains("line 1"));
    CHECK_THAT(error_of([] { (void)json_from_text("1e999", "a.json"); }), Contains("too large"));
}

SCENARIO("A field of the wrong type is named by its path", "[workbench][json]") {
    const auto json = json_from_text(
        R"({"a": 1.5, "b": [1, "x"], "c": {"d": 300}, "e": -1, "f": 1e300, "g": "\u001b[31m"})",
        "t");
    JsonFields fields(json, "t");
    CHECK_THAT(error_of([&] { (void)fields.required<int>("a"); }),
               StartsWith("t.a must be an integer"));
    CHECK_THAT(error_of([&] { (void)fields.required<std::vector<double>>("b"); }),
               StartsWith("t.b[1] must be a number, not \"x\""));
    JsonFields inner(*fields.child("c"), fields.place_of("c"));
    CHECK_THAT(error_of([&] { (void)inner.required<std::uint8_t>("d"); }),
               StartsWith("t.c.d must be an integer from 0 to 255"));
    CHECK_THAT(error_of([&] { (void)fields.required<std::uint64_t>("e"); }), Contains("-1"));
    CHECK_THAT(error_of([&] { (void)fields.required<int>("f"); }), Contains("an integer"));
    CHECK_THAT(error_of([&] { (void)fields.required<int>("g"); }), !Contains("\x1b"));
    CHECK_THAT(error_of([&] { (void)fields.required<std::array<int, 3>>("b"); }),
               Contains("3 values"));
    CHECK_THAT(error_of([&] { (void)fields.required<bool>("h"); }), Contains("has no \"h\""));
    CHECK(fields.optional<double>("a") == 1.5);
}

SCENARIO("Phantoms and cases name the field that is wrong", "[workbench][json]") {
    const auto phantom = [](const std::string& text) {
        return error_of([&] { (void)phantom_from_json(text); });
    };
    CHECK_THAT(phantom(nested(50000)), Contains("deep"));
    CHECK_THAT(phantom("[]"), Contains("phantom must be an object"));
    CHECK_THAT(phantom(R"({"parts": 7})"), Contains("phantom.parts must be a list"));
    CHECK_THAT(phantom(R"({"parts": [{"sphere": {"radius": "big"}}]})"),
               Contains("phantom.parts[0].sphere.radius must be a number, not \"big\""));
    CHECK_THAT(phantom(R"({"imaging": {"size": [1, 2]}})"), Contains("phantom.imaging.size"));
    CHECK_THAT(phantom(R"({"name": "../../x"})"), Contains("letters"));

    const auto of_case = [](const std::string& text) {
        return error_of([&] { (void)case_with(text); });
    };
    CHECK_THAT(of_case(nested(50000)), Contains("case.json, line 1") && Contains("deep"));
    CHECK_THAT(of_case("[]"), Contains("case.json must be an object"));
    CHECK_THAT(of_case(R"({"surface": 7})"), Contains("case.json.surface must be a text, not 7"));
    CHECK_THAT(of_case(R"({"phantom": "tube", "seed": -1})"), Contains("case.json.seed"));
    CHECK_THAT(of_case(R"({"phantom": "tube", "recipe": 7})"), Contains("case.json.recipe"));
    CHECK_THAT(of_case("{}"), Contains("no \"image\""));
}

SCENARIO("Stored arguments that are damaged are reported in our words", "[workbench][json]") {
    for (const char* text : {"", "[]", "{\"a\": {\"x\": 1}}", "{\"a\": {}}", "{\"a\": null}",
                             "{\"a\": [[]]}", "{\"a\": 18446744073709551615}"}) {
        INFO(text);
        CHECK(error_of([&] { (void)arguments_from_stored(text); }) != "no such error");
    }
}

SCENARIO("No JSON given to the program ends it or shows the library's words", "[workbench][json]") {
    const std::string folder = temporary_folder(), recipe = folder + "/recipe.json";
    const auto prepare = [&](const std::string& text) {
        write_text(recipe, text);
        return run_program(program_path(), {"prepare", folder, "--for", "cfd", "--recipe", recipe,
                                            "--out", folder + "/out"});
    };
    write_text(folder + "/case.json", R"({"phantom": "tube"})");
    for (const std::string& text :
         {nested(50000), std::string("[{"), std::string("[7]"),
          std::string(R"([{"operation": 7}])"),
          std::string(R"([{"operation": "smooth", "when": 7}])"),
          std::string(R"([{"operation": "smooth", "arguments": {"lambda": {}}}])")}) {
        const ProgramRun run = prepare(text);
        INFO(text.substr(0, 100) << ": " << run.err);
        CHECK(run.exit_code == 2);
        CHECK_THAT(run.err, Contains("recipe") && !Contains("json.exception"));
    }
    write_text(folder + "/phantom.json", nested(50000));
    CHECK(run_program(program_path(), {"phantom", folder + "/phantom.json", "--out", folder})
              .exit_code == 3);
}
