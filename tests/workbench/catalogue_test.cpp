#include "geometry/kernel/catalogue.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/diagnostic_text.h"
#include "tests/support/paths.h"
#include "workbench/case/diagnostic_json.h"
#include "workbench/case/diagnostic_words.h"

using namespace vesselbench;
using Catch::Contains;
using Json = nlohmann::ordered_json;

namespace {

/// A diagnostic that has a value for every name in a text.
Diagnostic with_all_values(const CatalogueText& entry) {
    Diagnostic diagnostic{.code = entry.code,
                          .operation = "remesh",
                          .place = Vec3(1, 2, 3),
                          .remedies = {{.arguments = {{"edge", "0.2"}}}, {.operation = "repair"}}};
    static const std::regex value(R"(\{(\w+)([:#]?)[^}]*\})");
    const std::string text = entry.text;
    for (std::sregex_iterator i(text.begin(), text.end(), value), end; i != end; ++i)
        if ((*i)[2] == "")
            diagnostic.words[(*i)[1]] = "word";
        else
            diagnostic.figures[(*i)[1]] = 2.0;
    return diagnostic;
}

/// Our sources' texts, without the catalogue's.
std::string all_sources() {
    namespace fs = std::filesystem;
    std::string all;
    for (const char* folder : {"geometry", "smoothing", "meshing", "workbench"})
        for (const auto& entry :
             fs::recursive_directory_iterator(fs::path(test::source_folder()) / folder)) {
            const fs::path& file = entry.path();
            if (file.extension() != ".cpp" || file.filename().string().starts_with("catalogue"))
                continue;
            std::ifstream stream(file);
            all.append(std::istreambuf_iterator<char>(stream), {});
        }
    return all;
}

/// The texts in quotes of every "code = ...".
std::set<std::string> codes_in(const std::string& sources) {
    static const std::regex assigned(R"(\bcode = ([^;{}(]*?)[;,}])"), quoted(R"re("([a-z-]+)")re");
    std::set<std::string> codes;
    for (std::sregex_iterator i(sources.begin(), sources.end(), assigned), end; i != end; ++i) {
        const std::string right = (*i)[1];
        for (std::sregex_iterator q(right.begin(), right.end(), quoted); q != end; ++q)
            codes.insert((*q)[1]);
    }
    return codes;
}

}  // namespace

SCENARIO("Every text of the catalogue is filled, for each audience", "[workbench][catalogue]") {
    std::set<std::string> codes;
    for (const CatalogueText& entry : catalogue()) {
        CAPTURE(entry.code);
        CHECK(codes.insert(entry.code).second);
        const Diagnostic diagnostic = with_all_values(entry);
        for (const Audience& audience :
             {Audience{}, Audience{.window = true}, Audience{.project = "a b/case.vbench"}}) {
            std::string text;
            CHECK_NOTHROW(text = filled(entry.text, diagnostic, [&](const auto&, const auto&) {
                              return std::string("remedy");
                          }));
            CHECK(text.find_first_of("{}[]") == std::string::npos);
            CHECK_FALSE(worded(diagnostic, audience).empty());
            CHECK_THAT(worded(diagnostic, audience), !Contains(std::string(entry.code) + ": "));
        }
    }
}

SCENARIO("The catalogue has the codes of the sources and no others", "[workbench][catalogue]") {
    const std::string sources = all_sources();
    std::set<std::string> known;
    for (const CatalogueText& entry : catalogue()) {
        known.insert(entry.code);
        CAPTURE(entry.code);
        if (std::string(entry.code) != kPlainText)
            CHECK(sources.find("\"" + std::string(entry.code) + "\"") != std::string::npos);
    }
    const std::set<std::string> used = codes_in(sources);
    CHECK(used.size() > 50);
    for (const std::string& code : used) {
        CAPTURE(code);
        CHECK(known.contains(code));
    }
}

SCENARIO("A diagnostic is worded for those who read it", "[workbench][catalogue]") {
    Diagnostic gap{.code = "edges-limited",
                   .operation = "remesh",
                   .figures = {{"edge_mm", 0.5}},
                   .remedies = {{.arguments = {{"edge", "0.2"}}}}};
    CHECK_THAT(worded(gap), Contains("; edge=0.2 makes"));
    CHECK_THAT(worded(gap, {.window = true}), Contains("\"Edge\" = 0.2 makes"));
    CHECK(worded_with_operation(gap, {.window = true}).starts_with("Remesh: edges of 0.5 mm"));
    gap.edit = 4;
    CHECK_THAT(worded(gap, {.project = "my case/p.vbench"}),
               Contains("`vesselbench change 'my case/p.vbench' 4 edge=0.2` makes"));
    THEN("what a recipe's step refused goes on with --resume") {
        Diagnostic doubt{
            .code = "end-in-doubt",
            .operation = "clip-opening",
            .words = {{"doubts", "end 2 is none"}, {"advice", "opens it"}},
            .remedies = {{.operation = "clip-opening", .arguments = {{"open", "1,2,3"}}}}};
        CHECK_THAT(worded(doubt, {.project = "p", .preparing = true}),
                   Contains("`--resume --set clip-opening.open=1,2,3` opens it"));
        doubt.remedies[0].before = true;
        CHECK_THAT(worded(doubt, {.project = "p", .preparing = true}),
                   Contains("`vesselbench apply p clip-opening open=1,2,3`, then --resume, opens"));
    }
    THEN("an edit can be removed, or choose again") {
        Diagnostic stale{.code = "edit-no-longer-applies",
                         .operation = "remesh",
                         .edit = 4,
                         .words = {{"number", "4"}, {"name", "remesh"}, {"why", "so"}},
                         .remedies = {{.action = RemedyAction::ChooseAgain}}};
        CHECK_THAT(worded(stale, {.project = "p"}), Contains("`vesselbench change p 4 --anew`"));
        stale.remedies[0].action = RemedyAction::Remove;
        CHECK_THAT(worded(stale, {.project = "p"}), Contains("`vesselbench remove p 4`"));
        CHECK_THAT(worded(stale, {.window = true}), Contains("removing edit 4"));
        CHECK(diagnostic_from(diagnostic_json(stale), "it").remedies[0].action ==
              RemedyAction::Remove);
    }
    THEN("a number agrees with its noun, and what is not known is left out") {
        Diagnostic walls{
            .code = "brush-crosses-walls", .place = Vec3(1, 2, 3), .figures = {{"vertices", 1.0}}};
        CHECK_THAT(worded(walls), Contains("1 vertex moved") && !Contains(";"));
        walls.figures["crossings"] = 2.0;
        walls.remedies = {{.arguments = {{"strength", ""}}}};
        CHECK_THAT(worded(walls),
                   Contains("; 2 pairs of triangles still do") && Contains("less strength"));
    }
    THEN("a code that is not known still makes a line") {
        CHECK(worded({.code = "of-tomorrow", .place = Vec3(1, 2, 3), .figures = {{"n", 2.0}}}) ==
              "of-tomorrow: n 2, at (1, 2, 3) mm");
    }
}

SCENARIO("Diagnostics are stored as JSON; old projects' texts stay readable",
         "[workbench][catalogue]") {
    const Diagnostic given{
        .code = "too-few-openings",
        .severity = Severity::Error,
        .operation = "clip-opening",
        .edit = 3,
        .place = Vec3(1, 2, 3),
        .figures = {{"number", 2.0}},
        .words = {{"found", "none"}},
        .remedies = {
            {.operation = "clip-opening", .arguments = {{"tip", "1,2,3"}}, .before = true}}};
    CHECK(diagnostic_from(diagnostic_json(given), "it") == given);
    const auto old = diagnostics_from(Json::parse(R"(["the surface was inside out"])"), "them");
    REQUIRE(old.size() == 1);
    CHECK(old[0].code == kPlainText);
    CHECK(worded(old[0]) == "the surface was inside out");
    for (const char* wrong :
         {"3", "{}", R"({"code": 1})", R"({"code": "a", "figures": []})",
          R"({"code": "a", "severity": "fatal"})", R"({"code": "a", "place_mm": [1, 2]})",
          R"({"code": "a", "remedies": [{}]})"}) {
        CAPTURE(wrong);
        CHECK_THROWS_AS(diagnostic_from(Json::parse(wrong), "it"), InvalidInput);
    }
}

SCENARIO("A diagnosed error keeps its class and says its first diagnostic",
         "[workbench][catalogue]") {
    const Diagnostic reversed{.code = "orientation-reversed"};
    CHECK_THROWS_AS(throw DiagnosedInput(reversed), InvalidInput);
    CHECK_THROWS_AS(throw DiagnosedUsage(reversed), UsageError);
    const DiagnosedFailure failure(reversed);
    CHECK_THAT(failure.what(), Contains("inside out"));
    CHECK(diagnostics_of(failure).at(0).severity == Severity::Error);
    CHECK(diagnostics_of(IoError("no such file")).at(0).code == kPlainText);
}

SCENARIO("A note needs nobody to look at it", "[workbench][catalogue]") {
    Diagnostic kept_apart{
        .code = "filter-crosses-walls", .place = Vec3(1, 2, 3), .figures = {{"vertices", 95.0}}};
    CHECK(is_note(kept_apart));
    CHECK(reported_json({kept_apart})[0]["severity"] == "note");
    THEN("what leaves something to do is a warning") {
        kept_apart.figures["crossings"] = 2.0;
        kept_apart.remedies = {{.arguments = {{"iterations", ""}}}};
        CHECK_FALSE(is_note(kept_apart));
        CHECK(reported_json({kept_apart})[0]["severity"] == "warning");
    }
    THEN("errors and warnings of the catalogue, and codes that it does not know, are none") {
        kept_apart.severity = Severity::Error;
        CHECK_FALSE(is_note(kept_apart));
        CHECK_FALSE(is_note({.code = "end-decided"}));
        CHECK_FALSE(is_note({.code = "of another version"}));
    }
    THEN("projects store it as a warning, as versions before read it") {
        CHECK(diagnostic_json(kept_apart)["severity"] == "warning");
    }
}
